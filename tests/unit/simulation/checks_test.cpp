// Bounds on quantities.

#include "mortise/simulation/scene/checks.hpp"

#include <gmock/gmock.h>

#include <limits>

#include "mortise/input/read_parameters.hpp"

namespace mortise {
namespace {

Named<CheckOptions> check(const std::string& quantity, std::optional<double> low, std::optional<double> high) {
  return {"check of " + quantity, {}, {{quantity, {"scene.xml", 7, "checks/one"}}, low, high}};
}

bool ok(double value, std::optional<double> low, std::optional<double> high) {
  return evaluate_checks({check("peak", low, high)}, {{"peak", value}}).at(0).ok;
}

TEST(Checks, BoundsAreInclusive) {
  EXPECT_TRUE(ok(1.0, 1.0, 1.0));
  EXPECT_TRUE(ok(2.0, 1.0, {}));
  EXPECT_TRUE(ok(-2.0, {}, 1.0));
  EXPECT_FALSE(ok(0.999, 1.0, {}));
  EXPECT_FALSE(ok(1.001, {}, 1.0));
}

TEST(Checks, WhatIsNotANumberMissesEveryBound) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(ok(nan, -1e300, 1e300));
  EXPECT_FALSE(ok(nan, {}, 1.0));
}

TEST(Checks, LinesTellBoundsAndValueApart) {
  const auto line = [](double value, std::optional<double> low, std::optional<double> high) {
    return check_line(evaluate_checks({check("peak", low, high)}, {{"peak", value}}).at(0));
  };
  EXPECT_EQ(line(0.2, 0.2 * (1.0 - 1e-6), 0.2 * (1.0 + 1e-6)), "check check of peak: 0.1999998 <= peak <= 0.2000002: 0.2: ok");
  EXPECT_EQ(line(2.5, 1.0, {}), "check check of peak: 1 <= peak: 2.5: ok");
  EXPECT_EQ(line(1.0 + 1e-12, {}, 1.0), "check check of peak: peak <= 1: 1.000000000001: MISSED");
  EXPECT_EQ(line(1.0, 1.0, 1.0), "check check of peak: 1 <= peak <= 1: 1: ok");
}

TEST(Checks, RowsSayWhatWasChecked) {
  const auto rows = evaluate_checks({check("a", 1.0, {}), check("b", {}, 2.0)}, {{"a", 5.0}, {"b", 6.0}});
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[0].name, "check of a");
  EXPECT_EQ(rows[0].quantity, "a");
  EXPECT_EQ(rows[0].value, 5.0);
  EXPECT_EQ(rows[0].low, 1.0);
  EXPECT_FALSE(rows[0].high.has_value());
  EXPECT_TRUE(rows[0].ok);
  EXPECT_FALSE(rows[1].ok);
}

TEST(Checks, AllUnknownQuantitiesAreNamedWithTheNearest) {
  try {
    evaluate_checks({check("peak_presure", 1.0, {}), check("half_width", 1.0, {}), check("zzz", 1.0, {})},
                    {{"peak_pressure", 5.0}, {"half_width", 1.0}});
    FAIL() << "no InputError";
  } catch (const InputError& error) {
    EXPECT_EQ(error.diagnostics().size(), 2u);
    EXPECT_THAT(error.what(), ::testing::HasSubstr("scene.xml:7"));
    EXPECT_THAT(error.what(), ::testing::HasSubstr("did you mean \"peak_pressure\""));
    EXPECT_THAT(error.what(), ::testing::HasSubstr("\"zzz\""));
  }
}

TEST(Checks, ReadingRefusesWhatHasNoMeaning) {
  const auto read = [](const std::string& parameters) {
    CheckOptions options;
    std::vector<Diagnostic> diagnostics;
    const auto root = parse_xml("<ParameterList name=\"one\">" + parameters + "</ParameterList>", "scene.xml");
    read_parameters(options, root, {}, {}, diagnostics);
    return diagnostics;
  };
  const std::string quantity = "<Parameter name=\"quantity\" type=\"string\" value=\"peak\"/>";
  const std::string low = "<Parameter name=\"low\" type=\"double\" value=\"2\"/>", high = "<Parameter name=\"high\" type=\"double\" value=\"1\"/>";
  EXPECT_TRUE(read(quantity + low).empty());
  EXPECT_EQ(read(quantity).size(), 1u) << "no bound";
  EXPECT_EQ(read(quantity + low + high).size(), 1u) << "low above high";
}

}  // namespace
}  // namespace mortise
