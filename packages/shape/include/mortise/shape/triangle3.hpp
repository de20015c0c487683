#pragma once
// The linear triangle.

#include <array>

#include "mortise/shape/line2.hpp"
#include "mortise/shape/reference_domains.hpp"

namespace mortise {

/// Linear triangle with reference nodes (0,0), (1,0), (0,1); N = (1 - xi - eta, xi, eta). Reference area 1/2.
struct Triangle3 : ReferenceTriangle {
  static constexpr int nodes = 3;                                                          ///< number of nodes
  static constexpr std::array<SideNodes<Line2>, 3> sides{{{{0, 1}}, {{1, 2}}, {{2, 0}}}};  ///< nodes of each side
  static constexpr int stiffness_points = 1;                                               ///< of the rule for the stiffness
  static constexpr int axisymmetric_stiffness_points = 3;                                  ///< of the rule for the axisymmetric stiffness
  static constexpr int mass_points = 3;                                                    ///< of the rule for the mass
  static constexpr int axisymmetric_mass_points = 7;                                       ///< of the rule for the axisymmetric mass
  static constexpr int side_points = 7;                                                    ///< of the rule for loads on a side of this shape
  static constexpr int midpoint_directions = 0;                                            ///< directions of a lattice in which a node is a midpoint
  static constexpr int xdmf_number = 4;                                                    ///< in a mixed topology

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
};

}  // namespace mortise
