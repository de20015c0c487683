// Options as a scene gives them, and messages about those that make no sense.

#include <gtest/gtest.h>

#include "mortise/input/read_parameters.hpp"
#include "mortise/nonlinear/linear_solver_options.hpp"
#include "mortise/nonlinear/load_stepper.hpp"

namespace mortise {
namespace {

struct All {
  SteppingOptions stepping;
  NewtonOptions newton;
  LinearSolverOptions linear_solver;
  void describe(Parameters& parameters) {
    parameters.list("stepping", stepping, "steps");
    parameters.list("newton", newton, "Newton");
    parameters.list("linear solver", linear_solver, "linear systems");
  }
};

std::vector<Diagnostic> read(All& all, const std::string& inner) {
  std::vector<Diagnostic> diagnostics;
  const XmlList root = parse_xml("<ParameterList name=\"scene\">\n" + inner + "\n</ParameterList>", "scene.xml");
  const Symbols symbols = read_symbols(root, diagnostics);
  read_parameters(all, root, symbols, {}, diagnostics);
  return diagnostics;
}

TEST(Options, AreReadFromAScene) {
  All all;
  const auto diagnostics = read(all, R"(
    <ParameterList name="stepping">
      <Parameter name="end time" type="double" value="2"/>
      <Parameter name="step" type="double" value="1/4"/>
      <Parameter name="maximum step" type="double" value="0.5"/>
      <Parameter name="output times" type="string" value="0.3, 1.5, 2"/>
    </ParameterList>
    <ParameterList name="newton"><Parameter name="maximum iterations" type="int" value="9"/></ParameterList>
    <ParameterList name="linear solver">
      <Parameter name="type" type="string" value="iterative"/>
      <ParameterList name="muelu"><Parameter name="max levels" type="int" value="3"/></ParameterList>
    </ParameterList>)");
  for (const auto& diagnostic : diagnostics) ADD_FAILURE() << to_string(diagnostic);
  EXPECT_EQ(all.stepping.end_time, 2.0);
  EXPECT_EQ(all.stepping.step, 0.25);
  EXPECT_EQ(all.stepping.maximum_step, 0.5);
  EXPECT_FALSE(all.stepping.minimum_step);
  EXPECT_EQ(all.stepping.output_times, (std::vector<double>{0.3, 1.5, 2.0}));
  EXPECT_EQ(all.newton.maximum_iterations, 9);
  EXPECT_EQ(all.linear_solver.kind.value, LinearSolverOptions::Kind::iterative);
  EXPECT_EQ(all.linear_solver.kind.place.line, 11);
  EXPECT_EQ(all.linear_solver.muelu.value.get<int>("max levels"), 3);
  EXPECT_EQ(all.linear_solver.muelu.place.line, 12);
}

TEST(Options, ThatMakeNoSenseAreAllNamed) {
  All all;
  const auto diagnostics = read(all, R"(
    <ParameterList name="stepping">
      <Parameter name="step" type="double" value="0.5"/>
      <Parameter name="maximum step" type="double" value="0.1"/>
      <Parameter name="minimum step" type="double" value="0.6"/>
      <Parameter name="output times" type="string" value="0.5, 1.5"/>
    </ParameterList>
    <ParameterList name="newton"><Parameter name="gap tolerance" type="double" value="0"/></ParameterList>
    <ParameterList name="linear solver"><Parameter name="type" type="string" value="umfpack"/></ParameterList>)");
  std::string all_messages;
  for (const auto& diagnostic : diagnostics) all_messages += to_string(diagnostic) + "\n";
  EXPECT_EQ(diagnostics.size(), 5u) << all_messages;
  for (const char* expected : {"scene.xml:5", "scene.xml:6", "scene.xml:7", "gap tolerance", "umfpack"})
    EXPECT_NE(all_messages.find(expected), std::string::npos) << expected << "\n" << all_messages;
}

}  // namespace
}  // namespace mortise
