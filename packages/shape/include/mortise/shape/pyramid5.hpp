#pragma once
// The pyramid of five nodes.

#include <array>
#include <tuple>

#include "mortise/shape/quadrilateral4.hpp"
#include "mortise/shape/reference_domains.hpp"
#include "mortise/shape/triangle3.hpp"

namespace mortise {

/// Pyramid on ReferencePyramid: the base's corners (those of Quadrilateral4 at zeta = 0), then the apex. Reference volume 4/3. With the coordinates
/// u = xi / (1 - zeta), v = eta / (1 - zeta) of the ray from the apex through the point,
///   base  N_a = (1 - zeta)(1 + xi_a u)(1 + eta_a v) / 4,   apex  N = zeta.
/// On the base they are those of Quadrilateral4, on the other sides, where |u| = 1 or |v| = 1, the linear ones of Triangle3: a pyramid conforms with
/// its neighbours of either kind. They are rational in (xi, eta, zeta): no polynomials do this with five nodes.
///
/// The derivatives
///   dN_a/dxi = xi_a (1 + eta_a v) / 4,   dN_a/deta = eta_a (1 + xi_a u) / 4,   dN_a/dzeta = (xi_a eta_a u v - 1) / 4
/// depend on (u, v) alone. So do J, strains and stresses, also of distorted cells: they are constant along each ray. The volume is
/// (1 - zeta)^2 du dv dzeta. Products of two derivatives have degree 2 in u and in v. They are integrated exactly by 2 x 2 Gauss points with a single
/// one along zeta, for the weight (1 - zeta)^2; more points along a ray would see the same strain again.
///
/// Let J = (a + v b, c + u b, h + u v b), where a, b, c, h are sums of positions of nodes. Then
///   det J = a x c . h + u a x b . h + v b x c . h + u v a x c . b
/// is bilinear in u and v: positive everywhere if it is so at the corners of the base. The cofactors of J times a derivative have degree 2 at most in
/// u and in v too: the patch test is exact.
///
/// At the apex a derivative has another limit along each ray. The one along the axis, u = v = 0, is taken there: the mean of those along the edges.
struct Pyramid5 : ReferencePyramid {
  static constexpr int nodes = 5;  ///< number of nodes
  /// Base, over the edges 01, 12, 23, 30 of the base.
  static constexpr std::tuple<SideNodes<Quadrilateral4>, SideNodes<Triangle3>, SideNodes<Triangle3>, SideNodes<Triangle3>, SideNodes<Triangle3>>
      sides{{{0, 3, 2, 1}}, {{0, 1, 4}}, {{1, 2, 4}}, {{2, 3, 4}}, {{3, 0, 4}}};
  static constexpr int stiffness_points = 4;     ///< of the rule for the stiffness
  static constexpr int mass_points = 8;          ///< of the rule for the mass
  static constexpr int jacobian_points = 0;      ///< of the rule where det J is looked at
  static constexpr int midpoint_directions = 0;  ///< directions of a lattice in which a node is a midpoint
  using Profile = void;                          ///< below cells that a sweep makes
  using MiddleProfile = void;                    ///< whose nodes lie half way up
  static constexpr int xdmf_number = 7;          ///< in a mixed topology

  /// Shape functions N_a at a reference point.
  template <class T>
  static constexpr std::array<T, 5> values(const std::array<T, 3>& xi) {
    const auto base = Quadrilateral4::values(ray(xi));
    std::array<T, 5> N{};
    for (int a = 0; a < 4; ++a) N[a] = (1.0 - xi[2]) * base[a];
    N[4] = xi[2];
    return N;
  }

  /// gradients[a][i] = dN_a / dxi_i.
  template <class T>
  static constexpr std::array<std::array<T, 3>, 5> gradients(const std::array<T, 3>& xi) {
    const auto [u, v] = ray(xi);
    std::array<std::array<T, 3>, 5> dN{};
    for (int a = 0; a < 4; ++a) {
      const auto& p = node_positions[a];
      dN[a] = {0.25 * p[0] * (1.0 + p[1] * v), 0.25 * p[1] * (1.0 + p[0] * u), 0.25 * (p[0] * p[1] * u * v - 1.0)};
    }
    dN[4][2] = T(1.0);
    return dN;
  }

  /// Reference coordinates of the nodes.
  static constexpr std::array<std::array<double, 3>, 5> node_positions{
      {{-1.0, -1.0, 0.0}, {1.0, -1.0, 0.0}, {1.0, 1.0, 0.0}, {-1.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}};
};

}  // namespace mortise
