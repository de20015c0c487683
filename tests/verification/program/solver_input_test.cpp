// Errors of a scene about its linear solver and the packages behind it.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "scene_support.hpp"

namespace {

using namespace scene_support;

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
  EXPECT_EQ(ending.output.find('\n', message), ending.output.size() - 1) << "one line:\n" << ending.output;
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
  EXPECT_EQ(ending.output.find('\n', message), ending.output.size() - 1) << "one line:\n" << ending.output;
}

}  // namespace
