#include "mortise/shape/quadrature.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <tuple>

#include "mortise/shape/reference_domains.hpp"

namespace mortise {
namespace {

/// int_{-1}^{1} x^p dx.
double line_monomial(int p) { return p % 2 == 0 ? 2.0 / (p + 1) : 0.0; }

TEST(GaussLegendre, IsExactToDegreeTwoNMinusOneAndNotBeyond) {
  for (int n = 1; n <= 16; ++n) {
    const auto rule = gauss_legendre(n);
    ASSERT_EQ(static_cast<int>(rule.size()), n);
    for (int p = 0; p <= 2 * n; ++p) {
      double sum = 0.0;
      for (const auto& point : rule) sum += point.weight * std::pow(point.xi, p);
      if (p < 2 * n) {
        EXPECT_NEAR(sum, line_monomial(p), 1e-14) << n << " points, degree " << p;
      } else {
        // The error of x^(2n) is the squared norm of the monic Legendre polynomial: 2^(2n+1) (n!)^4 / ((2n+1) ((2n)!)^2).
        const double error =
            std::exp((2 * n + 1) * std::log(2.0) + 4.0 * std::lgamma(n + 1.0) - std::log(2.0 * n + 1.0) - 2.0 * std::lgamma(2.0 * n + 1.0));
        EXPECT_NEAR(line_monomial(p) - sum, error, 1e-14) << n << " points";
      }
    }
    for (int i = 1; i < n; ++i) EXPECT_LT(rule[i - 1].xi, rule[i].xi);
  }
}

TEST(QuadrilateralRule, IsExactInEachDirection) {
  for (int n = 1; n <= 3; ++n)
    for (int p = 0; p < 2 * n; ++p)
      for (int q = 0; q < 2 * n; ++q) {
        double sum = 0.0;
        for (const auto& point : quadrilateral_rule(n)) sum += point.weight * std::pow(point.xi[0], p) * std::pow(point.xi[1], q);
        EXPECT_NEAR(sum, line_monomial(p) * line_monomial(q), 1e-14);
      }
}

TEST(TriangleRule, IsExactToItsDegree) {
  for (const auto& [points, degree] : {std::pair(1, 1), std::pair(3, 2), std::pair(7, 5), std::pair(12, 6)})
    for (int p = 0; p <= degree; ++p)
      for (int q = 0; p + q <= degree; ++q) {
        double sum = 0.0;
        for (const auto& point : triangle_rule(points)) sum += point.weight * std::pow(point.xi[0], p) * std::pow(point.xi[1], q);
        // int x^p y^q = p! q! / (p + q + 2)!
        EXPECT_NEAR(sum, std::tgamma(p + 1.0) * std::tgamma(q + 1.0) / std::tgamma(p + q + 3.0), 1e-15);
      }
}

TEST(TetrahedronRule, IsExactToItsDegree) {
  for (const auto& [points, degree] : {std::pair(1, 1), std::pair(4, 2), std::pair(15, 5)})
    for (int p = 0; p <= degree; ++p)
      for (int q = 0; p + q <= degree; ++q)
        for (int r = 0; p + q + r <= degree; ++r) {
          double sum = 0.0;
          for (const auto& point : tetrahedron_rule(points))
            sum += point.weight * std::pow(point.xi[0], p) * std::pow(point.xi[1], q) * std::pow(point.xi[2], r);
          // int x^p y^q z^r = p! q! r! / (p + q + r + 3)!
          EXPECT_NEAR(sum, std::tgamma(p + 1.0) * std::tgamma(q + 1.0) * std::tgamma(r + 1.0) / std::tgamma(p + q + r + 4.0), 1e-15) << points;
        }
}

TEST(HexahedronRule, IsExactInEachDirection) {
  for (int n = 1; n <= 3; ++n)
    for (int p = 0; p < 2 * n; ++p)
      for (int q = 0; q < 2 * n; ++q)
        for (int r = 0; r < 2 * n; ++r) {
          double sum = 0.0;
          for (const auto& point : hexahedron_rule(n))
            sum += point.weight * std::pow(point.xi[0], p) * std::pow(point.xi[1], q) * std::pow(point.xi[2], r);
          EXPECT_NEAR(sum, line_monomial(p) * line_monomial(q) * line_monomial(r), 1e-14);
        }
}

TEST(WedgeRule, IsExactToTheDegreesOfTriangleAndLine) {
  struct Degrees {
    int points, plane, upright;
  };
  for (const auto& [points, plane, upright] : {Degrees{6, 2, 3}, {21, 5, 5}})
    for (int p = 0; p <= plane; ++p)
      for (int q = 0; p + q <= plane; ++q)
        for (int r = 0; r <= upright; ++r) {
          double sum = 0.0;
          for (const auto& point : ReferenceWedge::rule(points))
            sum += point.weight * std::pow(point.xi[0], p) * std::pow(point.xi[1], q) * std::pow(point.xi[2], r);
          const double triangle = std::tgamma(p + 1.0) * std::tgamma(q + 1.0) / std::tgamma(p + q + 3.0);
          EXPECT_NEAR(sum, triangle * line_monomial(r), 1e-15) << points << " points, " << p << q << r;
        }
}

TEST(PyramidRule, IsExactForFunctionsOfTheRaysAndTheirProductsWithTheHeight) {
  const std::array moments{1.0 / 3.0, 1.0 / 12.0, 1.0 / 30.0, 1.0 / 60.0};  // int_0^1 (1 - zeta)^2 zeta^r dzeta
  for (int heights = 1; heights <= 2; ++heights)
    for (int n = 1; n <= 3; ++n)
      for (int p = 0; p < 2 * n; ++p)
        for (int q = 0; q < 2 * n; ++q)
          for (int r = 0; r < 2 * heights; ++r) {
            double sum = 0.0;
            for (const auto& point : pyramid_rule(n, heights)) {
              const auto [u, v] = ReferencePyramid::ray(point.position<3>());
              sum += point.weight * std::pow(u, p) * std::pow(v, q) * std::pow(point.xi[2], r);
            }
            EXPECT_NEAR(sum, line_monomial(p) * line_monomial(q) * moments[r], 1e-15) << n << " points, " << heights << " heights, " << p << q << r;
          }
}

TEST(PyramidRule, IsExactForLinearMonomials) {
  // int x^p y^q z^r = int u^p v^q du dv int (1 - z)^(p + q + 2) z^r dz
  for (const auto& [p, q, r, exact] : {std::tuple(0, 0, 0, 4.0 / 3.0), {1, 0, 0, 0.0}, {0, 1, 0, 0.0}, {0, 0, 1, 1.0 / 3.0}}) {
    double sum = 0.0;
    for (const auto& point : ReferencePyramid::rule(4))
      sum += point.weight * std::pow(point.xi[0], p) * std::pow(point.xi[1], q) * std::pow(point.xi[2], r);
    EXPECT_NEAR(sum, exact, 1e-15);
  }
}

TEST(Rules, OfSimplicesHavePositiveWeightsAndPointsInside) {
  for (const auto& [dimension, points] :
       {std::pair(2, 1), std::pair(2, 3), std::pair(2, 7), std::pair(2, 12), std::pair(3, 1), std::pair(3, 4), std::pair(3, 15)}) {
    const auto rule = dimension == 2 ? triangle_rule(points) : tetrahedron_rule(points);
    EXPECT_EQ(static_cast<int>(rule.size()), points);
    for (const auto& point : rule) {
      EXPECT_GT(point.weight, 0.0);
      for (int i = 0; i < dimension; ++i) EXPECT_GT(point.xi[i], 0.0);
      EXPECT_LT(point.xi[0] + point.xi[1] + point.xi[2], 1.0);
    }
  }
}

TEST(Rules, RefuseWhatTheyDoNotHave) {
  EXPECT_THROW(gauss_legendre(0), std::invalid_argument);
  EXPECT_THROW(quadrilateral_rule(-1), std::invalid_argument);
  EXPECT_THROW(hexahedron_rule(0), std::invalid_argument);
  EXPECT_THROW(triangle_rule(2), std::invalid_argument);
  EXPECT_THROW(tetrahedron_rule(5), std::invalid_argument);
  EXPECT_THROW(ReferenceSquare::rule(8), std::invalid_argument);
  EXPECT_THROW(ReferenceCube::rule(9), std::invalid_argument);
  EXPECT_THROW(ReferenceLine::rule(0), std::invalid_argument);
  EXPECT_THROW(ReferenceWedge::rule(9), std::invalid_argument);
  EXPECT_THROW(ReferencePyramid::rule(5), std::invalid_argument);
  EXPECT_THROW(pyramid_rule(2, 3), std::invalid_argument);
}

}  // namespace
}  // namespace mortise
