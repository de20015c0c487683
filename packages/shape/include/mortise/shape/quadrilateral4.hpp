#pragma once
// The bilinear quadrilateral.

#include <array>

#include "mortise/shape/line2.hpp"
#include "mortise/shape/reference_domains.hpp"

namespace mortise {

/// Bilinear quadrilateral with reference nodes (-1,-1), (1,-1), (1,1), (-1,1); N_a = (1 + xi_a xi)(1 + eta_a eta) / 4. Reference area 4.
struct Quadrilateral4 : ReferenceSquare {
  static constexpr int nodes = 4;                                                                    ///< number of nodes
  static constexpr std::array<SideNodes<Line2>, 4> sides{{{{0, 1}}, {{1, 2}}, {{2, 3}}, {{3, 0}}}};  ///< nodes of each side
  static constexpr int stiffness_points = 4;                                                         ///< of the rule for the stiffness
  static constexpr int axisymmetric_stiffness_points = 4;                                            ///< of the rule for the axisymmetric stiffness
  static constexpr int mass_points = 4;                                                              ///< of the rule for the mass
  static constexpr int axisymmetric_mass_points = 4;                                                 ///< of the rule for the axisymmetric mass
  static constexpr int side_points = 9;          ///< of the rule for loads on a side of this shape
  static constexpr int jacobian_points = 0;      ///< of the rule where det J is looked at
  static constexpr int midpoint_directions = 0;  ///< directions of a lattice in which a node is a midpoint
  static constexpr int xdmf_number = 5;          ///< in a mixed topology

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
};

}  // namespace mortise
