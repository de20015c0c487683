// Bodies that contact alone holds: states that hold are accepted, others are not.

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

#include "launch.hpp"

namespace {

using Words = std::vector<std::string>;

std::string text(const std::string& name, const std::string& value) {
  return "<Parameter name=\"" + name + "\" type=\"string\" value=\"" + value + "\"/>\n";
}
std::string list(const std::string& name, const std::string& content) {
  return "<ParameterList name=\"" + name + "\">\n" + content + "</ParameterList>\n";
}
std::string of_type(const std::string& name, const std::string& type, const std::string& value) {
  return "<Parameter name=\"" + name + "\" type=\"" + type + "\" value=\"" + value + "\"/>\n";
}

std::string block(const std::string& name, double width, double height, int cells_x, int cells_y, const std::string& translation) {
  return list(name, text("material", "soft") +
                        list("mesh", text("type", "block") + of_type("width", "double", std::to_string(width)) +
                                         of_type("height", "double", std::to_string(height)) + of_type("cells x", "int", std::to_string(cells_x)) +
                                         of_type("cells y", "int", std::to_string(cells_y)) + text("translation", translation)));
}
std::string disk(const std::string& name, double radius, const std::string& translation) {
  return list(name, text("material", "soft") + list("mesh", text("type", "disk") + of_type("radius", "double", std::to_string(radius)) +
                                                                of_type("cells around", "int", "8") + of_type("cells across", "int", "4") +
                                                                text("translation", translation)));
}
std::string sides(const std::string& name, const std::string& of, const std::string& where) {
  return list(name, text("of", of) + text("kind", "sides") + text("where", where));
}
std::string condition(const std::string& name, const std::string& set, const std::map<std::string, std::string>& values) {
  std::string content = text("set", set);
  for (const auto& [component, value] : values) content += text(component, value);
  return list(name, content);
}
std::string pair(const std::string& name, const std::string& slave, const std::string& master, double friction, const std::string& formulation = "") {
  return list(name,
              text("slave", slave) + text("master", master) +
                  (friction > 0.0 ? list("friction", text("type", "coulomb") + of_type("coefficient", "double", std::to_string(friction))) : "") +
                  (formulation.empty() ? "" : list("formulation", text("type", formulation))));
}
std::string stepping(double end, double step) {
  return list("stepping", of_type("end time", "double", std::to_string(end)) + of_type("step", "double", std::to_string(step)));
}
std::string place_of(const std::string& body) {
  std::string content;
  for (const std::string component : {"x", "y"})
    content += list("u" + component, text("type", "mean") + text("field", "displacement " + component) + text("on", body));
  return list("quantities", content);
}

struct Run {
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

Run run(const std::string& name, const std::string& content, int ranks, Words settings = {}) {
  const std::filesystem::path directory = std::filesystem::path(SCRATCH);
  std::filesystem::create_directories(directory);
  const std::string scene = directory / (name + ".xml"), results = directory / name;
  const std::string soft = list("materials", list("soft", text("type", "neo hooke") + of_type("young's modulus", "double", "1000") +
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

// With little friction it is ejected: squeezed out by walls whose normals meet at an angle. It goes up by half of the wall's motion, 0.05, and no
// further.
TEST(States, ADiskThatIsShotOutIsNotAccepted) {
  for (const std::string formulation : {"", "standard mortar", "penalty"})
    for (const int ranks : {1, 2}) {
      if (!formulation.empty() && ranks > 1) continue;
      const Run result = run("ejected", rolling_disk(0.01, formulation), ranks);
      EXPECT_LT(std::abs(result.quantity("uy")), 0.1) << formulation;
      if (result.code == 0) continue;
      EXPECT_EQ(result.code, 3) << result.output;
      EXPECT_NE(result.output.find("free to move: body 'ball' (translation in y"), std::string::npos) << result.output;
    }
}

TEST(States, ADiskThatRollsIsAccepted) {
  const Run result = run("rolls", rolling_disk(0.3), 1);
  EXPECT_EQ(result.code, 0) << result.output;
  EXPECT_NEAR(result.quantity("uy"), 0.025, 0.003);  // half of the wall's motion
  EXPECT_EQ(result.count("free to move"), 0) << result.output;
}

// Both surfaces of the middle block slip in the end, with friction that is the same on both: nothing says where it is.
TEST(States, ABlockThatLosesItsGripIsNotAccepted) {
  const std::string scene =
      list("bodies", block("low", 3.0, 1.0, 9, 3, "-1.5, -1") + block("mid", 1.0, 1.0, 4, 4, "-0.5, 0") + block("top", 3.0, 1.0, 10, 3, "-1.5, 1")) +
      list("boundary conditions", condition("low", "low/bottom", {{"x", "0"}, {"y", "0"}}) +
                                      condition("top", "top/top", {{"x", "0.3*max(0,t-0.25)"}, {"y", "-0.05*min(1,4*t)"}})) +
      list("contact", pair("below", "mid/bottom", "low/top", 0.2) + pair("above", "mid/top", "top/bottom", 0.2)) + stepping(1.0, 0.05) +
      place_of("mid");
  for (const int ranks : {1, 3}) {
    const Run result = run("gripped", scene, ranks);
    EXPECT_EQ(result.code, 3) << result.output;
    EXPECT_NE(result.output.find("free to move: body 'mid' (translation in x"), std::string::npos) << result.output;
    EXPECT_GT(result.last_time(), 0.35);  // it still sticks there
    EXPECT_LT(std::abs(result.quantity("ux")), 0.3 * (result.last_time() - 0.25) + 1e-9);
  }
}

}  // namespace
