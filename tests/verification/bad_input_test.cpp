// Every kind of bad input: exit code, message with file and line, nothing written; on one rank and on two.

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "launch.hpp"

namespace {

namespace files = std::filesystem;

/// Two blocks on each other: a scene without errors.
const std::string good_scene = R"xml(<ParameterList name="two blocks">
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
)xml";

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

const std::string second_pair = R"xml(<ParameterList name="second">
      <Parameter name="slave" type="string" value="lower/top"/>
      <Parameter name="master" type="string" value="upper/right"/>
    </ParameterList>
    <ParameterList name="interface">)xml";

/// The good scene's master with a list "friction" of this type.
std::string with_friction(const std::string& type) {
  return R"xml(value="upper/bottom"/>
      <ParameterList name="friction"><Parameter name="type" type="string" )xml" +
         type + "</ParameterList>";
}

const std::vector<Case> cases{
    {"unknown_parameter", R"xml(<ParameterList name="tables">)xml",
     R"xml(<Parameter name="colour" type="string" value="red"/><ParameterList name="tables">)xml", "colour", R"xml(name="colour")xml"},
    {"misspelt_parameter", R"xml("cells x" type="int" value="2")xml", R"xml("cels x" type="int" value="2")xml", "did you mean \"cells x\"", "cels x"},
    {"misspelt_list", R"xml(name="contact">)xml", R"xml(name="contacts">)xml", "did you mean \"contact\"", R"xml(name="contacts")xml"},
    {"duplicate_parameter", R"xml(<Parameter name="poisson's ratio")xml",
     R"xml(<Parameter name="young's modulus" type="double" value="2"/><Parameter name="poisson's ratio")xml", "young's modulus",
     R"xml(value="2"/><Parameter)xml"},
    {"mistyped", R"xml(value="1000")xml", R"xml(value="5x")xml", "5x", R"xml(value="5x")xml"},
    {"out_of_range", R"xml(value="0.3")xml", R"xml(value="0.7")xml", "poisson's ratio", R"xml(value="0.7")xml"},
    {"broken_expression", R"xml(value="ramp(t)")xml", R"xml(value="ramp(t")xml", "ramp(t", R"xml(value="ramp(t")xml"},
    {"unknown_variable", R"xml(value="ramp(t)")xml", R"xml(value="speed*t")xml", "speed", "speed*t"},
    {"unknown_material", R"xml(name="material" type="string" value="soft"/>
      <Parameter name="element")xml",
     R"xml(name="material" type="string" value="sofd"/>
      <Parameter name="element")xml",
     "did you mean \"soft\"", "sofd"},
    {"missing_set", R"xml(value="upper/left")xml", R"xml(value="upper/lefd")xml", "upper/lefd", "upper/lefd"},
    {"missing_contact_set", R"xml(value="upper/bottom")xml", R"xml(value="upper/botom")xml", "upper/botom", "upper/botom"},
    {"empty_surface", R"xml(value="2 - x")xml", R"xml(value="x - 2")xml", "seat", R"xml(name="seat")xml"},
    {"inverted_elements", R"xml(value="0, 1, 1, 1, 1, 2, 0, 2")xml", R"xml(value="0, 2, 1, 2, 1, 1, 0, 1")xml", "upper", ""},
    {"body_that_nothing_holds", R"xml(value="upper/left")xml", R"xml(value="lower/left")xml", "body 'upper' can move: translation in x",
     R"xml(name="upper")xml"},
    {"body_in_the_air", R"xml(value="0, 1, 1, 1, 1, 2, 0, 2")xml", R"xml(value="0, 8, 1, 8, 1, 9, 0, 9")xml",
     "body 'upper' can move: translation in y", R"xml(name="upper")xml"},
    {"slave_is_master", R"xml(<Parameter name="master" type="string" value="upper/bottom"/>)xml",
     R"xml(<Parameter name="master" type="string" value="seat"/>)xml", "slave and master", R"xml(name="master" type="string" value="seat")xml"},
    {"slave_node_in_two_pairs", R"xml(<ParameterList name="interface">)xml", second_pair, "a node can be slave in one pair only",
     R"xml(<ParameterList name="interface">)xml"},
    {"slave_facet_with_all_nodes_fixed", R"xml(value="lower/bottom"/>)xml", R"xml(value="lower"/>)xml",
     "of 3 slave facets can carry no contact, as the displacements of all their nodes are prescribed; please make this side the master", "interface"},
    {"nan_in_a_table", R"xml(name="values" type="string" value="0, 1")xml", R"xml(name="values" type="string" value="0, nan")xml", "nan", "0, nan"},
    {"decimal_comma", R"xml(value="0.3")xml", R"xml(value="0,3")xml", "the decimal sign is a point", R"xml(value="0,3")xml"},
    {"assignment", R"xml(value="ramp(t)")xml", R"xml(value="t=1 ? 1 : 0")xml", "\"==\" compares", "t=1 ?"},
    {"field_twice", R"xml(<ParameterList name="contact">)xml", R"xml(<ParameterList name="output">
      <Parameter name="fields" type="string" value="displacement, gap, displacement"/></ParameterList>
  <ParameterList name="contact">)xml",
     "\"displacement\" twice", "displacement, gap"},
    {"unknown_field", R"xml(<ParameterList name="contact">)xml", R"xml(<ParameterList name="output">
      <Parameter name="fields" type="string" value="displacment"/></ParameterList>
  <ParameterList name="contact">)xml",
     "there is no field \"displacment\"; did you mean \"displacement\"? There are: \"displacement\", ", "displacment"},
    {"too_many_numbers", R"xml(<Parameter name="corners" type="string" value="0, 1, 1, 1, 1, 2, 0, 2"/>)xml",
     R"xml(<Parameter name="translation" type="string" value="0, 1, 2"/>)xml", "\"translation\": is \"0, 1, 2\"; it needs two numbers", "0, 1, 2"},
    {"variable_without_a_name", R"xml(<ParameterList name="tables">)xml",
     R"xml(<ParameterList name="variables"><Parameter name="" type="double" value="1"/></ParameterList><ParameterList name="tables">)xml",
     "variables: <Parameter> without \"name\"", R"xml(<Parameter name="")xml"},
    {"variable_of_itself", R"xml(<ParameterList name="tables">)xml",
     R"xml(<ParameterList name="variables"><Parameter name="a" type="string" value="a + 1"/></ParameterList><ParameterList name="tables">)xml",
     "variables: \"a\": cannot evaluate \"a + 1\"", "a + 1"},
    {"component_z_in_the_plane", R"xml(<ParameterList name="contact">)xml", R"xml(<ParameterList name="quantities"><ParameterList name="force">
      <Parameter name="type" type="string" value="contact force"/>
      <Parameter name="component" type="string" value="z"/></ParameterList></ParameterList>
  <ParameterList name="contact">)xml",
     "quantities/force: \"component\" is \"z\"", R"xml(name="force")xml"},
    {"quantity_called_time", R"xml(<ParameterList name="contact">)xml", R"xml(<ParameterList name="quantities"><ParameterList name="time">
      <Parameter name="type" type="string" value="contact force"/></ParameterList></ParameterList>
  <ParameterList name="contact">)xml",
     "a column of history.csv is called \"time\" already", ""},
    {"steps_without_end", R"xml(<ParameterList name="contact">)xml", R"xml(<ParameterList name="stepping">
      <Parameter name="step" type="double" value="1e-20"/></ParameterList>
  <ParameterList name="contact">)xml",
     "\"step\": is 1e-20 of an \"end time\" of 1", "1e-20"},
    {"minimum_above_step", R"xml(<ParameterList name="contact">)xml", R"xml(<ParameterList name="stepping">
      <Parameter name="minimum step" type="double" value="3"/></ParameterList>
  <ParameterList name="contact">)xml",
     "\"minimum step\": is 3, larger than \"step\", 1", R"xml(name="minimum step")xml"},
    {"too_many_cells", R"xml("cells x" type="int" value="3")xml", R"xml("cells x" type="int" value="2000000000")xml", "allowed: >= 0 and <= 500000",
     "2000000000"},
    {"more_dofs_than_can_be_numbered", R"xml("cells x" type="int" value="3"/>
        <Parameter name="cells y" type="int" value="2"/>)xml",
     R"xml("cells x" type="int" value="100000"/>
        <Parameter name="cells y" type="int" value="100000"/>)xml",
     "the mesh of body 'lower' would have 10000000000 elements and 10000200001 nodes; the model's 2e+10 dofs are more than the",
     R"xml(name="lower")xml"},
    {"smallest_cell_too_small", R"xml("cells x" type="int" value="3"/>)xml",
     R"xml("cells x" type="int" value="0"/>
        <ParameterList name="grading x"><Parameter name="smallest cell" type="double" value="1e-9"/>
          <Parameter name="refined length" type="double" value="1"/></ParameterList>)xml",
     "asks for more than 500000 cells", R"xml(name="lower")xml"},
    {"malformed_xml", R"xml(<ParameterList name="loads">)xml", R"xml(<ParameterList name="loads")xml", "scene.xml:", ""},
    {"unknown_check_quantity", R"xml(<ParameterList name="contact">)xml", R"xml(<ParameterList name="checks"><ParameterList name="c">
      <Parameter name="quantity" type="string" value="forse"/><Parameter name="low" type="double" value="0"/></ParameterList></ParameterList>
  <ParameterList name="contact">)xml",
     "forse", "forse"},
    {"unknown_friction_law", R"xml(value="upper/bottom"/>)xml", with_friction(R"xml(value="columb"/>)xml"), "did you mean \"coulomb\"", "columb"},
    {"unknown_name_in_a_friction_coefficient", R"xml(value="upper/bottom"/>)xml", with_friction(R"xml(value="coulomb"/>
      <Parameter name="coefficient" type="string" value="0.1*speed"/>)xml"),
     "known names: pressure, slip", "0.1*speed"},
    {"negative_friction_coefficient", R"xml(value="upper/bottom"/>)xml", with_friction(R"xml(value="coulomb"/>
      <Parameter name="coefficient" type="double" value="-0.1"/>)xml"),
     "allowed: >= 0", R"xml(value="-0.1")xml"},
    {"no_hardening", R"xml(value="neo hooke")xml", R"xml(value="j2 plasticity")xml", "hardening", R"xml(name="soft">)xml"},
    {"formula_of_what_comes_later", R"xml(<ParameterList name="contact">)xml", R"xml(<ParameterList name="quantities"><ParameterList name="ratio">
      <Parameter name="type" type="string" value="formula"/><Parameter name="value" type="string" value="2*force"/></ParameterList>
    <ParameterList name="force"><Parameter name="type" type="string" value="contact force"/></ParameterList></ParameterList>
  <ParameterList name="contact">)xml",
     "known names: t", "2*force"},
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

TEST_P(BadInput, IsRefusedWithFileAndLine) {
  const auto& [bad, ranks] = GetParam();
  const files::path directory = files::path(SCRATCH) / fmt::format("{}_np{}", bad.name, ranks);
  const std::string scene = replaced(good_scene, bad.from, bad.to);
  const Ending ending = run(directory, scene, ranks);
  EXPECT_EQ(ending.code, bad.code) << ending.output;
  EXPECT_NE(ending.output.find(bad.message), std::string::npos) << ending.output;
  const std::string place = bad.marker.empty() ? "scene.xml:" : fmt::format("scene.xml:{}: error", line_of(scene, bad.marker));
  EXPECT_NE(ending.output.find(place), std::string::npos) << "expected " << place << " in\n" << ending.output;
  EXPECT_FALSE(files::exists(directory / "results"));
}

INSTANTIATE_TEST_SUITE_P(Scenes, BadInput, ::testing::Combine(::testing::ValuesIn(cases), ::testing::Values(1, 2)),
                         [](const auto& info) { return fmt::format("{}_np{}", std::get<0>(info.param).name, std::get<1>(info.param)); });

/// The good scene with a linear solver, as `inner` says.
std::string with_solver(const std::string& inner) {
  return replaced(good_scene, R"xml(  <ParameterList name="contact">)xml",
                  "  <ParameterList name=\"linear solver\">\n" + inner + "\n  </ParameterList>\n  <ParameterList name=\"contact\">");
}

TEST(LinearSolver, Klu2OnTwoRanksIsRefusedWithFileAndLine) {
  const std::string type = R"xml(<Parameter name="type" type="string" value="klu2"/>)xml", scene = with_solver(type);
  const files::path directory = files::path(SCRATCH) / "klu2";
  EXPECT_EQ(run(directory, scene, 1).code, 0);
  const Ending ending = run(directory, scene, 2);
  EXPECT_EQ(ending.code, 2);
  EXPECT_NE(ending.output.find(fmt::format("scene.xml:{}: error: linear solver", line_of(scene, type))), std::string::npos) << ending.output;
  EXPECT_NE(ending.output.find("klu2 runs on one rank only"), std::string::npos) << ending.output;
}

TEST(LinearSolver, AMisspeltParameterOfMueLuIsRefusedWithFileAndLine) {
  const std::string muelu = R"xml(<ParameterList name="muelu">)xml";
  const std::string scene = with_solver(R"xml(<Parameter name="type" type="string" value="iterative"/>)xml"
                                        "\n" +
                                        muelu + R"xml(<Parameter name="max levles" type="int" value="3"/></ParameterList>)xml");
  const Ending ending = run(files::path(SCRATCH) / "muelu", scene, 1);
  EXPECT_EQ(ending.code, 2);
  EXPECT_NE(ending.output.find(fmt::format("scene.xml:{}: error: linear solver/muelu", line_of(scene, muelu))), std::string::npos) << ending.output;
  EXPECT_NE(ending.output.find(R"(linear solver/muelu: "max levles" is no parameter of MueLu; did you mean "max levels"? They are listed in)"),
            std::string::npos)
      << ending.output;
  const auto message = ending.output.find(": error: ");
  EXPECT_EQ(ending.output.find('\n', message), ending.output.find("\n---", message)) << "one line, then what mpiexec has to say:\n" << ending.output;
}

TEST(LinearSolver, AParameterOfBelosOfAWrongTypeIsRefusedInOneLine) {
  const std::string belos = R"xml(<ParameterList name="belos">)xml";
  const std::string scene = with_solver(R"xml(<Parameter name="type" type="string" value="iterative"/>)xml"
                                        "\n" +
                                        belos + R"xml(<Parameter name="Maximum Iterations" type="string" value="many"/></ParameterList>)xml");
  const Ending ending = run(files::path(SCRATCH) / "belos", scene, 1);
  EXPECT_EQ(ending.code, 2);
  EXPECT_NE(ending.output.find(fmt::format("scene.xml:{}: error: linear solver/belos: Error, the parameter", line_of(scene, belos))),
            std::string::npos)
      << ending.output;
  EXPECT_NE(ending.output.find("The correct type is \"int\""), std::string::npos) << ending.output;
  const auto message = ending.output.find(": error: ");
  EXPECT_EQ(ending.output.find('\n', message), ending.output.find("\n---", message)) << "one line, then what mpiexec has to say:\n" << ending.output;
}

TEST(Kinematics, ABodyBeyondTheAxisIsRefused) {
  const std::string scene = replaced(good_scene, R"xml(value="plane strain")xml", R"xml(value="axisymmetric")xml");
  for (const int ranks : {1, 2}) {
    const files::path directory = files::path(SCRATCH) / fmt::format("beyond_the_axis_np{}", ranks);
    const Ending ending = run(directory, scene, ranks, {"--set", "bodies/lower/mesh/translation=-0.5, 0"});
    EXPECT_EQ(ending.code, 2);
    EXPECT_NE(ending.output.find("body 'lower' reaches x = -0.5, beyond the axis"), std::string::npos) << ending.output;
    EXPECT_FALSE(files::exists(directory / "results"));
  }
}

// 1e9 nodes of Q4 take 200 GB or more: each couples with the nodes of an element, 4 blocks of 2 x 2 numbers with their columns, 192 bytes.
TEST(Meshes, ThatNoMemoryHoldsAreRefusedBeforeTheyAreBuilt) {
  if (sysconf(_SC_PHYS_PAGES) > 200L * 1024 * 1024 * 1024 / sysconf(_SC_PAGESIZE)) GTEST_SKIP() << "this machine has more than 200 GiB";
  const files::path directory = files::path(SCRATCH) / "no_memory";
  files::create_directories(directory);
  std::ofstream(directory / "scene.xml") << good_scene;
  const std::vector<std::string> settings{"--set", "bodies/lower/mesh/cells x=32000", "--set", "bodies/lower/mesh/cells y=32000"};
  for (const char* command : {"check", "run"}) {
    std::vector<std::string> words{MORTISE, command, directory / "scene.xml"};
    words.insert(words.end(), settings.begin(), settings.end());
    const Ending ending = launch(words, 60);
    EXPECT_EQ(ending.code, 2) << ending.output;
    EXPECT_NE(ending.output.find("the mesh of body 'lower' would have 1024000000 elements and 1024064001 nodes; the model would take more than"),
              std::string::npos)
        << ending.output;
  }
}

TEST(GoodScene, Runs) {
  for (const int ranks : {1, 2}) {
    const Ending ending = run(files::path(SCRATCH) / fmt::format("good_np{}", ranks), good_scene, ranks);
    EXPECT_EQ(ending.code, 0) << ending.output;
  }
}

TEST(BadInputs, AreAllReportedAtOnce) {
  std::string scene = replaced(good_scene, R"xml(value="1000")xml", R"xml(value="5x")xml");
  scene = replaced(scene, R"xml("cells x" type="int" value="2")xml", R"xml("cels x" type="int" value="2")xml");
  scene = replaced(scene, R"xml(name="contact">)xml", R"xml(name="contacts">)xml");
  const Ending ending = run(files::path(SCRATCH) / "all_at_once", scene, 1);
  EXPECT_EQ(ending.code, 2);
  for (const char* wrong : {"5x", "cels x", "contacts"}) EXPECT_NE(ending.output.find(wrong), std::string::npos) << ending.output;
}

/// Expressions that have no value from some time on: the run stops there with what it has got.
struct LateCase {
  std::string name, from, to;
  std::vector<std::string> messages;
  std::string marker;
};

const std::vector<LateCase> late_cases{
    {"prescribed",
     R"xml(value="0*t")xml",
     R"xml(value="0*sqrt(0.5 - t)")xml",
     {"boundary conditions/side", "\"0*sqrt(0.5 - t)\" is", "nan at t = ", "x = 0, y = 1"},
     "0.5 - t"},
    // Only nodes at the upper left corner have no value, which one rank owns.
    {"prescribed_on_one_rank", R"xml(value="0*t")xml", R"xml(value="0*sqrt(1.75 - t*y)")xml", {"nan at t = ", "x = 0, y = 2"}, "1.75 - t*y"},
    {"load", R"xml(value="ramp(t)")xml", R"xml(value="ramp(t)/(t &lt; 0.5)")xml", {"loads/pressure", "is inf at t = "}, "ramp(t)/"},
    {"negative_friction",
     R"xml(value="upper/bottom"/>)xml",
     with_friction(R"xml(value="coulomb"/>
      <Parameter name="coefficient" type="string" value="0.1 - 0.2*pressure"/>)xml"),
     {"contact/interface/friction", "\"0.1 - 0.2*pressure\" is -", "at pressure = ", "slip = ", "allowed: >= 0",
      "slave node of reference position ("},
     "0.2*pressure"},
    {"friction_without_a_value",
     R"xml(value="upper/bottom"/>)xml",
     with_friction(R"xml(value="coulomb"/>
      <Parameter name="coefficient" type="string" value="sqrt(0.5 - pressure)"/>)xml"),
     {"nan at pressure = "},
     "0.5 - pressure"},
    {"exact_solution",
     R"xml(<ParameterList name="contact">)xml",
     R"xml(<ParameterList name="quantities"><ParameterList name="error">
      <Parameter name="type" type="string" value="error norm"/><Parameter name="field" type="string" value="contact pressure"/>
      <ParameterList name="exact"><Parameter name="type" type="string" value="uniform"/>
      <Parameter name="contact pressure" type="string" value="sqrt(0.5 - t)"/></ParameterList></ParameterList></ParameterList>
  <ParameterList name="contact">)xml",
     {"nan at t = "},
     "0.5 - t"},
};

class LateInput : public ::testing::TestWithParam<std::tuple<LateCase, int>> {};

TEST_P(LateInput, StopsTheRunAndKeepsWhatThereIs) {
  const auto& [bad, ranks] = GetParam();
  const files::path directory = files::path(SCRATCH) / fmt::format("late_{}_np{}", bad.name, ranks);
  const std::string scene = replaced(good_scene, bad.from, bad.to);
  const Ending ending = run(directory, scene, ranks, {"--set", "stepping/step=0.25"});
  EXPECT_EQ(ending.code, 2) << ending.output;
  const std::string place = fmt::format("scene.xml:{}: error: ", line_of(scene, bad.marker));
  EXPECT_NE(ending.output.find(place), std::string::npos) << "expected " << place << " in\n" << ending.output;
  for (const std::string& message : bad.messages) EXPECT_NE(ending.output.find(message), std::string::npos) << message << "\n" << ending.output;
  const auto summary = nlohmann::json::parse(read_file(directory / "results" / "summary.json"));
  EXPECT_EQ(summary["exit"], 2);
  EXPECT_FALSE(summary["converged"]);
  ASSERT_FALSE(summary["steps"].empty());
  const double reached = summary["steps"].back()["time"];
  EXPECT_GE(reached, 0.25);
  EXPECT_LT(reached, 1.0);
}

INSTANTIATE_TEST_SUITE_P(Scenes, LateInput, ::testing::Combine(::testing::ValuesIn(late_cases), ::testing::Values(1, 2)),
                         [](const auto& info) { return fmt::format("{}_np{}", std::get<0>(info.param).name, std::get<1>(info.param)); });

/// An error that shows only once the model is built.
TEST(BadInputs, LeaveAnEarlierRunAsItWas) {
  const files::path directory = files::path(SCRATCH) / "earlier_run", results = directory / "results";
  ASSERT_EQ(run(directory, good_scene, 1).code, 0);
  const std::string summary = read_file(results / "summary.json");
  const auto time = files::last_write_time(results);
  std::ofstream(directory / "scene.xml") << replaced(good_scene, R"xml(value="upper/left")xml", R"xml(value="upper/lefd")xml");
  const Ending ending = launch({MORTISE, "run", directory / "scene.xml", "-o", results}, 60);
  EXPECT_EQ(ending.code, 2) << ending.output;
  EXPECT_EQ(read_file(results / "summary.json"), summary);
  EXPECT_EQ(files::last_write_time(results), time) << "nothing may be made in it, even for a moment";
}

TEST(Files, AnEmptySceneIsAnInputError) {
  const Ending ending = run(files::path(SCRATCH) / "empty", "", 2);
  EXPECT_EQ(ending.code, 2) << ending.output;
  EXPECT_NE(ending.output.find("not well-formed XML"), std::string::npos) << ending.output;
}

TEST(Checks, AMissedOneIsSaidQuietlyToo) {
  const std::string scene =
      replaced(good_scene, R"xml(  <ParameterList name="contact">)xml", R"xml(  <ParameterList name="quantities"><ParameterList name="force">
    <Parameter name="type" type="string" value="contact force"/></ParameterList></ParameterList>
  <ParameterList name="checks"><ParameterList name="too much"><Parameter name="quantity" type="string" value="force"/>
    <Parameter name="low" type="double" value="1e9"/></ParameterList></ParameterList>
  <ParameterList name="contact">)xml");
  const Ending ending = run(files::path(SCRATCH) / "missed_check", scene, 1, {"--quiet"});
  EXPECT_EQ(ending.code, 4) << ending.output;
  EXPECT_NE(ending.output.find("check too much: 1e+09 <= force"), std::string::npos) << ending.output;
  EXPECT_NE(ending.output.find("MISSED"), std::string::npos) << ending.output;
}

/// A rigid tool comes down on the lower block. Its body lies to the left of the way along the points.
TEST(Masters, ThatTurnTheirBacksAreWarnedOf) {
  const auto with_tool = [](const std::string& points) {
    std::string scene = replaced(
        good_scene, R"xml(<Parameter name="corners" type="string" value="0, 1, 1, 1, 1, 2, 0, 2"/>
        <Parameter name="cells x" type="int" value="2"/>
        <Parameter name="cells y" type="int" value="2"/>)xml",
        R"xml(<Parameter name="points" type="string" value=")xml" + points + R"xml("/><Parameter name="cell size" type="double" value="0.5"/>)xml");
    scene = replaced(scene, R"xml(<Parameter name="material" type="string" value="soft"/>
      <Parameter name="element" type="string" value="Q4"/>)xml",
                     R"xml(<Parameter name="rigid" type="bool" value="true"/>)xml");
    scene = replaced(scene, R"xml(<Parameter name="type" type="string" value="block"/>
        <Parameter name="points")xml",
                     R"xml(<Parameter name="type" type="string" value="profile"/>
        <Parameter name="points")xml");
    scene = replaced(scene, R"xml(value="upper/left"/>)xml",
                     R"xml(value="upper/reference"/><Parameter name="y" type="string" value="-0.01*t"/>
      <Parameter name="rotation" type="double" value="0"/>)xml");
    scene = replaced(scene, R"xml(value="upper/top"/>)xml", R"xml(value="lower/left"/>)xml");
    return replaced(scene, R"xml(value="upper/bottom"/>)xml", R"xml(value="upper/profile"/>)xml");
  };
  const std::string warning = "contact/interface: the master \"upper/profile\" turns its back on the slave \"seat\"";
  for (const int ranks : {1, 2})
    for (const char* height : {"1", "1.5"}) {  // touching, and far beyond the reach
      const auto said = [&](const std::string& points) {
        const Ending ending = run(files::path(SCRATCH) / fmt::format("turned_np{}", ranks), with_tool(points), ranks);
        EXPECT_EQ(ending.code, 0) << ending.output;
        return ending.output;
      };
      const std::string right = said(fmt::format("-0.5, {0}, 1.5, {0}", height)), wrong = said(fmt::format("1.5, {0}, -0.5, {0}", height));
      EXPECT_EQ(right.find(warning), std::string::npos) << right;
      EXPECT_NE(wrong.find(warning), std::string::npos) << wrong;
    }
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
    const Ending ending = launch({MPIEXEC, "-n", std::to_string(ranks), MORTISE, "run", directory / "scene.xml", "-o", directory / "results"}, 60);
    EXPECT_EQ(ending.code, 5) << ending.output;
    EXPECT_NE(ending.output.find("results"), std::string::npos) << ending.output;
    EXPECT_EQ(read_file(directory / "results"), "a file");
  }
}

}  // namespace
