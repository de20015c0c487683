#pragma once
// What an element stores and generates of heat: capacity, lumped capacity, source.

#include <array>
#include <cmath>
#include <tuple>

#include "elements/conduction.hpp"
#include "mortise/core/guarded_value.hpp"

namespace mortise {

/// A field that is read at nodes alone, from ElementPoints::values().
struct AtNodes {
  static constexpr int components = 1;
  template <class Point, class NodalValues>
  AtNodes(const Point&, const NodalValues&) {}
};

inline bool is_specific_heat(double c) { return c > 0.0 && std::isfinite(c); }

/// c, or its mean between theta_n and theta where dtheta/dt = (theta - theta_n) / dt: what is stored over the step is then the exact integral of c.
template <class Sums>
ValueAndSlope specific_heat_over_step(const TemperatureFunction& c, double theta, double rate, double time_step) {
  return time_step > 0.0 && !c.is_constant() ? c.mean(theta - rate * time_step, theta) : property_at<Sums>(c, theta);
}

/// r_a = integral of N_a rho0 c dtheta/dt dV0. Its Jacobian is, with weights beta s_b and omega,
///   integral of N_a rho0 (beta s_b c + omega c' dtheta/dt) N_b dV0.
/// An integrand, see ElementLoop. Fields: temperatures, their rates, the shares s.
template <class OfCells>
struct ConsistentCapacity {
  using Geometry = OfCells;
  static constexpr int nodes = Geometry::nodes, components = 1, point_count = Geometry::mass_points;
  using Reads = std::tuple<FieldValue<1>, FieldValue<1>, AtNodes>;
  using Residual = std::array<double, nodes>;
  using Tangent = NodalPairs<nodes>;

  const TemperatureFunction& specific_heat;
  double density;                   ///< rho0
  double by_velocity, by_unknowns;  ///< beta, omega
  double time_step;                 ///< over which rates are changes; 0: they are rates at a time

  template <class Points, class Sums>
  HeatTrouble add(const Points& points, Sums& sums) const {
    const auto& shares = std::get<2>(points.values());
    for (int q = 0; q < point_count; ++q) {
      const auto at = points[q];
      const double theta = std::get<0>(at.fields).value[0], rate = std::get<1>(at.fields).value[0];
      const ValueAndSlope c = specific_heat_over_step<Sums>(specific_heat, theta, rate, time_step);
      if (!is_specific_heat(c.value)) return {HeatTrouble::Kind::specific_heat, c.value, theta, position_of(points, at)};
      const double weight = density * at.weight;
      for (int a = 0; a < nodes; ++a) {
        if constexpr (Sums::with_residual) sums.residual[a] += weight * at.N[a] * c.value * rate;
        if constexpr (Sums::with_tangent)
          for (int b = 0; b < nodes; ++b)
            sums.tangent(a, b) += weight * at.N[a] * (by_velocity * shares[b][0] * c.value + by_unknowns * c.slope * rate) * at.N[b];
      }
    }
    return {};
  }
};

/// r_a = m_a c(theta_a) dtheta_a/dt, m_a = integral of rho0 N_a dV0. An integrand, see ElementLoop. Fields as ConsistentCapacity.
template <class OfCells>
struct LumpedCapacity {
  using Geometry = OfCells;
  static constexpr int nodes = Geometry::nodes, components = 1, point_count = Geometry::mass_points;
  static_assert(nodes == Geometry::Cell::corners, "sums of rows of quadratic cells can be negative");
  using Reads = std::tuple<AtNodes, AtNodes, AtNodes>;
  using Residual = std::array<double, nodes>;
  using Tangent = NodalPairs<nodes>;

  const TemperatureFunction& specific_heat;
  double density;                   ///< rho0
  double by_velocity, by_unknowns;  ///< beta, omega
  double time_step;                 ///< over which rates are changes; 0: they are rates at a time

  template <class Points, class Sums>
  HeatTrouble add(const Points& points, Sums& sums) const {
    const auto& [temperatures, rates, shares] = points.values();
    std::array<double, nodes> mass{};
    for (int q = 0; q < point_count; ++q) {
      const auto at = points[q];
      for (int a = 0; a < nodes; ++a) mass[a] += density * at.weight * at.N[a];
    }
    for (int a = 0; a < nodes; ++a) {
      const double theta = temperatures[a][0], rate = rates[a][0];
      const ValueAndSlope c = specific_heat_over_step<Sums>(specific_heat, theta, rate, time_step);
      if (!is_specific_heat(c.value)) {
        HeatTrouble trouble{HeatTrouble::Kind::specific_heat, c.value, theta, {}};
        for (int i = 0; i < Geometry::dimension; ++i) trouble.position[i] = points.positions()[a][i];
        return trouble;
      }
      if constexpr (Sums::with_residual) sums.residual[a] += mass[a] * c.value * rate;
      if constexpr (Sums::with_tangent) sums.tangent(a, a) += mass[a] * (by_velocity * shares[a][0] * c.value + by_unknowns * c.slope * rate);
    }
    return {};
  }
};

/// r_a = -integral of N_a R dV0. An integrand, see ElementLoop.
template <class OfCells>
struct VolumeSource {
  using Geometry = OfCells;
  static constexpr int nodes = Geometry::nodes, components = 1, point_count = Geometry::mass_points;
  using Reads = std::tuple<FieldValue<1>>;
  using Residual = std::array<double, nodes>;
  using Tangent = NodalPairs<nodes>;

  const ScalarFunction& source;  ///< R of t, x, y, z, temperature
  double time;

  template <class Points, class Sums>
  HeatTrouble add(const Points& points, Sums& sums) const {
    for (int q = 0; q < point_count; ++q) {
      const auto at = points[q];
      const double theta = std::get<0>(at.fields).value[0];
      const auto X = position_of(points, at);
      const std::vector<double> arguments{time, X[0], X[1], X[2], theta};
      ValueAndSlope R;
      if constexpr (Sums::with_tangent)
        R = value_and_slope(source, arguments, 4);
      else
        R.value = value_or_nan(source, arguments);
      if (!std::isfinite(R.value)) return {HeatTrouble::Kind::source, R.value, theta, X};
      for (int a = 0; a < nodes; ++a) {
        if constexpr (Sums::with_residual) sums.residual[a] -= at.weight * at.N[a] * R.value;
        if constexpr (Sums::with_tangent)
          for (int b = 0; b < nodes; ++b) sums.tangent(a, b) -= at.weight * at.N[a] * R.slope * at.N[b];
      }
    }
    return {};
  }
};

}  // namespace mortise
