#include "mortise/shape/quadrature.hpp"

#include <algorithm>
#include <boost/math/special_functions/legendre.hpp>
#include <stdexcept>
#include <string>

namespace mortise {

std::vector<LinePoint> gauss_legendre(int points) {
  if (points < 1) throw std::invalid_argument("a Gauss-Legendre rule needs at least one point, not " + std::to_string(points));
  std::vector<LinePoint> rule;
  // w_i = 2 / ((1 - xi_i^2) P_n'(xi_i)^2), xi_i the zeros of P_n; Boost gives those that are not negative.
  for (const double zero : boost::math::legendre_p_zeros<double>(points)) {
    const double slope = boost::math::legendre_p_prime(points, zero);
    const double weight = 2.0 / ((1.0 - zero * zero) * slope * slope);
    rule.push_back({zero, weight});
    if (zero > 0.0) rule.push_back({-zero, weight});
  }
  std::sort(rule.begin(), rule.end(), [](const LinePoint& a, const LinePoint& b) { return a.xi < b.xi; });
  return rule;
}

std::vector<CellPoint> quadrilateral_rule(int points_per_direction) {
  const auto line = gauss_legendre(points_per_direction);
  std::vector<CellPoint> rule;
  for (const auto& eta : line)
    for (const auto& xi : line) rule.push_back({{xi.xi, eta.xi}, xi.weight * eta.weight});
  return rule;
}

std::vector<CellPoint> triangle_rule(int points) {
  constexpr double sixth = 1.0 / 6.0, third = 1.0 / 3.0, two_thirds = 2.0 / 3.0;
  if (points == 1) return {{{third, third}, 0.5}};
  if (points == 3) return {{{sixth, sixth}, sixth}, {{two_thirds, sixth}, sixth}, {{sixth, two_thirds}, sixth}};
  throw std::invalid_argument("triangles have rules of 1 and 3 points, not " + std::to_string(points));
}

std::vector<CellPoint> full_rule(CellShape shape) { return shape == CellShape::triangle3 ? triangle_rule(1) : quadrilateral_rule(2); }

}  // namespace mortise
