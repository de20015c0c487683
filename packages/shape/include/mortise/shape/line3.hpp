#pragma once
// The quadratic line: side of the quadratic cells of the plane.

#include <array>
#include <tuple>

#include "mortise/shape/reference_domains.hpp"

namespace mortise {

/// Quadratic line with reference nodes -1, 1 and 0; N = (xi (xi - 1) / 2, xi (xi + 1) / 2, 1 - xi^2). Reference length 2.
struct Line3 : ReferenceLine {
  static constexpr int nodes = 3;                ///< number of nodes
  static constexpr std::tuple<> sides{};         ///< none
  static constexpr int side_points = 4;          ///< of the rule for loads on a side of this shape
  static constexpr int jacobian_points = 0;      ///< of the rule where det J is looked at
  static constexpr int midpoint_directions = 1;  ///< directions of a lattice in which a node is a midpoint
  static constexpr int xdmf_number = 34;         ///< in a mixed topology

  /// Shape functions N_a at a reference point.
  template <class T>
  static constexpr std::array<T, 3> values(const T& xi) {
    return {0.5 * xi * (xi - 1.0), 0.5 * xi * (xi + 1.0), (1.0 - xi) * (1.0 + xi)};
  }

  /// dN_a / dxi.
  template <class T>
  static constexpr std::array<T, 3> gradients(const T& xi) {
    return {xi - 0.5, xi + 0.5, -2.0 * xi};
  }

  /// Values at a point given as an array, as for cells in 2D and 3D.
  template <class T>
  static constexpr std::array<T, 3> values(const std::array<T, 1>& xi) {
    return values(xi[0]);
  }

  /// gradients[a][0] = dN_a / dxi.
  template <class T>
  static constexpr std::array<std::array<T, 1>, 3> gradients(const std::array<T, 1>& xi) {
    const auto slopes = gradients(xi[0]);
    return {{{slopes[0]}, {slopes[1]}, {slopes[2]}}};
  }

  /// Reference coordinates of the nodes.
  static constexpr std::array<std::array<double, 1>, 3> node_positions{{{-1.0}, {1.0}, {0.0}}};
};

}  // namespace mortise
