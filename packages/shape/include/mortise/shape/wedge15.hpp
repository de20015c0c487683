#pragma once
// The quadratic wedge without nodes inside its sides.

#include <array>
#include <tuple>

#include "mortise/shape/quadrilateral8.hpp"
#include "mortise/shape/reference_domains.hpp"
#include "mortise/shape/triangle3.hpp"
#include "mortise/shape/triangle6.hpp"

namespace mortise {

/// Serendipity wedge: the corners of Wedge6, then the mid-side nodes of the bottom's edges, of the top's, of the upright ones. Shape functions,
/// with L = (1 - xi - eta, xi, eta) and s = zeta_a zeta:
///   Corners                                   N_a = L_a (1 + s)(2 L_a + s - 2) / 2
///   Mid-side nodes of the bottom and the top  N_a = 2 L_b L_c (1 + s)
///   Of the upright edges                      N_a = L_b (1 - zeta^2)
/// They span 1, xi, eta, zeta, all products of two of these, and xi^2 zeta, xi eta zeta, eta^2 zeta, xi zeta^2, eta zeta^2. Reference volume 1.
///
/// Products of two derivatives have degree 4 in (xi, eta) and degree 4 in zeta: 7 x 3 points, exact to degree 5 in each, integrate them. The points
/// also do what the patch test takes of cells with curved edges: derivatives times cofactors of J, of degree 4 in (xi, eta) and 5 in zeta.
struct Wedge15 : ReferenceWedge {
  static constexpr int nodes = 15;  ///< number of nodes
  /// Bottom, top, over the edges 01, 12, 20 of the bottom.
  static constexpr std::tuple<SideNodes<Triangle6>, SideNodes<Triangle6>, SideNodes<Quadrilateral8>, SideNodes<Quadrilateral8>,
                              SideNodes<Quadrilateral8>>
      sides{{{0, 2, 1, 8, 7, 6}}, {{3, 4, 5, 9, 10, 11}}, {{0, 1, 4, 3, 6, 13, 9, 12}}, {{1, 2, 5, 4, 7, 14, 10, 13}}, {{2, 0, 3, 5, 8, 12, 11, 14}}};
  static constexpr int stiffness_points = 21;    ///< of the rule for the stiffness
  static constexpr int mass_points = 21;         ///< of the rule for the mass
  static constexpr int jacobian_points = 21;     ///< of the rule where det J is looked at
  static constexpr int midpoint_directions = 2;  ///< directions of a lattice in which a node is a midpoint
  using Profile = Triangle6;                     ///< below cells that a sweep makes
  using MiddleProfile = Triangle3;               ///< whose nodes lie half way up
  static constexpr int xdmf_number = 40;         ///< in a mixed topology

  /// Shape functions N_a at a reference point.
  template <class T>
  static constexpr std::array<T, 15> values(const std::array<T, 3>& xi) {
    const auto L = Triangle3::values(std::array<T, 2>{xi[0], xi[1]});
    const T &z = xi[2], bubble = (1.0 - z) * (1.0 + z);
    std::array<T, 15> N{};
    for (int a = 0; a < 3; ++a) {
      const T edge = 2.0 * L[a] * L[(a + 1) % 3];
      N[a] = 0.5 * L[a] * (1.0 - z) * (2.0 * L[a] - z - 2.0);
      N[3 + a] = 0.5 * L[a] * (1.0 + z) * (2.0 * L[a] + z - 2.0);
      N[6 + a] = edge * (1.0 - z);
      N[9 + a] = edge * (1.0 + z);
      N[12 + a] = L[a] * bubble;
    }
    return N;
  }

  /// gradients[a][i] = dN_a / dxi_i.
  template <class T>
  static constexpr std::array<std::array<T, 3>, 15> gradients(const std::array<T, 3>& xi) {
    const std::array<T, 2> plane{xi[0], xi[1]};
    const auto L = Triangle3::values(plane);
    const auto dL = Triangle3::gradients(plane);
    const T &z = xi[2], bubble = (1.0 - z) * (1.0 + z);
    std::array<std::array<T, 3>, 15> dN{};
    for (int a = 0; a < 3; ++a) {
      const int b = (a + 1) % 3;
      for (int i = 0; i < 2; ++i) {
        const T edge = 2.0 * (dL[a][i] * L[b] + L[a] * dL[b][i]);
        dN[a][i] = 0.5 * dL[a][i] * (1.0 - z) * (4.0 * L[a] - z - 2.0);
        dN[3 + a][i] = 0.5 * dL[a][i] * (1.0 + z) * (4.0 * L[a] + z - 2.0);
        dN[6 + a][i] = edge * (1.0 - z);
        dN[9 + a][i] = edge * (1.0 + z);
        dN[12 + a][i] = dL[a][i] * bubble;
      }
      const T edge = 2.0 * L[a] * L[b];
      dN[a][2] = 0.5 * L[a] * (1.0 + 2.0 * z - 2.0 * L[a]);
      dN[3 + a][2] = 0.5 * L[a] * (2.0 * L[a] + 2.0 * z - 1.0);
      dN[6 + a][2] = -edge;
      dN[9 + a][2] = edge;
      dN[12 + a][2] = -2.0 * L[a] * z;
    }
    return dN;
  }

  /// Reference coordinates of the nodes.
  static constexpr std::array<std::array<double, 3>, 15> node_positions{{{0.0, 0.0, -1.0},
                                                                         {1.0, 0.0, -1.0},
                                                                         {0.0, 1.0, -1.0},  // bottom
                                                                         {0.0, 0.0, 1.0},
                                                                         {1.0, 0.0, 1.0},
                                                                         {0.0, 1.0, 1.0},  // top
                                                                         {0.5, 0.0, -1.0},
                                                                         {0.5, 0.5, -1.0},
                                                                         {0.0, 0.5, -1.0},  // edges of the bottom
                                                                         {0.5, 0.0, 1.0},
                                                                         {0.5, 0.5, 1.0},
                                                                         {0.0, 0.5, 1.0},  // of the top
                                                                         {0.0, 0.0, 0.0},
                                                                         {1.0, 0.0, 0.0},
                                                                         {0.0, 1.0, 0.0}}};  // upright
};

}  // namespace mortise
