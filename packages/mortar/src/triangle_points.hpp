#pragma once
// The points at which each triangle of an overlap is integrated.

#include <array>
#include <vector>

#include "mortise/shape/quadrature.hpp"

namespace mortise {

/// A point by its shares of the triangle's vertices; the weights sum to 1/2.
struct TrianglePoint {
  std::array<double, 3> share;
  double weight;
};

inline constexpr std::size_t points_per_triangle = 7;

/// The rule of degree 5.
inline const std::vector<TrianglePoint>& triangle_points() {
  static const std::vector<TrianglePoint> points = [] {
    std::vector<TrianglePoint> result;
    for (const CellPoint& point : triangle_rule(points_per_triangle))
      result.push_back({{1.0 - point.xi[0] - point.xi[1], point.xi[0], point.xi[1]}, point.weight});
    return result;
  }();
  return points;
}

}  // namespace mortise
