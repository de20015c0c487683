#pragma once
// The linear line: side of the cells and facet of contact surfaces in 2D.

#include <array>

namespace mortise {

/// Linear line with reference nodes -1 and 1; N = ((1 - xi) / 2, (1 + xi) / 2). Reference length 2.
struct Line2 {
  static constexpr int dimension = 1;  ///< number of reference coordinates
  static constexpr int nodes = 2;      ///< number of nodes

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
};

}  // namespace mortise
