// The scalar that second derivatives are taken of against the integrals that forces come from.

#include <gtest/gtest.h>

#include "mortise/mortar/segment_2d.hpp"

namespace mortise {
namespace {

// Its own route (no functions of the covered interval, a root lifted twice), the same value and gradient. Entries of both are sums of 5 points of
// some ten terms of size 1: round-off of 1e-14, and of the positions over the overlap's length.
TEST(WeightedGap, IsTheSumOfTheGapsWithTheirDerivatives) {
  const double c = std::cos(0.2), s = std::sin(0.2);
  const LinePoints linear = {{0.1, 0.05}, {1.2, -0.02}}, curved = {{0.1, 0.05}, {1.2, -0.02}, {0.63, 0.04}};
  const LinePoints below = {{0.9, -0.1}, {0.35, -0.2}}, bent = {{0.9, -0.1}, {0.35, -0.2}, {0.6, -0.13}};
  const std::vector<Point2<double>> normals = {{-s, -c}, {s, -c}, {0.05, -std::sqrt(1.0 - 0.0025)}};
  const auto rule = gauss_legendre(5);
  for (const bool axisymmetric : {false, true})
    for (const LinePoints& slave : {linear, curved})
      for (const LinePoints& master : {below, bent}) {
        const auto n = static_cast<Eigen::Index>(slave.size());
        const SlaveCurve line{slave, LinePoints(normals.begin(), normals.begin() + n)};
        const auto overlap = find_overlap(line, master);
        ASSERT_TRUE(overlap);
        ASSERT_TRUE(overlap->low_is_master && overlap->high_is_master);
        const InterfaceMeasure measure{axisymmetric, 1.3};
        FacetVector weights(n);
        weights << Eigen::Vector2d(0.7, -1.9), Eigen::VectorXd::Constant(n - 2, 1.2);
        const WeightedGap gap = weighted_gap(line, master, *overlap, weights, measure, rule);
        SegmentIntegrals integrals;
        integrate_segment(line, master, *overlap, {-1.0, 1.0}, measure, rule, true, integrals);  // L_i = N_i
        const Eigen::VectorXd slope = integrals.derivative.bottomRows(n).transpose() * weights;
        EXPECT_NEAR(gap.value, integrals.value.tail(n).dot(weights), 1e-14);
        EXPECT_LT((gap.gradient - slope).cwiseAbs().maxCoeff(), 1e-13);
        EXPECT_GT(slope.norm(), 0.1);
      }
}

}  // namespace
}  // namespace mortise
