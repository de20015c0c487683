#include "mortise/shape/quadrature.hpp"

#include <algorithm>
#include <boost/math/special_functions/legendre.hpp>
#include <cmath>
#include <stdexcept>
#include <string>

namespace mortise {
namespace {

/// The points with barycentric coordinates (1 - 2 a, a, a) and their permutations.
void add_orbit_of_three(std::vector<CellPoint>& rule, double a, double weight) {
  rule.push_back({{a, a}, weight});
  rule.push_back({{1.0 - 2.0 * a, a}, weight});
  rule.push_back({{a, 1.0 - 2.0 * a}, weight});
}

/// (a, b, 1 - a - b) and permutations.
void add_all_orders(std::vector<CellPoint>& rule, double a, double b, double weight) {
  const double c = 1.0 - a - b;
  for (const auto& [x, y] : {std::pair(a, b), {b, a}, {a, c}, {c, a}, {b, c}, {c, b}}) rule.push_back({{x, y}, weight});
}

/// (1 - 3 a, a, a, a) and permutations.
void add_orbit_of_four(std::vector<CellPoint>& rule, double a, double weight) {
  const double b = 1.0 - 3.0 * a;
  rule.push_back({{a, a, a}, weight});
  rule.push_back({{b, a, a}, weight});
  rule.push_back({{a, b, a}, weight});
  rule.push_back({{a, a, b}, weight});
}

/// (a, a, 1/2 - a, 1/2 - a) and permutations.
void add_orbit_of_six(std::vector<CellPoint>& rule, double a, double weight) {
  const double b = 0.5 - a;
  rule.push_back({{a, a, b}, weight});
  rule.push_back({{a, b, a}, weight});
  rule.push_back({{b, a, a}, weight});
  rule.push_back({{b, b, a}, weight});
  rule.push_back({{b, a, b}, weight});
  rule.push_back({{a, b, b}, weight});
}

}  // namespace

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

std::vector<CellPoint> hexahedron_rule(int points_per_direction) {
  const auto line = gauss_legendre(points_per_direction);
  std::vector<CellPoint> rule;
  for (const auto& zeta : line)
    for (const auto& eta : line)
      for (const auto& xi : line) rule.push_back({{xi.xi, eta.xi, zeta.xi}, xi.weight * eta.weight * zeta.weight});
  return rule;
}

std::vector<CellPoint> triangle_rule(int points) {
  constexpr double sixth = 1.0 / 6.0, third = 1.0 / 3.0, two_thirds = 2.0 / 3.0;
  std::vector<CellPoint> rule;
  if (points == 1) return {{{third, third}, 0.5}};
  if (points == 3) return {{{sixth, sixth}, sixth}, {{two_thirds, sixth}, sixth}, {{sixth, two_thirds}, sixth}};
  if (points == 7) {  // Radon 1948
    const double r = std::sqrt(15.0);
    rule = {{{third, third}, 9.0 / 80.0}};
    add_orbit_of_three(rule, (6.0 - r) / 21.0, (155.0 - r) / 2400.0);
    add_orbit_of_three(rule, (6.0 + r) / 21.0, (155.0 + r) / 2400.0);
    return rule;
  }
  if (points == 12) {  // Dunavant 1985, degree 6
    add_orbit_of_three(rule, 0.249286745170910421, 0.058393137863189684);
    add_orbit_of_three(rule, 0.063089014491502227, 0.025422453185103408);
    add_all_orders(rule, 0.310352451033784405, 0.053145049844816947, 0.041425537809186787);
    return rule;
  }
  throw std::invalid_argument("triangles have rules of 1, 3, 7 and 12 points, not " + std::to_string(points));
}

std::vector<CellPoint> tetrahedron_rule(int points) {
  std::vector<CellPoint> rule;
  if (points == 1) return {{{0.25, 0.25, 0.25}, 1.0 / 6.0}};
  if (points == 4) {
    add_orbit_of_four(rule, (5.0 - std::sqrt(5.0)) / 20.0, 1.0 / 24.0);
    return rule;
  }
  if (points == 15) {  // Stroud 1971, T3:5-1
    const double r = std::sqrt(15.0);
    rule = {{{0.25, 0.25, 0.25}, 8.0 / 405.0}};
    add_orbit_of_four(rule, (7.0 - r) / 34.0, (2665.0 + 14.0 * r) / 226800.0);
    add_orbit_of_four(rule, (7.0 + r) / 34.0, (2665.0 - 14.0 * r) / 226800.0);
    add_orbit_of_six(rule, (5.0 - r) / 20.0, 5.0 / 567.0);
    return rule;
  }
  throw std::invalid_argument("tetrahedra have rules of 1, 4 and 15 points, not " + std::to_string(points));
}

std::vector<CellPoint> wedge_rule(int triangle_points, int line_points) {
  const auto triangle = triangle_rule(triangle_points);
  std::vector<CellPoint> rule;
  for (const auto& zeta : gauss_legendre(line_points))
    for (const auto& at : triangle) rule.push_back({{at.xi[0], at.xi[1], zeta.xi}, at.weight * zeta.weight});
  return rule;
}

std::vector<CellPoint> pyramid_rule(int points_per_direction, int heights) {
  // Moments of the weight (1 - zeta)^2 on [0, 1]: of 1, 1/3; of zeta, 1/12; of zeta^2, 1/30; of zeta^3, 1/60. The two points are the zeros of
  // 15 zeta^2 - 10 zeta + 1, to which 1 and zeta are orthogonal.
  std::vector<LinePoint> along;
  if (heights == 1) {
    along = {{0.25, 1.0 / 3.0}};
  } else if (heights == 2) {
    const double r = std::sqrt(10.0);
    along = {{(5.0 - r) / 15.0, (8.0 + r) / 48.0}, {(5.0 + r) / 15.0, (8.0 - r) / 48.0}};
  } else {
    throw std::invalid_argument("pyramids have rules of 1 and 2 points along the height, not " + std::to_string(heights));
  }
  std::vector<CellPoint> rule;
  for (const auto& [height, weight] : along)
    for (const auto& at : quadrilateral_rule(points_per_direction))
      rule.push_back({{at.xi[0] * (1.0 - height), at.xi[1] * (1.0 - height), height}, at.weight * weight});
  return rule;
}

}  // namespace mortise
