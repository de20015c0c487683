#pragma once
// The bilinear quadrilateral.

#include <array>

#include "mortise/shape/cell.hpp"

namespace mortise {

/// Bilinear quadrilateral with reference nodes (-1,-1), (1,-1), (1,1), (-1,1); N_a = (1 + xi_a xi)(1 + eta_a eta) / 4. Reference area 4.
struct Quadrilateral4 {
  static constexpr CellShape shape = CellShape::quadrilateral4;  ///< its name
  static constexpr int dimension = 2;                            ///< number of reference coordinates
  static constexpr int nodes = 4;                                ///< number of nodes

  /// Shape functions N_a at a reference point.
  template <class T>
  static constexpr std::array<T, 4> values(const std::array<T, 2>& xi) {
    const T left = 0.5 * (1.0 - xi[0]), right = 0.5 * (1.0 + xi[0]);
    const T bottom = 0.5 * (1.0 - xi[1]), top = 0.5 * (1.0 + xi[1]);
    return {left * bottom, right * bottom, right * top, left * top};
  }

  /// gradients[a][i] = dN_a / dxi_i.
  template <class T>
  static constexpr std::array<std::array<T, 2>, 4> gradients(const std::array<T, 2>& xi) {
    const T left = 0.5 * (1.0 - xi[0]), right = 0.5 * (1.0 + xi[0]);
    const T bottom = 0.5 * (1.0 - xi[1]), top = 0.5 * (1.0 + xi[1]);
    return {{{-0.5 * bottom, -0.5 * left}, {0.5 * bottom, -0.5 * right}, {0.5 * top, 0.5 * right}, {-0.5 * top, 0.5 * left}}};
  }

  /// Reference coordinates of the nodes.
  static constexpr std::array<std::array<double, 2>, 4> node_positions{{{-1.0, -1.0}, {1.0, -1.0}, {1.0, 1.0}, {-1.0, 1.0}}};
  static constexpr std::array<double, 2> centroid{0.0, 0.0};  ///< reference coordinates
};

}  // namespace mortise
