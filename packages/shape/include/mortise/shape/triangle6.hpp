#pragma once
// The quadratic triangle.

#include <array>

#include "mortise/shape/line3.hpp"
#include "mortise/shape/reference_domains.hpp"

namespace mortise {

/// Quadratic triangle: corners (0,0), (1,0), (0,1), then the mid-side nodes of 01, 12, 20. With L = (1 - xi - eta, xi, eta) the corners have N = L_a
/// (2 L_a - 1), the mid-side nodes 4 L_a L_b. Reference area 1/2.
struct Triangle6 : ReferenceTriangle {
  static constexpr int nodes = 6;                                                                   ///< number of nodes
  static constexpr std::array<SideNodes<Line3>, 3> sides{{{{0, 1, 3}}, {{1, 2, 4}}, {{2, 0, 5}}}};  ///< nodes of each side
  static constexpr int stiffness_points = 3;                                                        ///< of the rule for the stiffness
  static constexpr int axisymmetric_stiffness_points = 7;                                           ///< of the rule for the axisymmetric stiffness
  static constexpr int mass_points = 7;                                                             ///< of the rule for the mass
  static constexpr int axisymmetric_mass_points = 7;                                                ///< of the rule for the axisymmetric mass
  static constexpr int side_points = 7;                                                             ///< of the rule for loads on a side of this shape
  static constexpr int jacobian_points = 7;                                                         ///< of the rule where det J is looked at
  static constexpr int midpoint_directions = 3;  ///< directions of a lattice in which a node is a midpoint
  static constexpr int xdmf_number = 36;         ///< in a mixed topology

  /// Shape functions N_a at a reference point.
  template <class T>
  static constexpr std::array<T, 6> values(const std::array<T, 2>& xi) {
    const T &x = xi[0], &y = xi[1];
    const T rest = 1.0 - x - y;
    return {rest * (2.0 * rest - 1.0), x * (2.0 * x - 1.0), y * (2.0 * y - 1.0), 4.0 * rest * x, 4.0 * x * y, 4.0 * y * rest};
  }

  /// gradients[a][i] = dN_a / dxi_i.
  template <class T>
  static constexpr std::array<std::array<T, 2>, 6> gradients(const std::array<T, 2>& xi) {
    const T &x = xi[0], &y = xi[1];
    const T rest = 1.0 - x - y, corner = 1.0 - 4.0 * rest;
    return {{{corner, corner},
             {4.0 * x - 1.0, T(0.0)},
             {T(0.0), 4.0 * y - 1.0},
             {4.0 * (rest - x), -4.0 * x},
             {4.0 * y, 4.0 * x},
             {-4.0 * y, 4.0 * (rest - y)}}};
  }

  /// Reference coordinates of the nodes.
  static constexpr std::array<std::array<double, 2>, 6> node_positions{{{0.0, 0.0}, {1.0, 0.0}, {0.0, 1.0}, {0.5, 0.0}, {0.5, 0.5}, {0.0, 0.5}}};
};

}  // namespace mortise
