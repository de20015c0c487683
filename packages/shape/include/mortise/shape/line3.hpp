#pragma once
// The quadratic line: side of the quadratic cells of the plane.

#include <array>

#include "mortise/shape/cell.hpp"

namespace mortise {

/// Quadratic line with reference nodes -1, 1 and 0; N = (xi (xi - 1) / 2, xi (xi + 1) / 2, 1 - xi^2). Reference length 2.
struct Line3 {
  static constexpr CellShape shape = CellShape::line3;  ///< its name
  static constexpr int dimension = 1;                   ///< number of reference coordinates
  static constexpr int nodes = 3;                       ///< number of nodes

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
};

}  // namespace mortise
