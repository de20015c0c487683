// Every kind of bad input: exit code, message with file and line, nothing written; on one rank and on two.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "scene_support.hpp"

namespace {

using namespace scene_support;

/// One thing done wrong: `from` is replaced by `to` in the good scene.
struct Case {
  std::string name, from, to;
  std::string message;  ///< a part of the expected output
  std::string marker;   ///< text of the line that the message has to point at; empty: any line
  int code = 2;
};

void PrintTo(const Case& bad, std::ostream* out) { *out << bad.name; }

const std::string second_pair = R"xml(<ParameterList name="second">
      <Parameter name="slave" type="string" value="lower/top"/>
      <Parameter name="master" type="string" value="upper/right"/>
    </ParameterList>
    <ParameterList name="interface">)xml";

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
    {"modulus_beyond_squares", R"xml(value="1000")xml", R"xml(value="1e-170")xml", "allowed: 1e-120 to 1e+120", ""},
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
    {"slave_node_in_two_pairs", R"xml(<ParameterList name="interface">)xml", second_pair,
     "slave facets can carry no contact, as all their nodes belong to other pairs too", R"xml(<ParameterList name="second">)xml"},
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
     "variables: variable \"a\" is \"a + 1\", but it may use only variables that stand above it", "a + 1"},
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

TEST(BadInputs, AreAllReportedAtOnce) {
  std::string scene = replaced(good_scene, R"xml(value="1000")xml", R"xml(value="5x")xml");
  scene = replaced(scene, R"xml("cells x" type="int" value="2")xml", R"xml("cels x" type="int" value="2")xml");
  scene = replaced(scene, R"xml(name="contact">)xml", R"xml(name="contacts">)xml");
  const Ending ending = run(files::path(SCRATCH) / "all_at_once", scene, 1);
  EXPECT_EQ(ending.code, 2);
  for (const char* wrong : {"5x", "cels x", "contacts"}) EXPECT_NE(ending.output.find(wrong), std::string::npos) << ending.output;
}

/// A parameter that was refused is not reported as missing too.
TEST(BadInputs, AreReportedOnce) {
  const std::string cells = R"xml("cells x" type="int" value="2000000000")xml", smallest = R"xml("smallest cell" type="double" value="-1")xml";
  const std::string given = R"xml("cells x" type="int" value="3"/>)xml",
                    grading =
                        R"xml("cells x" type="int" value="0"/><ParameterList name="grading x"><Parameter name=)xml" + smallest + "/></ParameterList>";
  for (const auto& [wrong, to] :
       {std::pair<std::string, std::string>{cells, "<Parameter name=" + cells + "/>"}, {smallest, "<Parameter name=" + grading}}) {
    const Ending ending = run(files::path(SCRATCH) / "once", replaced(good_scene, "<Parameter name=" + given, to), 1);
    EXPECT_EQ(ending.code, 2);
    const auto message = ending.output.find(": error: ");
    ASSERT_NE(message, std::string::npos) << ending.output;
    EXPECT_EQ(ending.output.find(": error: ", message + 1), std::string::npos) << ending.output;
  }
}

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

}  // namespace
