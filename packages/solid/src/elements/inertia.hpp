#pragma once
// Integrals of shape functions over the reference configuration: volumes and masses of nodes.

#include <array>
#include <tuple>

#include "mortise/solid/element_loop.hpp"

namespace mortise {

/// v_a = integral of N_a dV0, by the rule of the stiffness. An integrand, see ElementLoop.
template <class OfCells>
struct Volume {
  using Geometry = OfCells;
  static constexpr int nodes = Geometry::nodes, components = 1, point_count = Geometry::stiffness_points;
  using Reads = std::tuple<>;
  using Residual = std::array<double, nodes>;

  template <class Points, class Sums>
  void add(const Points& points, Sums& sums) const {
    for (int q = 0; q < point_count; ++q) {
      const auto at = points[q];
      for (int a = 0; a < nodes; ++a) sums.residual[a] += at.weight * at.N[a];
    }
  }
};

/// The consistent mass matrix, M_ab = integral of rho0 N_a N_b dV0 in each component. An integrand, see ElementLoop.
template <class OfCells>
struct Inertia {
  using Geometry = OfCells;
  static constexpr int nodes = Geometry::nodes, point_count = Geometry::mass_points;
  using Reads = std::tuple<>;
  using Tangent = NodalPairs<nodes>;

  double density;  ///< rho0

  template <class Points, class Sums>
  void add(const Points& points, Sums& sums) const {
    for (int q = 0; q < point_count; ++q) {
      const auto at = points[q];
      for (int a = 0; a < nodes; ++a)
        for (int b = 0; b <= a; ++b) sums.tangent(a, b) += density * at.weight * at.N[a] * at.N[b];
    }
    for (int a = 0; a < nodes; ++a)
      for (int b = 0; b < a; ++b) sums.tangent(b, a) = sums.tangent(a, b);
  }
};

/// A mass for each node. Linear cells take the sums of the rows of M, m_a = integral of rho0 N_a dV0. Those of quadratic cells can be negative; they
/// take its diagonal, scaled to the mass m of the element (Hinton, Rock and Zienkiewicz 1976): m_a = M_aa m / sum_b M_bb. An integrand, see
/// ElementLoop.
template <class OfCells>
struct LumpedInertia {
  using Geometry = OfCells;
  static constexpr int nodes = Geometry::nodes, components = 1, point_count = Geometry::mass_points;
  using Reads = std::tuple<>;
  using Residual = std::array<double, nodes>;

  double density;  ///< rho0

  template <class Points, class Sums>
  void add(const Points& points, Sums& sums) const {
    constexpr bool linear = nodes == Geometry::Cell::corners;
    double volume = 0.0, diagonal = 0.0;
    for (int q = 0; q < point_count; ++q) {
      const auto at = points[q];
      volume += at.weight;
      for (int a = 0; a < nodes; ++a) sums.residual[a] += at.weight * (linear ? at.N[a] : at.N[a] * at.N[a]);
    }
    for (const double entry : sums.residual) diagonal += entry;
    for (double& entry : sums.residual) entry *= density * (linear ? 1.0 : volume / diagonal);
  }
};

}  // namespace mortise
