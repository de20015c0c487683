#pragma once
// The linear wedge.

#include <array>
#include <tuple>

#include "mortise/shape/quadrilateral4.hpp"
#include "mortise/shape/reference_domains.hpp"
#include "mortise/shape/triangle3.hpp"

namespace mortise {

/// Linear wedge: the bottom's corners (those of Triangle3 at zeta = -1), then the top's. With L = (1 - xi - eta, xi, eta) the bottom's corners have
/// N = L_a (1 - zeta) / 2, the top's L_a (1 + zeta) / 2. Reference volume 1.
///
/// Products of two derivatives have degree 2 in (xi, eta) and degree 2 in zeta: 3 x 2 points integrate them exactly. So they do what the patch test
/// takes of distorted cells, products of the derivatives and of cofactors of J: degree 1 in (xi, eta), 2 in zeta.
struct Wedge6 : ReferenceWedge {
  static constexpr int nodes = 6;  ///< number of nodes
  /// Bottom, top, over the edges 01, 12, 20 of the bottom.
  static constexpr std::tuple<SideNodes<Triangle3>, SideNodes<Triangle3>, SideNodes<Quadrilateral4>, SideNodes<Quadrilateral4>,
                              SideNodes<Quadrilateral4>>
      sides{{{0, 2, 1}}, {{3, 4, 5}}, {{0, 1, 4, 3}}, {{1, 2, 5, 4}}, {{2, 0, 3, 5}}};
  static constexpr int stiffness_points = 6;     ///< of the rule for the stiffness
  static constexpr int mass_points = 6;          ///< of the rule for the mass
  static constexpr int jacobian_points = 6;      ///< of the rule where det J is looked at
  static constexpr int midpoint_directions = 0;  ///< directions of a lattice in which a node is a midpoint
  using Profile = Triangle3;                     ///< below cells that a sweep makes
  using MiddleProfile = void;                    ///< whose nodes lie half way up
  static constexpr int xdmf_number = 8;          ///< in a mixed topology

  /// Shape functions N_a at a reference point.
  template <class T>
  static constexpr std::array<T, 6> values(const std::array<T, 3>& xi) {
    const auto L = Triangle3::values(std::array<T, 2>{xi[0], xi[1]});
    const T bottom = 0.5 * (1.0 - xi[2]), top = 0.5 * (1.0 + xi[2]);
    std::array<T, 6> N{};
    for (int a = 0; a < 3; ++a) {
      N[a] = L[a] * bottom;
      N[3 + a] = L[a] * top;
    }
    return N;
  }

  /// gradients[a][i] = dN_a / dxi_i.
  template <class T>
  static constexpr std::array<std::array<T, 3>, 6> gradients(const std::array<T, 3>& xi) {
    const std::array<T, 2> plane{xi[0], xi[1]};
    const auto L = Triangle3::values(plane);
    const auto dL = Triangle3::gradients(plane);
    const T bottom = 0.5 * (1.0 - xi[2]), top = 0.5 * (1.0 + xi[2]);
    std::array<std::array<T, 3>, 6> dN{};
    for (int a = 0; a < 3; ++a) {
      dN[a] = {dL[a][0] * bottom, dL[a][1] * bottom, -0.5 * L[a]};
      dN[3 + a] = {dL[a][0] * top, dL[a][1] * top, 0.5 * L[a]};
    }
    return dN;
  }

  /// Reference coordinates of the nodes.
  static constexpr std::array<std::array<double, 3>, 6> node_positions{
      {{0.0, 0.0, -1.0}, {1.0, 0.0, -1.0}, {0.0, 1.0, -1.0}, {0.0, 0.0, 1.0}, {1.0, 0.0, 1.0}, {0.0, 1.0, 1.0}}};
};

}  // namespace mortise
