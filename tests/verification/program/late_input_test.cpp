// Input that turns out to be wrong while the steps are taken.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "scene_support.hpp"

namespace {

using namespace scene_support;

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

}  // namespace
