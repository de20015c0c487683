// Divisions of lines: ends, sizes, ratios, mirrored and refined ones.

#include "mortise/mesh/spacing.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace mortise {
namespace {

std::vector<double> sizes(const Spacing& spacing) {
  std::vector<double> result;
  for (int i = 0; i < spacing.cells(); ++i) result.push_back(spacing.position(i + 1) - spacing.position(i));
  return result;
}

GradingOptions graded(FineEnd toward, double ratio) {
  GradingOptions options;
  options.toward = toward;
  options.ratio = ratio;
  return options;
}

GradingOptions refined(FineEnd toward, double smallest, double length, double growth) {
  GradingOptions options;
  options.toward = toward;
  options.smallest_cell = smallest;
  options.refined_length = length;
  options.growth = growth;
  return options;
}

TEST(Spacing, RunsFromZeroToOneAndForward) {
  for (const auto toward : {FineEnd::start, FineEnd::end, FineEnd::middle, FineEnd::both_ends})
    for (const int cells : {1, 2, 3, 7, 20})
      for (const double ratio : {1.0, 3.0, 50.0}) {
        const Spacing spacing = graded(toward, ratio).spacing(1.0, cells, {});
        ASSERT_EQ(spacing.cells(), cells);
        EXPECT_EQ(spacing.position(0), 0.0);
        EXPECT_EQ(spacing.position(cells), 1.0);
        for (const double size : sizes(spacing)) EXPECT_GT(size, 0.0);
        for (int i = 0; i <= cells; ++i) EXPECT_NEAR(spacing.reversed().position(i), 1.0 - spacing.position(cells - i), 1e-14);
      }
}

TEST(Spacing, EqualCellsAreEqual) {
  for (int i = 0; i <= 7; ++i) EXPECT_NEAR(Spacing(7).position(i), i / 7.0, 1e-15);
}

TEST(Spacing, RefusesRunsWithoutMeaning) {
  EXPECT_THROW(Spacing(0), std::invalid_argument);
  EXPECT_THROW(Spacing({{2, 0.0, 1.0}}), std::invalid_argument);
  EXPECT_THROW(Spacing({{2, 1.0, -1.0}}), std::invalid_argument);
  EXPECT_THROW(Spacing(std::vector<Spacing::Run>{}), std::invalid_argument);
}

TEST(Grading, HasItsRatioAndItsFineEnd) {
  const int cells = 8;
  for (const auto toward : {FineEnd::start, FineEnd::end, FineEnd::middle, FineEnd::both_ends}) {
    const auto size = sizes(graded(toward, 5.0).spacing(10.0, cells, {}));
    const auto [smallest, largest] = std::minmax_element(size.begin(), size.end());
    EXPECT_NEAR(*largest / *smallest, 5.0, 1e-12);
    EXPECT_NEAR(toward == FineEnd::end ? size.back() : toward == FineEnd::middle ? size[cells / 2] : size.front(), *smallest, 1e-14);
    if (toward == FineEnd::middle || toward == FineEnd::both_ends)
      for (int i = 0; i < cells; ++i) EXPECT_NEAR(size[i], size[cells - 1 - i], 1e-14);
  }
  const auto odd = sizes(graded(FineEnd::middle, 4.0).spacing(1.0, 5, {}));
  for (int i = 1; i <= 2; ++i) EXPECT_NEAR(odd[2 + i], odd[2] * std::pow(2.0, i), 1e-14);
}

TEST(Grading, SmallestCellFillsTheRefinedLengthAndGrowsAtMostAsSaid) {
  for (const double smallest : {0.03, 0.1, 0.33})
    for (const double zone : {0.0, 1.0, 4.0})
      for (const double growth : {1.05, 1.2, 2.0}) {
        const double length = 10.0;
        auto size = sizes(refined(FineEnd::start, smallest, zone, growth).spacing(length, 0, {}));
        double end = 0.0;
        for (std::size_t i = 0; i < size.size(); ++i) {
          size[i] *= length;
          const double start = end;
          end += size[i];
          if (start < zone - 1e-9) EXPECT_LE(size[i], smallest * (1.0 + 1e-9));
          if (i > 0) EXPECT_LE(size[i] / size[i - 1], growth * (1.0 + 1e-9));
          if (i > 0) EXPECT_GE(size[i] / size[i - 1], 1.0 - 1e-9);
        }
        EXPECT_NEAR(end, length, 1e-12);
        // Whole cells have to fit, so the first may be smaller than asked for, but never half as large.
        EXPECT_GT(size.front(), 0.5 * smallest);
      }
}

TEST(Grading, MirrorsTheRefinedZone) {
  const auto middle = sizes(refined(FineEnd::middle, 0.1, 1.0, 1.3).spacing(10.0, 0, {}));
  const auto ends = sizes(refined(FineEnd::both_ends, 0.1, 1.0, 1.3).spacing(10.0, 0, {}));
  const std::size_t n = middle.size();
  ASSERT_EQ(ends.size(), n);
  for (std::size_t i = 0; i < n; ++i) {
    EXPECT_NEAR(middle[i], middle[n - 1 - i], 1e-14);
    EXPECT_NEAR(ends[i], middle[(i + n / 2) % n], 1e-14);
  }
}

TEST(Grading, RefusesWhatDoesNotFit) {
  const Place place{"scene.xml", 3, "bodies/block/mesh"};
  EXPECT_THROW(refined(FineEnd::start, 11.0, 0.0, 1.2).spacing(10.0, 0, place), InputError);
  EXPECT_THROW(refined(FineEnd::middle, 6.0, 0.0, 1.2).spacing(10.0, 0, place), InputError);
  EXPECT_THROW(GradingOptions{}.spacing(10.0, 0, place), InputError);
}

}  // namespace
}  // namespace mortise
