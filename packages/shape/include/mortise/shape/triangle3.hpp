#pragma once
// The linear triangle.

#include <array>

#include "mortise/shape/cell.hpp"

namespace mortise {

/// Linear triangle with reference nodes (0,0), (1,0), (0,1); N = (1 - xi - eta, xi, eta). Reference area 1/2.
struct Triangle3 {
  static constexpr CellShape shape = CellShape::triangle3;  ///< its name
  static constexpr int dimension = 2;                       ///< number of reference coordinates
  static constexpr int nodes = 3;                           ///< number of nodes

  /// Shape functions N_a at a reference point.
  template <class T>
  static constexpr std::array<T, 3> values(const std::array<T, 2>& xi) {
    return {T(1.0) - xi[0] - xi[1], xi[0], xi[1]};
  }

  /// gradients[a][i] = dN_a / dxi_i.
  template <class T>
  static constexpr std::array<std::array<T, 2>, 3> gradients(const std::array<T, 2>&) {
    return {{{T(-1.0), T(-1.0)}, {T(1.0), T(0.0)}, {T(0.0), T(1.0)}}};
  }

  /// Reference coordinates of the nodes.
  static constexpr std::array<std::array<double, 2>, 3> node_positions{{{0.0, 0.0}, {1.0, 0.0}, {0.0, 1.0}}};
  static constexpr std::array<double, 2> centroid{1.0 / 3.0, 1.0 / 3.0};  ///< reference coordinates
};

}  // namespace mortise
