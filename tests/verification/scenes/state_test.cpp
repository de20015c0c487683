// Bodies that contact alone holds: states that hold are accepted, others are not.

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

#include "launch.hpp"
#include "scene_text.hpp"

namespace {

using namespace scene_text;
using Words = std::vector<std::string>;

std::string block(const std::string& name, double width, double height, int cells_x, int cells_y, const std::string& translation) {
  return list(name, parameter("material", "soft") +
                        list("mesh", parameter("type", "block") + of_type("width", "double", std::to_string(width)) +
                                         of_type("height", "double", std::to_string(height)) + of_type("cells x", "int", std::to_string(cells_x)) +
                                         of_type("cells y", "int", std::to_string(cells_y)) + parameter("translation", translation)));
}
std::string disk(const std::string& name, double radius, const std::string& translation) {
  return list(name, parameter("material", "soft") + list("mesh", parameter("type", "disk") + of_type("radius", "double", std::to_string(radius)) +
                                                                     of_type("cells around", "int", "8") + of_type("cells across", "int", "4") +
                                                                     parameter("translation", translation)));
}
std::string sides(const std::string& name, const std::string& of, const std::string& where) {
  return list(name, parameter("of", of) + parameter("kind", "sides") + parameter("where", where));
}
std::string condition(const std::string& name, const std::string& set, const std::map<std::string, std::string>& values) {
  std::string content = parameter("set", set);
  for (const auto& [component, value] : values) content += parameter(component, value);
  return list(name, content);
}
std::string pair(const std::string& name, const std::string& slave, const std::string& master, double friction, const std::string& formulation = "") {
  return list(
      name, parameter("slave", slave) + parameter("master", master) +
                (friction > 0.0 ? list("friction", parameter("type", "coulomb") + of_type("coefficient", "double", std::to_string(friction))) : "") +
                (formulation.empty() ? "" : list("formulation", parameter("type", formulation))));
}
std::string stepping(double end, double step) {
  return list("stepping", of_type("end time", "double", std::to_string(end)) + of_type("step", "double", std::to_string(step)));
}
std::string place_of(const std::string& body) {
  std::string content;
  for (const std::string component : {"x", "y"})
    content += list("u" + component, parameter("type", "mean") + parameter("field", "displacement " + component) + parameter("on", body));
  return list("quantities", content);
}

struct Outcome {
  int code = -1;
  std::string output;
  nlohmann::json summary;
  double last_time() const { return summary.at("steps").empty() ? 0.0 : summary.at("steps").back().at("time").get<double>(); }
  double quantity(const std::string& name) const { return summary.at("quantities").at(name); }
  int count(const std::string& words) const {
    int found = 0;
    for (auto at = output.find(words); at != std::string::npos; at = output.find(words, at + 1)) ++found;
    return found;
  }
};

Outcome run(const std::string& name, const std::string& content, int ranks, Words settings = {}) {
  const std::filesystem::path directory = std::filesystem::path(SCRATCH);
  std::filesystem::create_directories(directory);
  const std::string scene = directory / (name + ".xml"), results = directory / name;
  std::filesystem::remove_all(results);
  const std::string soft = list("materials", list("soft", parameter("type", "neo hooke") + of_type("young's modulus", "double", "1000") +
                                                              of_type("poisson's ratio", "double", "0.3")));
  std::ofstream(scene) << list(name, soft + content);
  Words command{MPIEXEC, "-n", std::to_string(ranks), MORTISE, "run", scene, "-o", results};
  for (const std::string& setting : settings) command.insert(command.end(), {"--set", setting});
  const Ending ending = launch(command, 120);
  return {ending.code, ending.output, nlohmann::json::parse(read_file(results + "/summary.json"))};
}

/// A disk between a wall that stands and one that presses until t = 1/4 and then goes up.
std::string rolling_disk(double friction, const std::string& formulation = "") {
  return list("sets", sides("facing l", "ball/arc", "0.2 - x") + sides("facing r", "ball/arc", "x - 0.4")) +
         list("bodies", block("l", 1.0, 2.0, 4, 8, "-1, -1") + disk("ball", 0.3, "0.3, 0") + block("r", 1.0, 2.0, 4, 9, "0.6, -1")) +
         list("boundary conditions", condition("l", "l/left", {{"x", "0"}, {"y", "0"}}) +
                                         condition("r", "r/right", {{"x", "-0.05*min(1,4*t)"}, {"y", "0.2*max(0,t-0.25)"}})) +
         list("contact", pair("a", "facing l", "l/right", friction, formulation) + pair("b", "facing r", "r/left", friction, formulation)) +
         stepping(0.5, 0.05) + place_of("ball");
}

/// A block between two others: the lower one stands, the upper one moves by x and y.
std::string between_blocks(const std::string& x, const std::string& y, double end) {
  return list("bodies",
              block("low", 3.0, 1.0, 9, 3, "-1.5, -1") + block("mid", 1.0, 1.0, 4, 4, "-0.5, 0") + block("top", 3.0, 1.0, 9, 3, "-1.5, 1")) +
         list("boundary conditions", condition("low", "low/bottom", {{"x", "0"}, {"y", "0"}}) + condition("top", "top/top", {{"x", x}, {"y", y}})) +
         list("contact", pair("below", "mid/bottom", "low/top", 0.2) + pair("above", "mid/top", "top/bottom", 0.2)) + stepping(end, 0.125) +
         place_of("mid");
}

/// Runs a scene of inputs/hard.
Outcome run_hard(const std::string& scene, int ranks, const Words& settings) {
  const std::string results = std::string(SCRATCH) + "/" + scene;
  std::filesystem::remove_all(results);
  Words command{MPIEXEC, "-n", std::to_string(ranks), MORTISE, "run", std::string(INPUTS) + "/hard/" + scene + ".xml", "-o", results};
  for (const std::string& setting : settings) command.insert(command.end(), {"--set", setting});
  const Ending ending = launch(command, 120);
  return {ending.code, ending.output, nlohmann::json::parse(read_file(results + "/summary.json"))};
}

/// The number that follows some words in the last line that holds them.
double number_after(const std::string& output, const std::string& words) {
  const auto at = output.rfind(words);
  return at == std::string::npos ? std::nan("") : std::stod(output.substr(at + words.size()));
}

// A block under a dead load on friction of 0.05: all its nodes slip outwards. Where the block comes to rest, one of them sticks.
TEST(States, ABlockOnFrictionThatIsNearlyUsedUpFindsItsRest) {
  for (const int ranks : {1, 3})
    for (const std::string pull : {"0", "0.5", "0.9"}) {
      const Outcome result = run_hard("dead_load", ranks, {"variables/mu=0.05", "variables/pull=" + pull});
      ASSERT_EQ(result.code, 0) << result.output;
      EXPECT_NEAR(result.quantity("force"), 5.0, 5e-6);
      EXPECT_NEAR(result.quantity("aside"), -0.25 * std::stod(pull), 5e-6);
    }
}

// By statics the load over what friction bears is 1.2.
TEST(States, FrictionThatIsUsedUpIsToldFromContactThatOpens) {
  for (const int ranks : {1, 2}) {
    const Outcome result = run_hard("dead_load", ranks, {"variables/mu=0.3", "variables/pull=1.2"});
    EXPECT_EQ(result.code, 3) << result.output;
    const std::string end = result.output.substr(result.output.find("not converged; the last"));
    EXPECT_NE(end.find("friction is used up by body 'block' (translation in x)"), std::string::npos) << result.output;
    EXPECT_EQ(end.find("has opened"), std::string::npos) << result.output;
    EXPECT_NEAR(number_after(end, "the load along this motion is ") / number_after(end, "friction bears at most "), 1.2, 1e-4);
  }
}

// A shaft pressed into a hub by 0.01, which overhangs it: friction of 0.2 bears no less than Lame's pressure says. A part of that pulls it out, and
// it has to stay; predicted, what the first step pushes apart would go on.
TEST(States, APressFitBearsItsLoad) {
  const double over = 0.01, pressure = 1000.0 * over * (4.0 - 1.0) / (2.0 * 4.0);  // radii 1 and 2
  for (const int ranks : {1, 3})
    for (const double share : {0.6, 0.8}) {
      const double pull = share * 2.0 * 0.2 * pressure;
      const std::string scene =
          parameter("kinematics", "axisymmetric") +
          list("bodies", block("shaft", 1.0, 1.0, 4, 6, "0, 0") + block("hub", 1.01, 1.4, 4, 7, "0.99, -0.2")) +
          list("boundary conditions", condition("hub", "hub/right", {{"y", "0"}}) + condition("axis", "shaft/left", {{"x", "0"}})) +
          list("loads",
               list("pull", parameter("type", "dead traction") + parameter("set", "shaft/top") + parameter("y", std::to_string(pull) + "*t"))) +
          list("contact", pair("fit", "shaft/right", "hub/left", 0.2)) + stepping(1.0, 0.25) +
          list("quantities", list("held", parameter("type", "reaction") + parameter("set", "hub/right") + parameter("component", "y")) +
                                 list("out", parameter("type", "mean") + parameter("field", "displacement y") + parameter("on", "shaft")));
      const Outcome result = run("press_fit", scene, ranks);
      ASSERT_EQ(result.code, 0) << result.output;
      EXPECT_NEAR(std::abs(result.quantity("held")), M_PI * pull, 1e-5 * M_PI * pull);
      EXPECT_GT(result.quantity("out"), 0.0);
      EXPECT_LT(result.quantity("out"), over);
    }
}

// With little friction it is ejected: squeezed out by walls whose normals meet at an angle. It goes up by half of the wall's motion, 0.05, and no
// further.
TEST(States, ADiskThatIsShotOutIsNotAccepted) {
  for (const std::string formulation : {"", "standard mortar", "penalty"})
    for (const int ranks : {1, 2}) {
      if (!formulation.empty() && ranks > 1) continue;
      const Outcome result = run("ejected", rolling_disk(0.01, formulation), ranks);
      EXPECT_LT(std::abs(result.quantity("uy")), 0.05) << formulation;
      if (result.code == 0) continue;
      EXPECT_EQ(result.code, 3) << result.output;
      EXPECT_NE(result.output.substr(result.output.find("not converged")).find("'ball'"), std::string::npos) << result.output;
    }
}

TEST(States, ADiskThatRollsIsAccepted) {
  const Outcome result = run("rolls", rolling_disk(0.3), 1);
  EXPECT_EQ(result.code, 0) << result.output;
  EXPECT_NEAR(result.quantity("uy"), 0.025, 0.003);  // half of the wall's motion
  EXPECT_EQ(result.count("free to move"), 0) << result.output;
}

// By symmetry it goes half as far as the upper one, also where an iterate opens all contact and is thrown out.
TEST(States, AGrippedBlockIsNotThrownOut) {
  for (const int ranks : {1, 3}) {
    const Outcome result = run("gripped", between_blocks("0.3*max(0,t-0.25)", "-0.05*min(1,4*t)", 0.5), ranks);
    EXPECT_EQ(result.code, 0) << result.output;
    EXPECT_NEAR(result.quantity("ux"), 0.5 * 0.075, 0.01 * 0.075);
  }
}

// Once the upper block has gone the middle one stays where it was left; it is free, which is reported once.
TEST(States, ABlockThatIsLetGoStays) {
  const Outcome result = run("let_go", between_blocks("0", "-0.05*min(1,4*t)+0.8*max(0,t-0.5)", 0.75), 1);
  EXPECT_EQ(result.code, 0) << result.output;
  EXPECT_EQ(result.count("body 'mid' is free to move"), 1) << result.output;
  EXPECT_LT(std::abs(result.quantity("ux")), 0.05);
  EXPECT_LT(result.quantity("uy"), 0.2 - 0.05);  // below the upper one
}

// Without a force it stays between tool and wall, where it may be anywhere. From 0.3 of the tool's 0.4 on the wall stops it, and by symmetry its
// middle goes half of the rest.
TEST(States, ABlockThatIsCarriedBeforeItTouchesIsAccepted) {
  const std::string scene =
      list("bodies", block("tool", 0.5, 1.0, 2, 4, "-0.5, 0") + block("mid", 1.0, 1.0, 4, 3, "0, 0") + block("wall", 0.5, 1.0, 2, 4, "1.3, 0")) +
      list("boundary conditions", condition("tool", "tool/left", {{"x", "0.4*t"}, {"y", "0"}}) + condition("mid", "mid/bottom", {{"y", "0"}}) +
                                      condition("wall", "wall/right", {{"x", "0"}, {"y", "0"}})) +
      list("contact", pair("push", "mid/left", "tool/right", 0.0) + pair("stop", "mid/right", "wall/left", 0.0)) + place_of("mid");
  for (const int ranks : {1, 2}) {
    const Outcome before = run("carried", scene + stepping(0.5, 0.1), ranks);
    EXPECT_EQ(before.code, 0) << before.output;
    EXPECT_LE(before.count("body 'mid' is free to move (translation in x)"), 1) << before.output;
    EXPECT_GE(before.quantity("ux"), 0.2 - 1e-9);
    EXPECT_LE(before.quantity("ux"), 0.3 + 1e-9);
    const Outcome after = run("carried", scene + stepping(1.0, 0.1), ranks);
    EXPECT_EQ(after.code, 0) << after.output;
    EXPECT_NEAR(after.quantity("ux"), 0.35, 1e-9);
  }
}

// Past the line between two pegs a pushed ball snaps through, which needs inertia: before that the run stops.
TEST(States, ABallThatSnapsThroughIsANamedStop) {
  const std::string scene =
      list("sets", sides("facing l", "ball/arc", "min(-0.05-x,0.55-y)") + sides("facing r", "ball/arc", "min(x-0.05,0.55-y)") +
                       sides("head", "ball/arc", "y-0.72")) +
      list("bodies", disk("peg l", 0.5, "-0.85, 0") + disk("peg r", 0.5, "0.85, 0") + disk("ball", 0.4, "0, 0.38") +
                         block("tool", 0.3, 0.3, 2, 2, "-0.15, 0.78")) +
      list("boundary conditions", condition("l", "peg l", {{"x", "0"}, {"y", "0"}}) + condition("r", "peg r", {{"x", "0"}, {"y", "0"}}) +
                                      condition("tool", "tool/top", {{"x", "0"}, {"y", "-0.8*t"}})) +
      list("contact",
           pair("left", "facing l", "peg l/arc", 0.1) + pair("right", "facing r", "peg r/arc", 0.1) + pair("push", "tool/bottom", "head", 0.1)) +
      stepping(1.0, 0.1) + place_of("ball");
  const Outcome result = run("snap", scene, 1);
  EXPECT_EQ(result.code, 3) << result.output;
  EXPECT_NE(result.output.substr(result.output.find("not converged")).find("'ball'"), std::string::npos) << result.output;
  EXPECT_GT(result.quantity("uy"), -0.8);
}

}  // namespace
