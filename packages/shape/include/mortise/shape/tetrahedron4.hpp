#pragma once
// The linear tetrahedron.

#include <array>

#include "mortise/shape/reference_domains.hpp"
#include "mortise/shape/triangle3.hpp"

namespace mortise {

/// Linear tetrahedron with reference nodes (0,0,0), (1,0,0), (0,1,0), (0,0,1); N = (1 - xi - eta - zeta, xi, eta, zeta). Reference volume 1/6.
struct Tetrahedron4 : ReferenceTetrahedron {
  static constexpr int nodes = 4;                                                                                    ///< number of nodes
  static constexpr std::array<SideNodes<Triangle3>, 4> sides{{{{0, 2, 1}}, {{0, 1, 3}}, {{1, 2, 3}}, {{2, 0, 3}}}};  ///< nodes of each side
  static constexpr int stiffness_points = 1;     ///< of the rule for the stiffness
  static constexpr int mass_points = 4;          ///< of the rule for the mass
  static constexpr int midpoint_directions = 0;  ///< directions of a lattice in which a node is a midpoint
  using Profile = Triangle3;                     ///< below cells that a sweep makes
  using MiddleProfile = void;                    ///< whose nodes lie half way up
  static constexpr int xdmf_number = 6;          ///< in a mixed topology

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
};

}  // namespace mortise
