#pragma once
// The trilinear hexahedron.

#include <array>

#include "mortise/shape/quadrilateral4.hpp"
#include "mortise/shape/reference_domains.hpp"

namespace mortise {

/// Trilinear hexahedron on [-1, 1]^3: the bottom's corners (those of Quadrilateral4 at zeta = -1), then the top's;
/// N_a = (1 + xi_a xi)(1 + eta_a eta)(1 + zeta_a zeta) / 8. Reference volume 8.
struct Hexahedron8 : ReferenceCube {
  static constexpr int nodes = 8;  ///< number of nodes
  /// Bottom, top, front (y = -1), right (x = 1), back, left.
  static constexpr std::array<SideNodes<Quadrilateral4>, 6> sides{
      {{{0, 3, 2, 1}}, {{4, 5, 6, 7}}, {{0, 1, 5, 4}}, {{1, 2, 6, 5}}, {{2, 3, 7, 6}}, {{3, 0, 4, 7}}}};
  static constexpr int stiffness_points = 8;     ///< of the rule for the stiffness
  static constexpr int mass_points = 8;          ///< of the rule for the mass
  static constexpr int jacobian_points = 8;      ///< of the rule where det J is looked at
  static constexpr int midpoint_directions = 0;  ///< directions of a lattice in which a node is a midpoint
  using Profile = Quadrilateral4;                ///< below cells that a sweep makes
  using MiddleProfile = void;                    ///< whose nodes lie half way up
  static constexpr int xdmf_number = 9;          ///< in a mixed topology

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
};

}  // namespace mortise
