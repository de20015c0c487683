// Pressures that are functions of the overclosure, from outside: closed forms, Newton's method, CalculiX, and what is refused.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <sstream>

#include "peer_support.hpp"

namespace {

namespace files = std::filesystem;
using Json = nlohmann::json;

constexpr int done = 0, invalid = 2;
const std::string list = "contact/joint/formulation/";

struct Outcome {
  int code = 0;
  std::string said;
  Json quantities, steps;
  double value(const std::string& name) const { return quantities.at(name).get<double>(); }
};

Outcome run(const std::string& path, const std::string& name, const std::vector<std::string>& settings) {
  const std::string results = std::string(SCRATCH) + "/" + name;
  files::remove_all(results);
  std::vector<std::string> words{MORTISE, "run", path, "-o", results, "--set", "output/fields="};
  for (const std::string& setting : settings) words.insert(words.end(), {"--set", setting});
  const Ending ending = launch(words, 120);
  if (!files::exists(results + "/summary.json")) return {ending.code, ending.output, {}, {}};
  const Json summary = Json::parse(read_file(results + "/summary.json"));
  return {ending.code, ending.output, summary.at("quantities"), summary.at("steps")};
}

/// The block on a soft surface, without the number of its own law.
std::string soft_block() {
  std::istringstream scene(read_file(std::string(INPUTS) + "/verification/soft_block.xml"));
  const std::string path = std::string(SCRATCH) + "/soft_block.xml";
  std::ofstream without(path);
  for (std::string line; std::getline(scene, line);)
    if (line.find("name=\"stiffness\"") == std::string::npos) without << line << '\n';
  return path;
}

/// A law as settings of a scene, as a deck of CalculiX has it, and as a function.
struct Law {
  std::string name;
  std::vector<std::string> settings;
  std::string card, type;  ///< of CalculiX, which has laws of tables at nodes only; empty: it does not have the law
  std::function<double(double)> pressure;
};

// The block starts 0.01 above the plane: exponentials act from there on.
std::vector<Law> laws() {
  constexpr double c0 = 0.012, p0 = 4.0;
  const double e = std::exp(1.0), beta = std::log(100.0) / c0;
  return {
      {"linear", {"law/stiffness=500"}, "LINEAR\n500.", "SURFACE TO SURFACE", [](double h) { return 500.0 * std::max(0.0, h); }},
      {"exponential",
       {"law/type=exponential", "law/clearance=0.012", "law/pressure=4"},
       "",
       "",
       [e](double h) {
         const double s = h / c0 + 1.0;
         return s > 0.0 ? p0 / (e - 1.0) * s * (std::exp(s) - 1.0) : 0.0;
       }},
      {"exponential from a hundredth",
       {"law/type=exponential", "law/clearance=0.012", "law/pressure=4", "law/curve=from a hundredth"},
       "EXPONENTIAL\n0.012,4.",
       "SURFACE TO SURFACE",
       [beta](double h) { return h > -c0 ? p0 * std::exp(beta * h) : std::max(0.0, p0 / 100.0 * (1.0 + beta * (h + c0))); }},
      {"table",
       {"law/type=table", "law/overclosures=0, 0.004, 0.02, 0.1", "law/pressures=0, 3, 5, 165"},
       "TABULAR\n0.,0.\n3.,0.004\n5.,0.02\n165.,0.1",
       "NODE TO SURFACE",
       [](double h) {
         return h < 0.0 ? 0.0 : h < 0.004 ? 750.0 * h : h < 0.02 ? 3.0 + 125.0 * (h - 0.004) : 5.0 + 2000.0 * (h - 0.02);
       }},
      {"table of a gasket",
       {"law/type=table", "law/overclosures=-0.005, 0.001, 0.02", "law/pressures=0, 3, 3"},
       "",
       "",
       [](double h) { return h < -0.005  ? 0.0
                             : h < 0.001 ? 500.0 * (h + 0.005)
                                         : 3.0; }},
  };
}

std::vector<std::string> settings_of(const Law& law) {
  std::vector<std::string> settings{"checks/law/low=0", "checks/law/high=1e9"};
  for (const std::string& one : law.settings) settings.push_back(list + one);
  return settings;
}

/// Where the spring of the block and the law are in balance: h + p(h) height/M = press - apart, whose left side grows.
double overclosure(const Law& law, double press) {
  const double apart = 0.01, height = 0.8, M = 1000.0 * 0.75 / (1.25 * 0.5);
  double low = -apart, high = press - apart;
  for (int i = 0; i < 100; ++i) {
    const double middle = 0.5 * (low + high);
    (middle + law.pressure(middle) * height / M < press - apart ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

// The scene checks the spring in series to 1e-10. Newton's tolerance leaves 1e-12 of the pressure, which the law makes an overclosure; a hundred
// times that.
TEST(SoftBlock, IsASpringInSeriesWithTheLaw) {
  for (const std::string discretisation : {"dual mortar", "standard mortar", "node to segment"})
    for (const Law& law : laws()) {
      SCOPED_TRACE(law.name + " of " + discretisation);
      for (const double press : {0.014, 0.06}) {
        std::vector<std::string> settings = settings_of(law);
        settings.insert(settings.end(), {list + "discretisation=" + discretisation, "variables/press=" + std::to_string(press)});
        const Outcome outcome = run(soft_block(), "series", settings);
        ASSERT_EQ(outcome.code, done) << outcome.said;
        const double h = overclosure(law, press), p = law.pressure(h);
        EXPECT_GT(p, 0.0);
        EXPECT_NEAR(outcome.value("overclosure"), h, 1e-10 * press);
        EXPECT_NEAR(outcome.value("least_pressure"), p, 1e-10 * p);
        EXPECT_NEAR(outcome.value("largest_pressure"), p, 1e-10 * p);
        for (const Json& step : outcome.steps) EXPECT_EQ(step.at("undone"), Json::array());
      }
    }
}

// Order from the last three changes of the displacements, ln(d_3/d_2) / ln(d_2/d_1): 2 for Newton's method. An error in the tangent would leave 1, a
// secant 1.62. In its only step the cylinder goes from the first touch to the whole load, and its nodes pass kinks of the table, sticks and slips.
// Changes are above round-off: positions of 50 are known to 7e-15 and displacements are 0.2, so that 1e-12 is far above it.
TEST(SoftCylinder, NewtonIsQuadratic) {
  const std::string of_pair = "contact/interface/formulation/";
  const std::vector<std::vector<std::string>> laws = {{"law/type=exponential", "law/clearance=0.02", "law/pressure=50"},
                                                      {"law/type=exponential", "law/clearance=0.02", "law/pressure=50", "law/curve=from a hundredth"},
                                                      {"law/type=table", "law/overclosures=-0.01, 0, 0.005, 0.02", "law/pressures=0, 50, 400, 3000"}};
  for (const auto& law : laws)
    for (const std::string friction : {"0", "0.1"}) {
      std::vector<std::string> settings{"variables/steps=1", "variables/mu=" + friction, "stepping/predictor=none",
                                        of_pair + "type=pressure overclosure"};
      for (const std::string& one : law) settings.push_back(of_pair + one);
      const Outcome outcome = run(std::string(INPUTS) + "/paper/hertz_elastic.xml", "cylinder", settings);
      SCOPED_TRACE(law[0] + ", mu = " + friction + "\n" + outcome.said);
      ASSERT_EQ(outcome.steps.size(), 1U);
      EXPECT_EQ(outcome.steps[0].at("undone"), Json::array());
      std::vector<double> changes;
      for (const Json& row : outcome.steps[0].at("newton"))
        if (row.at("increment").is_number()) changes.push_back(row.at("increment").get<double>());
      while (!changes.empty() && changes.back() < 1e-12) changes.pop_back();
      ASSERT_GE(changes.size(), 3U);
      const double* const last = changes.data() + changes.size() - 3;
      EXPECT_LT(last[1], last[0]);
      EXPECT_GE(std::log(last[2] / last[1]) / std::log(last[1] / last[0]), 1.62);
    }
}

// The edges of the punch run through facets. Nodes that they hardly cover are not pushed back by their small forces: of this law, which doubles its
// pressure within 0.002, those would bear what no iteration resolves.
TEST(SoftPunch, SliversOfContactStopNoStep) {
  const std::string of_pair = "contact/face/formulation/";
  for (const std::string curve : {"from zero", "from a hundredth"}) {
    const Outcome outcome = run(std::string(INPUTS) + "/verification/3d/punch.xml", "punch",
                                {of_pair + "type=pressure overclosure", of_pair + "law/type=exponential", of_pair + "law/clearance=0.01",
                                 of_pair + "law/pressure=0.1", of_pair + "law/curve=" + curve});
    EXPECT_EQ(outcome.code, done) << outcome.said;
    for (const Json& step : outcome.steps) EXPECT_EQ(step.at("undone"), Json::array()) << outcome.said;
  }
}

/// The pressure that CalculiX finds under the block of the scene, which it starts on the plane, where it already looks for contact.
double pressure_of_calculix(const Law& law, double press_beyond) {
  const std::string folder = std::string(SCRATCH) + "/calculix";
  files::create_directories(folder);
  files::remove(folder + "/block.dat");
  std::ostringstream deck;
  deck.precision(16);
  deck << "*NODE,NSET=ALL\n";
  int node = 0;
  for (const double z : {-0.5, 0.0, 0.0, 0.8})
    for (const char* at : {"0.,0.", "1.,0.", "1.,1.", "0.,1."}) deck << ++node << ',' << at << ',' << z << '\n';
  deck << "*NSET,NSET=PLANE,GENERATE\n1,8\n*NSET,NSET=TOP,GENERATE\n13,16\n"
          "*ELEMENT,TYPE=C3D8,ELSET=ALL\n1,1,2,3,4,5,6,7,8\n2,9,10,11,12,13,14,15,16\n"
          "*MATERIAL,NAME=ELASTIC\n*ELASTIC\n1000.,0.25\n*SOLID SECTION,ELSET=ALL,MATERIAL=ELASTIC\n"
          "*SURFACE,NAME=SLAVE,TYPE=ELEMENT\n2,S1\n*SURFACE,NAME=MASTER,TYPE=ELEMENT\n1,S2\n"
          "*SURFACE INTERACTION,NAME=SOFT\n*SURFACE BEHAVIOR,PRESSURE-OVERCLOSURE="
       << law.card << "\n*CONTACT PAIR,INTERACTION=SOFT,TYPE=" << law.type
       << "\nSLAVE,MASTER\n*BOUNDARY\nALL,1,2\nPLANE,3,3\n*STEP\n*STATIC\n1.,1.\n"
          "*CONTROLS,PARAMETERS=FIELD\n1.e-9,1.e-9\n*BOUNDARY\nTOP,3,3,"
       << -press_beyond << "\n*NODE PRINT,NSET=TOP,TOTALS=ONLY\nRF\n*END STEP\n";
  std::ofstream(folder + "/block.inp") << deck.str();
  const Ending ending = launch({"ccx", folder + "/block"}, 120);
  EXPECT_EQ(ending.code, 0) << ending.output;
  std::istringstream table(read_file(folder + "/block.dat"));
  std::string word, last;
  while (table >> word) last = word;
  return last.empty() ? 0.0 : -std::stod(last);
}

// Both solve the same equations, as the plane is flat and meshes of a homogeneous state do not matter. CalculiX prints seven digits.
TEST(SoftBlock, AgreesWithCalculix) {
  if (!peer_support::installed()) GTEST_SKIP() << "no program ccx";
  for (const Law& law : laws()) {
    if (law.card.empty()) continue;
    SCOPED_TRACE(law.name);
    std::vector<std::string> settings = settings_of(law);
    const Outcome outcome = run(soft_block(), "calculix_too", settings);
    ASSERT_EQ(outcome.code, done) << outcome.said;
    const double ours = outcome.value("largest_pressure");
    EXPECT_NEAR(ours / pressure_of_calculix(law, 0.06 - 0.01), 1.0, 1e-6);
  }
}

TEST(SoftBlock, RefusesLawsThatItCannotKeep) {
  const auto refusal = [](const std::vector<std::string>& law) {
    std::vector<std::string> settings;
    for (const std::string& one : law) settings.push_back(list + one);
    const Outcome outcome = run(soft_block(), "refused", settings);
    EXPECT_EQ(outcome.code, invalid) << outcome.said;
    return outcome.said;
  };
  const auto expect = [](const std::string& said, const std::string& text) { EXPECT_NE(said.find(text), std::string::npos) << said; };
  expect(refusal({"law/type=exponential", "law/clearance=5", "law/pressure=1"}), "please give a \"search reach\" of 5 or more");
  expect(refusal({"law/type=table", "law/overclosures=0, 1", "law/pressures=0, 1, 2"}), "has 2 values and \"pressures\" 3");
  expect(refusal({"law/type=table", "law/overclosures=0, 1", "law/pressures=1, 2"}), "begins with 1");
  expect(refusal({"law/type=table", "law/overclosures=0, 1, 2", "law/pressures=0, 2, 1"}), "a pressure that falls");
  expect(refusal({"law/type=linear", "law/stiffness=0"}), "\"stiffness\" is 0");
  expect(refusal({"law/type=quadratic"}), "quadratic");
}

}  // namespace
