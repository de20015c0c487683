#include "mortise/solid/prescribed_motion.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "mortise/input/expression.hpp"
#include "solid_test_support.hpp"

namespace mortise {
namespace {

std::optional<ScalarFunction> given(const std::string& text) {
  Symbols symbols;
  symbols.variables["speed"] = 2.0;
  return text.empty() ? std::nullopt : std::make_optional(parse_expression(text, symbols));
}

Named<BoundaryConditionOptions> condition(const std::string& name, int line, const std::string& set, const std::string& x, const std::string& y) {
  const Place place{"scene.xml", line, "boundary conditions/" + name};
  return {name, place, {{set, place}, given(x), given(y), {}, {}, {}, {}, {}}};
}

std::string error_of(const Bodies& bodies, const std::vector<Named<BoundaryConditionOptions>>& conditions) {
  try {
    PrescribedMotion(bodies, conditions);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(PrescribedMotion, HoldsTheNamedComponentsAscending) {
  const auto bodies = make_test_bodies(self(), {});
  const PrescribedMotion motion(*bodies, {condition("right", 3, "body/right", "speed*t*y", ""), condition("bottom", 4, "body/bottom", "", "0.5")});
  std::vector<LocalOrdinal> dofs;
  std::vector<double> values;
  for (LocalOrdinal node = 0; node < bodies->mesh()->owned_count(); ++node) {
    const auto& X = bodies->mesh()->coordinates[node];
    if (std::abs(X[0] - 3.0) < 1e-12) {
      dofs.push_back(2 * node);
      values.push_back(2.0 * 0.25 * X[1]);
    }
    if (std::abs(X[1]) < 1e-12) {
      dofs.push_back(2 * node + 1);
      values.push_back(0.5);
    }
  }
  EXPECT_EQ(motion.dofs(), dofs);
  std::optional<StepFailure> failure;
  const auto actual = motion.values(0.25, failure);
  EXPECT_FALSE(failure);
  ASSERT_EQ(actual.size(), values.size());
  for (std::size_t n = 0; n < values.size(); ++n) EXPECT_DOUBLE_EQ(actual[n], values[n]);
}

TEST(PrescribedMotion, SaysWhichExpressionHasNoValue) {
  const auto bodies = make_test_bodies(self(), {});
  auto top = condition("top", 7, "body/top", "", "");
  top.value.x = parse_expression("sqrt(1 - t)", {}, top.place);
  const PrescribedMotion motion(*bodies, {top});
  std::optional<StepFailure> failure;
  for (const double value : motion.values(0.75, failure)) EXPECT_DOUBLE_EQ(value, 0.5);
  EXPECT_FALSE(failure);
  for (const double value : motion.values(2.0, failure)) EXPECT_TRUE(std::isnan(value));
  ASSERT_TRUE(failure);
  EXPECT_EQ(failure->kind(), FailureKind::input);
  EXPECT_THAT(failure->what(), ::testing::HasSubstr("scene.xml:7: error: boundary conditions/top: \"sqrt(1 - t)\" is"));
  EXPECT_THAT(failure->what(), ::testing::HasSubstr("at t = 2, x = "));
}

TEST(PrescribedMotion, TakesTheSameValueTwiceButNotTwoValues) {
  const auto bodies = make_test_bodies(self(), {});
  EXPECT_EQ(error_of(*bodies, {condition("a", 3, "body/left", "t*y", ""), condition("b", 4, "body/bottom", "0", "0")}), "");
  const std::string error = error_of(*bodies, {condition("a", 3, "body/left", "t", ""), condition("b", 4, "body/bottom", "0", "0")});
  EXPECT_NE(error.find("scene.xml:3"), std::string::npos) << error;
  EXPECT_NE(error.find("scene.xml:4"), std::string::npos) << error;
}

TEST(PrescribedMotion, SaysAllThatIsWrong) {
  const auto bodies = make_test_bodies(self(), {});
  const std::string error = error_of(*bodies, {condition("a", 3, "body/lefd", "0", ""), condition("b", 4, "body/left", "", "")});
  for (const char* place : {"scene.xml:3", "scene.xml:4"}) EXPECT_NE(error.find(place), std::string::npos) << error;
}

}  // namespace
}  // namespace mortise
