#pragma once
// The quadratic tetrahedron.

#include <array>

#include "mortise/shape/reference_domains.hpp"
#include "mortise/shape/tetrahedron4.hpp"
#include "mortise/shape/triangle6.hpp"

namespace mortise {

/// Quadratic tetrahedron: the corners of Tetrahedron4, then the mid-side nodes of the edges 01, 12, 20, 03, 13, 23. With L the functions of
/// Tetrahedron4 the corners have N = L_a (2 L_a - 1), the mid-side nodes 4 L_a L_b. Reference volume 1/6.
struct Tetrahedron10 : ReferenceTetrahedron {
  static constexpr int nodes = 10;  ///< number of nodes
  static constexpr std::array<SideNodes<Triangle6>, 4> sides{
      {{{0, 2, 1, 6, 5, 4}}, {{0, 1, 3, 4, 8, 7}}, {{1, 2, 3, 5, 9, 8}}, {{2, 0, 3, 6, 7, 9}}}};  ///< nodes of each side
  static constexpr int stiffness_points = 4;                                                      ///< of the rule for the stiffness
  static constexpr int mass_points = 15;                                                          ///< of the rule for the mass
  static constexpr int jacobian_points = 15;                                                      ///< of the rule where det J is looked at
  static constexpr int midpoint_directions = 3;  ///< directions of a lattice in which a node is a midpoint
  using Profile = Triangle6;                     ///< below cells that a sweep makes
  using MiddleProfile = Triangle6;               ///< whose nodes lie half way up
  static constexpr int xdmf_number = 38;         ///< in a mixed topology

  /// Shape functions N_a at a reference point.
  template <class T>
  static constexpr std::array<T, 10> values(const std::array<T, 3>& xi) {
    const auto L = Tetrahedron4::values(xi);
    std::array<T, 10> N{};
    for (int a = 0; a < 4; ++a) N[a] = L[a] * (2.0 * L[a] - 1.0);
    for (int e = 0; e < 6; ++e) N[4 + e] = 4.0 * L[edges[e][0]] * L[edges[e][1]];
    return N;
  }

  /// gradients[a][i] = dN_a / dxi_i.
  template <class T>
  static constexpr std::array<std::array<T, 3>, 10> gradients(const std::array<T, 3>& xi) {
    const auto L = Tetrahedron4::values(xi);
    const auto dL = Tetrahedron4::gradients(xi);
    std::array<std::array<T, 3>, 10> dN{};
    for (int i = 0; i < 3; ++i) {
      for (int a = 0; a < 4; ++a) dN[a][i] = (4.0 * L[a] - 1.0) * dL[a][i];
      for (int e = 0; e < 6; ++e) dN[4 + e][i] = 4.0 * (dL[edges[e][0]][i] * L[edges[e][1]] + L[edges[e][0]] * dL[edges[e][1]][i]);
    }
    return dN;
  }

  /// Reference coordinates of the nodes.
  static constexpr std::array<std::array<double, 3>, 10> node_positions{{{0.0, 0.0, 0.0},
                                                                         {1.0, 0.0, 0.0},
                                                                         {0.0, 1.0, 0.0},
                                                                         {0.0, 0.0, 1.0},
                                                                         {0.5, 0.0, 0.0},
                                                                         {0.5, 0.5, 0.0},
                                                                         {0.0, 0.5, 0.0},
                                                                         {0.0, 0.0, 0.5},
                                                                         {0.5, 0.0, 0.5},
                                                                         {0.0, 0.5, 0.5}}};
};

}  // namespace mortise
