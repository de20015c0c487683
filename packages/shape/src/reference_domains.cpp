#include "mortise/shape/reference_domains.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <string>

namespace mortise {
namespace {

/// The whole root of a tensor rule's number of points; 0 if there is none.
int root(int points, int power) {
  const int candidate = static_cast<int>(std::lround(std::pow(points, 1.0 / power)));
  return (power == 2 ? candidate * candidate : candidate * candidate * candidate) == points ? candidate : 0;
}

template <std::size_t dimension>
bool simplex_contains(const std::array<double, dimension>& xi, double tolerance) {
  const double last = 1.0 - std::accumulate(xi.begin(), xi.end(), 0.0);
  return std::min(last, *std::min_element(xi.begin(), xi.end())) >= -tolerance;
}

template <std::size_t dimension>
bool cube_contains(const std::array<double, dimension>& xi, double tolerance) {
  return std::all_of(xi.begin(), xi.end(), [&](double one) { return std::abs(one) <= 1.0 + tolerance; });
}

}  // namespace

std::vector<CellPoint> ReferenceLine::rule(int points) {
  std::vector<CellPoint> result;
  for (const LinePoint& point : gauss_legendre(points)) result.push_back({{point.xi}, point.weight});
  return result;
}

std::vector<CellPoint> ReferenceSquare::rule(int points) { return quadrilateral_rule(root(points, 2)); }
std::vector<CellPoint> ReferenceCube::rule(int points) { return hexahedron_rule(root(points, 3)); }
std::vector<CellPoint> ReferencePyramid::rule(int points) { return points == 8 ? pyramid_rule(2, 2) : pyramid_rule(root(points, 2)); }

std::vector<CellPoint> ReferenceWedge::rule(int points) {
  if (points == 6) return wedge_rule(3, 2);
  if (points == 21) return wedge_rule(7, 3);
  throw std::invalid_argument("wedges have rules of 6 and 21 points, not " + std::to_string(points));
}

bool ReferenceLine::contains(const std::array<double, 1>& xi, double tolerance) { return cube_contains(xi, tolerance); }
bool ReferenceTriangle::contains(const std::array<double, 2>& xi, double tolerance) { return simplex_contains(xi, tolerance); }
bool ReferenceSquare::contains(const std::array<double, 2>& xi, double tolerance) { return cube_contains(xi, tolerance); }
bool ReferenceTetrahedron::contains(const std::array<double, 3>& xi, double tolerance) { return simplex_contains(xi, tolerance); }
bool ReferenceCube::contains(const std::array<double, 3>& xi, double tolerance) { return cube_contains(xi, tolerance); }

bool ReferenceWedge::contains(const std::array<double, 3>& xi, double tolerance) {
  return simplex_contains(std::array<double, 2>{xi[0], xi[1]}, tolerance) && cube_contains(std::array<double, 1>{xi[2]}, tolerance);
}

bool ReferencePyramid::contains(const std::array<double, 3>& xi, double tolerance) {
  return xi[2] >= -tolerance && std::max(std::abs(xi[0]), std::abs(xi[1])) <= 1.0 - xi[2] + tolerance;
}

}  // namespace mortise
