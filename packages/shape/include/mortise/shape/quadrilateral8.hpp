#pragma once
// The quadratic quadrilateral without a node inside.

#include <array>

#include "mortise/shape/line3.hpp"
#include "mortise/shape/reference_domains.hpp"

namespace mortise {

/// Serendipity quadrilateral on [-1, 1]^2: the corners of Quadrilateral4, then the mid-side nodes of 01, 12, 23, 30. Reference area 4.
///   corners         N_a = (1 + xi_a xi)(1 + eta_a eta)(xi_a xi + eta_a eta - 1) / 4
///   mid-side nodes  N_a = (1 - xi^2)(1 + eta_a eta) / 2  where xi_a = 0,  (1 + xi_a xi)(1 - eta^2) / 2  where eta_a = 0
struct Quadrilateral8 : ReferenceSquare {
  static constexpr int nodes = 8;                                                                                ///< number of nodes
  static constexpr std::array<SideNodes<Line3>, 4> sides{{{{0, 1, 4}}, {{1, 2, 5}}, {{2, 3, 6}}, {{3, 0, 7}}}};  ///< nodes of each side
  static constexpr int stiffness_points = 9;                                                                     ///< of the rule for the stiffness
  static constexpr int axisymmetric_stiffness_points = 9;  ///< of the rule for the axisymmetric stiffness
  static constexpr int mass_points = 9;                    ///< of the rule for the mass
  static constexpr int axisymmetric_mass_points = 9;       ///< of the rule for the axisymmetric mass
  static constexpr int side_points = 16;                   ///< of the rule for loads on a side of this shape
  static constexpr int jacobian_points = 9;                ///< of the rule where det J is looked at
  static constexpr int midpoint_directions = 1;            ///< directions of a lattice in which a node is a midpoint
  static constexpr int xdmf_number = 37;                   ///< in a mixed topology

  /// Shape functions N_a at a reference point.
  template <class T>
  static constexpr std::array<T, 8> values(const std::array<T, 2>& xi) {
    const T &x = xi[0], &y = xi[1];
    std::array<T, 8> N{};
    for (int a = 0; a < 4; ++a) {
      const T s = node_positions[a][0] * x, t = node_positions[a][1] * y;
      N[a] = 0.25 * (1.0 + s) * (1.0 + t) * (s + t - 1.0);
    }
    for (int a = 4; a < 8; ++a)
      N[a] = a % 2 == 0 ? 0.5 * (1.0 - x) * (1.0 + x) * (1.0 + node_positions[a][1] * y)
                        : 0.5 * (1.0 + node_positions[a][0] * x) * (1.0 - y) * (1.0 + y);
    return N;
  }

  /// gradients[a][i] = dN_a / dxi_i.
  template <class T>
  static constexpr std::array<std::array<T, 2>, 8> gradients(const std::array<T, 2>& xi) {
    const T &x = xi[0], &y = xi[1];
    std::array<std::array<T, 2>, 8> dN{};
    for (int a = 0; a < 4; ++a) {
      const double xa = node_positions[a][0], ya = node_positions[a][1];
      const T s = xa * x, t = ya * y;
      dN[a] = {0.25 * xa * (1.0 + t) * (2.0 * s + t), 0.25 * ya * (1.0 + s) * (s + 2.0 * t)};
    }
    for (int a = 4; a < 8; ++a) {
      const double xa = node_positions[a][0], ya = node_positions[a][1];
      if (a % 2 == 0)
        dN[a] = {-x * (1.0 + ya * y), 0.5 * ya * (1.0 - x) * (1.0 + x)};
      else
        dN[a] = {0.5 * xa * (1.0 - y) * (1.0 + y), -y * (1.0 + xa * x)};
    }
    return dN;
  }

  /// Reference coordinates of the nodes.
  static constexpr std::array<std::array<double, 2>, 8> node_positions{
      {{-1.0, -1.0}, {1.0, -1.0}, {1.0, 1.0}, {-1.0, 1.0}, {0.0, -1.0}, {1.0, 0.0}, {0.0, 1.0}, {-1.0, 0.0}}};
};

}  // namespace mortise
