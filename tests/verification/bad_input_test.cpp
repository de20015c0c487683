// Every kind of bad input: exit code, message with file and line, nothing written; on one rank and on two.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "launch.hpp"

namespace {

namespace files = std::filesystem;

/// Two blocks on each other: a scene without errors.
const std::string good_scene = R"(<ParameterList name="two blocks">
  <Parameter name="kinematics" type="string" value="plane strain"/>
  <ParameterList name="tables">
    <ParameterList name="ramp">
      <Parameter name="times" type="string" value="0, 1"/>
      <Parameter name="values" type="string" value="0, 1"/>
    </ParameterList>
  </ParameterList>
  <ParameterList name="materials">
    <ParameterList name="soft">
      <Parameter name="type" type="string" value="neo hooke"/>
      <Parameter name="young's modulus" type="double" value="1000"/>
      <Parameter name="poisson's ratio" type="double" value="0.3"/>
    </ParameterList>
  </ParameterList>
  <ParameterList name="bodies">
    <ParameterList name="upper">
      <Parameter name="material" type="string" value="soft"/>
      <Parameter name="element" type="string" value="Q4"/>
      <ParameterList name="mesh">
        <Parameter name="type" type="string" value="block"/>
        <Parameter name="corners" type="string" value="0, 1, 1, 1, 1, 2, 0, 2"/>
        <Parameter name="cells x" type="int" value="2"/>
        <Parameter name="cells y" type="int" value="2"/>
      </ParameterList>
    </ParameterList>
    <ParameterList name="lower">
      <Parameter name="material" type="string" value="soft"/>
      <ParameterList name="mesh">
        <Parameter name="type" type="string" value="block"/>
        <Parameter name="cells x" type="int" value="3"/>
        <Parameter name="cells y" type="int" value="2"/>
      </ParameterList>
    </ParameterList>
  </ParameterList>
  <ParameterList name="sets">
    <ParameterList name="seat">
      <Parameter name="of" type="string" value="lower/top"/>
      <Parameter name="kind" type="string" value="sides"/>
      <Parameter name="where" type="string" value="2 - x"/>
    </ParameterList>
  </ParameterList>
  <ParameterList name="boundary conditions">
    <ParameterList name="floor">
      <Parameter name="set" type="string" value="lower/bottom"/>
      <Parameter name="x" type="double" value="0"/>
      <Parameter name="y" type="double" value="0"/>
    </ParameterList>
    <ParameterList name="side">
      <Parameter name="set" type="string" value="upper/left"/>
      <Parameter name="x" type="string" value="0*t"/>
    </ParameterList>
  </ParameterList>
  <ParameterList name="loads">
    <ParameterList name="pressure">
      <Parameter name="type" type="string" value="follower pressure"/>
      <Parameter name="set" type="string" value="upper/top"/>
      <Parameter name="pressure" type="string" value="ramp(t)"/>
    </ParameterList>
  </ParameterList>
  <ParameterList name="contact">
    <ParameterList name="interface">
      <Parameter name="slave" type="string" value="seat"/>
      <Parameter name="master" type="string" value="upper/bottom"/>
    </ParameterList>
  </ParameterList>
</ParameterList>
)";

/// One thing done wrong: `from` is replaced by `to` in the good scene.
struct Case {
  std::string name, from, to;
  std::string message;  ///< has to stand in the output
  std::string marker;   ///< text of the line that the message has to point at; empty: any line
  int code = 2;
};

void PrintTo(const Case& bad, std::ostream* out) { *out << bad.name; }

int line_of(const std::string& text, const std::string& marker) {
  const auto position = text.find(marker);
  return position == std::string::npos ? -1 : 1 + static_cast<int>(std::count(text.begin(), text.begin() + position, '\n'));
}

const std::string second_pair = R"(<ParameterList name="second">
      <Parameter name="slave" type="string" value="lower/top"/>
      <Parameter name="master" type="string" value="upper/right"/>
    </ParameterList>
    <ParameterList name="interface">)";

const std::vector<Case> cases {
  {"unknown_parameter", R"(<ParameterList name="tables">)", R"(<Parameter name="colour" type="string" value="red"/><ParameterList name="tables">)",
   "colour", R"(name="colour")"},
      {"misspelt_parameter", R"("cells x" type="int" value="2")", R"("cels x" type="int" value="2")", "did you mean \"cells x\"", "cels x"},
      {"misspelt_list", R"(name="contact">)", R"(name="contacts">)", "did you mean \"contact\"", R"(name="contacts")"},
      {"duplicate_parameter", R"(<Parameter name="poisson's ratio")",
       R"(<Parameter name="young's modulus" type="double" value="2"/><Parameter name="poisson's ratio")", "young's modulus",
       R"(value="2"/><Parameter)"},
      {"mistyped", R"(value="1000")", R"(value="5x")", "5x", R"(value="5x")"},
      {"out_of_range", R"(value="0.3")", R"(value="0.7")", "poisson's ratio", R"(value="0.7")"}, {"broken_expression", R"(value="ramp(t)")", R"(value="ramp(t")", "ramp(t", R"(value="ramp(t")"},
    {"unknown_variable", R"(value="ramp(t)")", R"(value="speed*t")", "speed", "speed*t"},
    {"unknown_material", R"(name="material" type="string" value="soft"/>
      <Parameter name="element")", R"(name="material" type="string" value="sofd"/>
      <Parameter name="element")", "did you mean \"soft\"", "sofd"},
    {"missing_set", R"(value="upper/left")", R"(value="upper/lefd")", "upper/lefd", "upper/lefd"},
    {"missing_contact_set", R"(value="upper/bottom")", R"(value="upper/botom")", "upper/botom", "upper/botom"},
    {"empty_surface", R"(value="2 - x")", R"(value="x - 2")", "seat", R"(name="seat")"},
    {"inverted_elements", R"(value="0, 1, 1, 1, 1, 2, 0, 2")", R"(value="0, 2, 1, 2, 1, 1, 0, 1")", "upper", ""},
    {"body_that_nothing_holds", R"(value="upper/left")", R"(value="lower/left")", "body 'upper' can move: translation in x", R"(name="upper")"},
    {"body_in_the_air", R"(value="0, 1, 1, 1, 1, 2, 0, 2")", R"(value="0, 8, 1, 8, 1, 9, 0, 9")", "body 'upper' can move: translation in y", R"(name="upper")"},
    {"slave_is_master", R"(<Parameter name="master" type="string" value="upper/bottom"/>)", R"(<Parameter name="master" type="string" value="seat"/>)", "slave and master",
     R"(name="master" type="string" value="seat")"},
    {"slave_node_in_two_pairs", R"(<ParameterList name="interface">)", second_pair, "slave", ""},
    {"slave_facet_with_all_nodes_fixed", R"(value="lower/bottom"/>)", R"(value="lower"/>)", "make this side the master", ""},
    {"nan_in_a_table", R"(name="values" type="string" value="0, 1")", R"(name="values" type="string" value="0, nan")", "nan", "0, nan"},
    {"malformed_xml", R"(<ParameterList name="loads">)", R"(<ParameterList name="loads")", "scene.xml:", ""},
    {"unknown_check_quantity", R"(<ParameterList name="contact">)", R"(<ParameterList name="checks"><ParameterList name="c">
      <Parameter name="quantity" type="string" value="forse"/><Parameter name="low" type="double" value="0"/></ParameterList></ParameterList>
  <ParameterList name="contact">)", "forse", "forse"},
};

class BadInput : public ::testing::TestWithParam<std::tuple<Case, int>> {};

std::string replaced(std::string text, const std::string& from, const std::string& to) {
      const auto position = text.find(from);
      EXPECT_NE(position, std::string::npos) << from;
      return position == std::string::npos ? text : text.replace(position, from.size(), to);
}

/// Runs a scene in a fresh directory of its own; its results would go to <directory>/results.
Ending run(const files::path& directory, const std::string& scene, int ranks, const std::vector<std::string>& more = {}) {
      files::remove_all(directory);
      files::create_directories(directory);
      std::ofstream(directory / "scene.xml") << scene;
      std::vector<std::string> command{MPIEXEC, "-n", std::to_string(ranks), MORTISE, "run", directory / "scene.xml", "-o", directory / "results"};
      command.insert(command.end(), more.begin(), more.end());
      return launch(command, 60);
}

void expect_nothing_but_the_log(const files::path& results) {
      if (!files::exists(results)) return;
      for (const auto& entry : files::directory_iterator(results)) EXPECT_EQ(entry.path().filename(), "log.txt");
}

TEST_P(BadInput, IsRefusedWithFileAndLine) {
      const auto& [bad, ranks] = GetParam();
      const files::path directory = files::path(SCRATCH) / fmt::format("{}_np{}", bad.name, ranks);
      const std::string scene = replaced(good_scene, bad.from, bad.to);
      const Ending ending = run(directory, scene, ranks);
      EXPECT_EQ(ending.code, bad.code) << ending.output;
      EXPECT_NE(ending.output.find(bad.message), std::string::npos) << ending.output;
      const std::string place = bad.marker.empty() ? "scene.xml:" : fmt::format("scene.xml:{}: error", line_of(scene, bad.marker));
      EXPECT_NE(ending.output.find(place), std::string::npos) << "expected " << place << " in\n" << ending.output;
      expect_nothing_but_the_log(directory / "results");
}

INSTANTIATE_TEST_SUITE_P(Scenes, BadInput, ::testing::Combine(::testing::ValuesIn(cases), ::testing::Values(1, 2)),
                         [](const auto& info) {
      return fmt::format("{}_np{}", std::get<0>(info.param).name, std::get<1>(info.param)); });

TEST(GoodScene, Runs) {
      for (const int ranks : {1, 2}) {
        const Ending ending = run(files::path(SCRATCH) / fmt::format("good_np{}", ranks), good_scene, ranks);
        EXPECT_EQ(ending.code, 0) << ending.output;
      }
}

TEST(BadInputs, AreAllReportedAtOnce) {
      std::string scene = replaced(good_scene, R"(value="1000")", R"(value="5x")");
      scene = replaced(scene, R"("cells x" type="int" value="2")", R"("cels x" type="int" value="2")");
      scene = replaced(scene, R"(name="contact">)", R"(name="contacts">)");
      const Ending ending = run(files::path(SCRATCH) / "all_at_once", scene, 1);
      EXPECT_EQ(ending.code, 2);
      for (const char* wrong : {"5x", "cels x", "contacts"}) EXPECT_NE(ending.output.find(wrong), std::string::npos) << ending.output;
}

TEST(Files, AMissingSceneIsAFileError) {
      for (const int ranks : {1, 2}) {
        const Ending ending = launch({MPIEXEC, "-n", std::to_string(ranks), MORTISE, "run", std::string(SCRATCH) + "/no_such_scene.xml"}, 60);
        EXPECT_EQ(ending.code, 5) << ending.output;
        EXPECT_NE(ending.output.find("no_such_scene.xml"), std::string::npos) << ending.output;
      }
}

TEST(Files, OutputThatCannotBeWrittenIsAFileError) {
      for (const int ranks : {1, 2}) {
        // A file stands where the directory should be: that stops root too.
        const files::path directory = files::path(SCRATCH) / fmt::format("unwritable_np{}", ranks);
        files::remove_all(directory);
        files::create_directories(directory);
        std::ofstream(directory / "scene.xml") << good_scene;
        std::ofstream(directory / "results") << "a file";
        const Ending ending =
            launch({MPIEXEC, "-n", std::to_string(ranks), MORTISE, "run", directory / "scene.xml", "-o", directory / "results"}, 60);
        EXPECT_EQ(ending.code, 5) << ending.output;
        EXPECT_NE(ending.output.find("results"), std::string::npos) << ending.output;
        EXPECT_EQ(read_file(directory / "results"), "a file");
      }
}

  }  // namespace
