#pragma once
// The trilinear hexahedron.

#include <array>

#include "mortise/shape/cell.hpp"

namespace mortise {

/// Trilinear hexahedron on [-1, 1]^3: the bottom's corners (those of Quadrilateral4 at zeta = -1), then the top's;
/// N_a = (1 + xi_a xi)(1 + eta_a eta)(1 + zeta_a zeta) / 8. Reference volume 8.
struct Hexahedron8 {
  static constexpr CellShape shape = CellShape::hexahedron8;  ///< its name
  static constexpr int dimension = 3;                         ///< number of reference coordinates
  static constexpr int nodes = 8;                             ///< number of nodes

  /// Shape functions N_a at a reference point.
  template <class T>
  static constexpr std::array<T, 8> values(const std::array<T, 3>& xi) {
    std::array<T, 8> N{};
    for (int a = 0; a < 8; ++a) {
      const auto& p = node_positions[a];
      N[a] = 0.125 * (1.0 + p[0] * xi[0]) * (1.0 + p[1] * xi[1]) * (1.0 + p[2] * xi[2]);
    }
    return N;
  }

  /// gradients[a][i] = dN_a / dxi_i.
  template <class T>
  static constexpr std::array<std::array<T, 3>, 8> gradients(const std::array<T, 3>& xi) {
    std::array<std::array<T, 3>, 8> dN{};
    for (int a = 0; a < 8; ++a) {
      const auto& p = node_positions[a];
      const T x = 1.0 + p[0] * xi[0], y = 1.0 + p[1] * xi[1], z = 1.0 + p[2] * xi[2];
      dN[a] = {0.125 * p[0] * y * z, 0.125 * p[1] * z * x, 0.125 * p[2] * x * y};
    }
    return dN;
  }

  /// Reference coordinates of the nodes.
  static constexpr std::array<std::array<double, 3>, 8> node_positions{{{-1.0, -1.0, -1.0},
                                                                        {1.0, -1.0, -1.0},
                                                                        {1.0, 1.0, -1.0},
                                                                        {-1.0, 1.0, -1.0},
                                                                        {-1.0, -1.0, 1.0},
                                                                        {1.0, -1.0, 1.0},
                                                                        {1.0, 1.0, 1.0},
                                                                        {-1.0, 1.0, 1.0}}};
  static constexpr std::array<double, 3> centroid{0.0, 0.0, 0.0};  ///< reference coordinates
};

}  // namespace mortise
