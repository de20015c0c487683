#pragma once
// The quadratic hexahedron without nodes inside its sides.

#include <array>

#include "mortise/shape/quadrilateral4.hpp"
#include "mortise/shape/quadrilateral8.hpp"
#include "mortise/shape/reference_domains.hpp"

namespace mortise {

/// Serendipity hexahedron on [-1, 1]^3: the corners of Hexahedron8, then the mid-side nodes of the bottom's edges, of the top's, of the upright ones.
/// Reference volume 8. With s_i = xi_ai xi_i:
///   corners                           N_a = (1 + s_1)(1 + s_2)(1 + s_3)(s_1 + s_2 + s_3 - 2) / 8
///   mid-side nodes, where xi_ak = 0   N_a = (1 - xi_k^2)(1 + s_l)(1 + s_m) / 4
struct Hexahedron20 : ReferenceCube {
  static constexpr int nodes = 20;  ///< number of nodes
  /// Bottom, top, front (y = -1), right (x = 1), back, left.
  static constexpr std::array<SideNodes<Quadrilateral8>, 6> sides{{{{0, 3, 2, 1, 11, 10, 9, 8}},
                                                                   {{4, 5, 6, 7, 12, 13, 14, 15}},
                                                                   {{0, 1, 5, 4, 8, 17, 12, 16}},
                                                                   {{1, 2, 6, 5, 9, 18, 13, 17}},
                                                                   {{2, 3, 7, 6, 10, 19, 14, 18}},
                                                                   {{3, 0, 4, 7, 11, 16, 15, 19}}}};
  static constexpr int stiffness_points = 27;    ///< of the rule for the stiffness
  static constexpr int mass_points = 27;         ///< of the rule for the mass
  static constexpr int jacobian_points = 27;     ///< of the rule where det J is looked at
  static constexpr int midpoint_directions = 1;  ///< directions of a lattice in which a node is a midpoint
  using Profile = Quadrilateral8;                ///< below cells that a sweep makes
  using MiddleProfile = Quadrilateral4;          ///< whose nodes lie half way up
  static constexpr int xdmf_number = 48;         ///< in a mixed topology

  /// Shape functions N_a at a reference point.
  template <class T>
  static constexpr std::array<T, 20> values(const std::array<T, 3>& xi) {
    std::array<T, 20> N{};
    for (int a = 0; a < 20; ++a) {
      const auto& p = node_positions[a];
      const std::array<T, 3> s{p[0] * xi[0], p[1] * xi[1], p[2] * xi[2]};
      if (a < 8) {
        N[a] = 0.125 * (1.0 + s[0]) * (1.0 + s[1]) * (1.0 + s[2]) * (s[0] + s[1] + s[2] - 2.0);
      } else {
        const int k = direction(a), l = (k + 1) % 3, m = (k + 2) % 3;
        N[a] = 0.25 * (1.0 - xi[k]) * (1.0 + xi[k]) * (1.0 + s[l]) * (1.0 + s[m]);
      }
    }
    return N;
  }

  /// gradients[a][i] = dN_a / dxi_i.
  template <class T>
  static constexpr std::array<std::array<T, 3>, 20> gradients(const std::array<T, 3>& xi) {
    std::array<std::array<T, 3>, 20> dN{};
    for (int a = 0; a < 20; ++a) {
      const auto& p = node_positions[a];
      const std::array<T, 3> s{p[0] * xi[0], p[1] * xi[1], p[2] * xi[2]};
      if (a < 8) {
        for (int k = 0; k < 3; ++k) {
          const int l = (k + 1) % 3, m = (k + 2) % 3;
          dN[a][k] = 0.125 * p[k] * (1.0 + s[l]) * (1.0 + s[m]) * (2.0 * s[k] + s[l] + s[m] - 1.0);
        }
      } else {
        const int k = direction(a), l = (k + 1) % 3, m = (k + 2) % 3;
        const T bubble = (1.0 - xi[k]) * (1.0 + xi[k]);
        dN[a][k] = -0.5 * xi[k] * (1.0 + s[l]) * (1.0 + s[m]);
        dN[a][l] = 0.25 * bubble * p[l] * (1.0 + s[m]);
        dN[a][m] = 0.25 * bubble * (1.0 + s[l]) * p[m];
      }
    }
    return dN;
  }

  /// Reference coordinates of the nodes.
  static constexpr std::array<std::array<double, 3>, 20> node_positions{
      {{-1.0, -1.0, -1.0}, {1.0, -1.0, -1.0}, {1.0, 1.0, -1.0}, {-1.0, 1.0, -1.0},   // bottom
       {-1.0, -1.0, 1.0},  {1.0, -1.0, 1.0},  {1.0, 1.0, 1.0},  {-1.0, 1.0, 1.0},    // top
       {0.0, -1.0, -1.0},  {1.0, 0.0, -1.0},  {0.0, 1.0, -1.0}, {-1.0, 0.0, -1.0},   // edges of the bottom
       {0.0, -1.0, 1.0},   {1.0, 0.0, 1.0},   {0.0, 1.0, 1.0},  {-1.0, 0.0, 1.0},    // of the top
       {-1.0, -1.0, 0.0},  {1.0, -1.0, 0.0},  {1.0, 1.0, 0.0},  {-1.0, 1.0, 0.0}}};  // upright

 private:
  /// Of the edge that node a >= 8 is the middle of.
  static constexpr int direction(int a) { return a >= 16 ? 2 : a % 2; }
};

}  // namespace mortise
