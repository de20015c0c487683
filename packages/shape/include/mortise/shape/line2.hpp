#pragma once
// The linear line: side of the cells and facet of contact surfaces in 2D.

#include <array>
#include <tuple>

#include "mortise/shape/reference_domains.hpp"

namespace mortise {

/// Linear line with reference nodes -1 and 1; N = ((1 - xi) / 2, (1 + xi) / 2). Reference length 2.
struct Line2 : ReferenceLine {
  static constexpr int nodes = 2;                ///< number of nodes
  static constexpr std::tuple<> sides{};         ///< none
  static constexpr int side_points = 3;          ///< of the rule for loads on a side of this shape
  static constexpr int midpoint_directions = 0;  ///< directions of a lattice in which a node is a midpoint
  static constexpr int xdmf_number = 2;          ///< in a mixed topology

  /// Shape functions N_a at a reference point.
  template <class T>
  static constexpr std::array<T, 2> values(const T& xi) {
    return {0.5 * (1.0 - xi), 0.5 * (1.0 + xi)};
  }

  /// dN_a / dxi.
  template <class T>
  static constexpr std::array<T, 2> gradients(const T&) {
    return {T(-0.5), T(0.5)};
  }

  /// Values at a point given as an array, as for cells in 2D and 3D.
  template <class T>
  static constexpr std::array<T, 2> values(const std::array<T, 1>& xi) {
    return values(xi[0]);
  }

  /// gradients[a][0] = dN_a / dxi.
  template <class T>
  static constexpr std::array<std::array<T, 1>, 2> gradients(const std::array<T, 1>& xi) {
    const auto slopes = gradients(xi[0]);
    return {{{slopes[0]}, {slopes[1]}}};
  }

  /// Reference coordinates of the nodes.
  static constexpr std::array<std::array<double, 1>, 2> node_positions{{{-1.0}, {1.0}}};
};

}  // namespace mortise
