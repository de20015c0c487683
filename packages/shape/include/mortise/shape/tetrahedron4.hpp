#pragma once
// The linear tetrahedron.

#include <array>

#include "mortise/shape/cell.hpp"

namespace mortise {

/// Linear tetrahedron with reference nodes (0,0,0), (1,0,0), (0,1,0), (0,0,1); N = (1 - xi - eta - zeta, xi, eta, zeta). Reference volume 1/6.
struct Tetrahedron4 {
  static constexpr CellShape shape = CellShape::tetrahedron4;  ///< its name
  static constexpr int dimension = 3;                          ///< number of reference coordinates
  static constexpr int nodes = 4;                              ///< number of nodes

  /// Shape functions N_a at a reference point.
  template <class T>
  static constexpr std::array<T, 4> values(const std::array<T, 3>& xi) {
    return {1.0 - xi[0] - xi[1] - xi[2], xi[0], xi[1], xi[2]};
  }

  /// gradients[a][i] = dN_a / dxi_i.
  template <class T>
  static constexpr std::array<std::array<T, 3>, 4> gradients(const std::array<T, 3>&) {
    const T zero(0.0), one(1.0);
    return {{{-one, -one, -one}, {one, zero, zero}, {zero, one, zero}, {zero, zero, one}}};
  }

  /// Reference coordinates of the nodes.
  static constexpr std::array<std::array<double, 3>, 4> node_positions{{{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}};
  static constexpr std::array<double, 3> centroid{0.25, 0.25, 0.25};  ///< reference coordinates
};

}  // namespace mortise
