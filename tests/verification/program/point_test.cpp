// `mortise point`: files, exit codes, errors with their lines, with and without matplotlib; on one rank and on two.

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "launch.hpp"
#include "scene_text.hpp"

namespace {

namespace files = std::filesystem;

/// The python that draws: the one that is found, or none, which saves a second.
const std::string any_python = "", no_python = "/nowhere/python3";

Ending mortise(std::vector<std::string> words, int ranks = 1, const std::string& python = no_python) {
  std::vector<std::string> command{MPIEXEC, "-n", std::to_string(ranks), MORTISE};
  if (python != any_python) command.insert(command.begin(), {"env", "MORTISE_PYTHON=" + python});
  command.insert(command.end(), words.begin(), words.end());
  return launch(command, 120);
}

using scene_text::parameter;

const std::string directory = std::string(SCRATCH) + "/point";

/// A point file; `type` stands in line 2, `path` from line 7 on.
std::string write_point(const std::string& name, const std::string& type, const std::string& path) {
  files::create_directories(directory);
  const std::string file = directory + "/" + name + ".xml";
  std::ofstream(file) << "<ParameterList name=\"test\"><ParameterList name=\"material\">\n" + parameter("type", type) +
                             parameter("young's modulus", "1000") + parameter("poisson's ratio", "0.3") +
                             "</ParameterList>\n<ParameterList name=\"path\">\n" + path + "</ParameterList></ParameterList>\n";
  return file;
}

std::string uniaxial(const std::string& stretch) {
  return parameter("type", "uniaxial") + parameter("final stretch", stretch) + parameter("steps", "5");
}

std::vector<std::string> lines_of(const std::string& file) {
  std::istringstream text(read_file(file));
  std::vector<std::string> lines;
  for (std::string line; std::getline(text, line);) lines.push_back(line);
  return lines;
}

TEST(Point, LeavesTheCurveItsEndAndItsPlot) {
  const std::string file = write_point("tension", "hencky", uniaxial("1.5")), results = directory + "/tension";
  std::string first;
  for (const int ranks : {1, 2}) {
    files::remove_all(results);
    const Ending ending = mortise({"point", file, "-o", results}, ranks, any_python);
    ASSERT_EQ(ending.code, 0) << ending.output;
    for (const char* name : {"point.csv", "summary.json", "effective.xml"}) EXPECT_TRUE(files::exists(results + "/" + name)) << name;
    // With matplotlib both images; without, a line that says what to install.
    const bool drawn = ending.output.find("python3-matplotlib") == std::string::npos;
    EXPECT_EQ(files::exists(results + "/point.svg"), drawn) << ending.output;
    EXPECT_EQ(files::exists(results + "/point.png"), drawn) << ending.output;
    const auto summary = nlohmann::json::parse(read_file(results + "/summary.json"));
    EXPECT_EQ(summary.at("exit"), 0);
    EXPECT_EQ(summary.at("converged"), true);
    EXPECT_EQ(summary.at("steps"), 5);
    const auto& at_end = summary.at("quantities");
    EXPECT_NEAR(at_end.at("kirchhoff_11").get<double>(), 1000.0 * std::log(1.5), 1e-9);
    EXPECT_NEAR(at_end.at("cauchy_11").get<double>(), 1000.0 * std::log(1.5) / std::pow(1.5, 0.4), 1e-9);
    EXPECT_NEAR(at_end.at("strain_11").get<double>(), std::log(1.5), 1e-12);
    EXPECT_EQ(at_end.at("equivalent_plastic_strain"), 0.0);
    const auto lines = lines_of(results + "/point.csv");
    ASSERT_EQ(lines.size(), 7u);
    EXPECT_EQ(lines[0].rfind("t,F11,F12,", 0), 0u) << lines[0];
    EXPECT_EQ(lines[1].rfind("0,1,0,", 0), 0u) << lines[1];
    if (ranks == 1) first = read_file(results + "/point.csv");
  }
  EXPECT_EQ(read_file(results + "/point.csv"), first);
}

TEST(Point, EffectiveFileGivesTheSameCurve) {
  const std::string file = write_point("again", "neo hooke", uniaxial("1 + x_"));
  for (const char* name : {"/once", "/twice"}) files::remove_all(directory + name);
  EXPECT_EQ(mortise({"point", file, "--set", "variables/x_=0.25", "-o", directory + "/once"}).code, 0);
  EXPECT_EQ(mortise({"point", directory + "/once/effective.xml", "-o", directory + "/twice"}).code, 0);
  EXPECT_EQ(read_file(directory + "/once/point.csv"), read_file(directory + "/twice/point.csv"));
  EXPECT_EQ(read_file(directory + "/once/effective.xml"), read_file(directory + "/twice/effective.xml"));
}

TEST(Point, EveryTutorialFileRuns) {
  int count = 0;
  for (const auto& entry : files::directory_iterator(TUTORIALS)) {
    if (entry.path().filename().string().rfind("point_", 0) != 0) continue;
    const std::string results = directory + "/" + entry.path().stem().string();
    files::remove_all(results);
    const Ending ending = mortise({"point", entry.path(), "-o", results}, 1, any_python);
    EXPECT_EQ(ending.code, 0) << ending.output;
    EXPECT_EQ(nlohmann::json::parse(read_file(results + "/summary.json")).at("converged"), true);
    ++count;
  }
  EXPECT_GE(count, 3);
}

TEST(Point, NoLateralStretchIsCode3AndKeepsWhatCameBefore) {
  const std::string file = write_point("failing", "st venant kirchhoff", uniaxial("6")), results = directory + "/failing";
  files::remove_all(results);
  for (const int ranks : {1, 2}) {
    const Ending ending = mortise({"point", file, "-o", results}, ranks);
    EXPECT_EQ(ending.code, 3) << ending.output;
    EXPECT_NE(ending.output.find("step 2 (t = 0.4): no lateral stretch"), std::string::npos) << ending.output;
    const auto summary = nlohmann::json::parse(read_file(results + "/summary.json"));
    EXPECT_EQ(summary.at("exit"), 3);
    EXPECT_EQ(summary.at("steps"), 1);
    EXPECT_EQ(lines_of(results + "/point.csv").size(), 3u);
  }
}

TEST(Point, BadInputIsCode2WithEveryLineAndLeavesEarlierResultsAlone) {
  const std::string results = directory + "/kept";
  files::remove_all(results);
  ASSERT_EQ(mortise({"point", write_point("good", "hencky", uniaxial("1.1")), "-o", results}).code, 0);
  const std::string before = read_file(results + "/point.csv"),
                    file = write_point("bad", "henky", parameter("type", "uniaxial") + parameter("final stretch", "0"));
  for (const int ranks : {1, 2}) {
    const Ending ending = mortise({"point", file, "-o", results}, ranks);
    EXPECT_EQ(ending.code, 2) << ending.output;
    EXPECT_NE(ending.output.find("bad.xml:2: error: material: \"type\" is \"henky\""), std::string::npos) << ending.output;
    EXPECT_NE(ending.output.find("did you mean \"hencky\"?"), std::string::npos) << ending.output;
    EXPECT_NE(ending.output.find("bad.xml:8: error: path: \"final stretch\" is 0; allowed: > 0"), std::string::npos) << ending.output;
  }
  const Ending ending =
      mortise({"point", write_point("endless", "hencky", parameter("type", "simple shear") + parameter("shear", "1/(1 - t)")), "-o", results});
  EXPECT_EQ(ending.code, 2) << ending.output;
  EXPECT_NE(ending.output.find("endless.xml:8: error: path: \"1/(1 - t)\" is inf at t = 1"), std::string::npos) << ending.output;
  EXPECT_EQ(read_file(results + "/point.csv"), before);
}

TEST(Point, FilesThatCannotBeReadOrWrittenAreCode5) {
  EXPECT_EQ(mortise({"point", directory + "/nowhere.xml"}, 2).code, 5);
  EXPECT_EQ(mortise({"point", write_point("unwritten", "hencky", uniaxial("1.1")), "-o", "/proc/nowhere"}, 2).code, 5);
  const std::string file = write_point("held", "hencky", uniaxial("1.1")), results = directory + "/held";
  files::remove_all(results);
  EXPECT_EQ(mortise({"point", file, "-o", results, "--keep"}).code, 0);
  EXPECT_EQ(mortise({"point", file, "-o", results, "--keep"}).code, 5);
  EXPECT_EQ(mortise({"point"}).code, 1);
}

TEST(Point, WithoutPythonTheTableIsThereAndOneLineSaysWhatToInstall) {
  const std::string results = directory + "/no_python";
  files::remove_all(results);
  for (const int ranks : {1, 2}) {
    const Ending ending = mortise({"point", write_point("no_python", "hencky", uniaxial("1.1")), "-o", results}, ranks, no_python);
    EXPECT_EQ(ending.code, 0) << ending.output;
    EXPECT_NE(ending.output.find("please install python3-matplotlib"), std::string::npos) << ending.output;
    EXPECT_TRUE(files::exists(results + "/point.csv"));
    EXPECT_FALSE(files::exists(results + "/point.svg"));
  }
}

TEST(Point, APlotThatFailsIsCode5) {
  files::remove_all(directory + "/no_plot");
  const Ending ending = mortise({"point", write_point("no_plot", "hencky", uniaxial("1.1")), "-o", directory + "/no_plot"}, 2, "/bin/false");
  EXPECT_EQ(ending.code, 5) << ending.output;
  EXPECT_NE(ending.output.find("cannot draw"), std::string::npos) << ending.output;
}

TEST(Point, IsDescribed) {
  EXPECT_NE(mortise({"describe", "point"}).output.find("stress unit"), std::string::npos);
  EXPECT_NE(mortise({"describe", "point/path"}).output.find("final stretch"), std::string::npos);
  EXPECT_NE(mortise({"list", "hardening"}).output.find("ludwik"), std::string::npos);
  EXPECT_NE(mortise({"list", "paths"}).output.find("simple shear"), std::string::npos);
  const Ending ending = mortise({"describe", "point/pth"});
  EXPECT_EQ(ending.code, 2);
  EXPECT_NE(ending.output.find("there is no list of a point file \"pth\"; did you mean \"path\"? There are: \"material\", \"path\""),
            std::string::npos)
      << ending.output;
}

}  // namespace
