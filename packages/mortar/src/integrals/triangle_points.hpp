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

/// The rule for a slave facet of so many nodes: 7 points (degree 5); 12 (degree 6) where products of functions of 8 nodes have to be told apart.
inline const std::vector<TrianglePoint>& triangle_points(std::size_t slave_nodes) {
  const auto make = [](int points) {
    std::vector<TrianglePoint> result;
    for (const CellPoint& point : triangle_rule(points))
      result.push_back({{1.0 - point.xi[0] - point.xi[1], point.xi[0], point.xi[1]}, point.weight});
    return result;
  };
  static const std::vector<TrianglePoint> seven = make(7), twelve = make(12);
  return slave_nodes == 8 ? twelve : seven;
}

}  // namespace mortise
