#pragma once
// Conduction of heat in one element: residual, tangent and flux.

#include <array>
#include <cmath>
#include <tuple>

#include "elements/heat_trouble.hpp"
#include "mortise/solid/deformation.hpp"
#include "mortise/solid/element_loop.hpp"

namespace mortise {

/// theta and Grad theta at a point.
template <int dimension>
struct TemperatureAndGradient {
  static constexpr int components = 1;
  double value = 0.0;
  std::array<double, dimension> gradient{};

  template <class Point, class NodalValues>
  TemperatureAndGradient(const Point& at, const NodalValues& theta) {
    for (std::size_t a = 0; a < theta.size(); ++a) {
      value += at.N[a] * theta[a][0];
      for (int i = 0; i < dimension; ++i) gradient[i] += theta[a][0] * at.gradient[a][i];
    }
  }
};

/// k and, for a tangent, dk/dtheta.
template <class Sums>
ValueAndSlope property_at(const TemperatureFunction& function, double theta) {
  if constexpr (Sums::with_tangent)
    return function.with_slope(theta);
  else
    return {function.at(theta), 0.0};
}

inline bool is_conductivity(double k) { return k >= 0.0 && std::isfinite(k); }

/// At a point with the weight w, g_a = grad N_a, g = grad theta of the same configuration:
///   r_a = w k g_a . g,     dr_a/dtheta_b = w (k g_a . g_b + k' N_b g_a . g).
template <class Geometry, class Sums>
void add_conduction_point(const typename Geometry::Point& at, const std::array<double, Geometry::dimension>& g, double weight, const ValueAndSlope& k,
                          Sums& sums) {
  for (int a = 0; a < Geometry::nodes; ++a) {
    const auto& of_a = at.gradient[a];
    double along = 0.0;
    for (int i = 0; i < Geometry::dimension; ++i) along += of_a[i] * g[i];
    if constexpr (Sums::with_residual) sums.residual[a] += weight * k.value * along;
    if constexpr (Sums::with_tangent)
      for (int b = 0; b < Geometry::nodes; ++b) {
        double product = 0.0;
        for (int i = 0; i < Geometry::dimension; ++i) product += of_a[i] * at.gradient[b][i];
        sums.tangent(a, b) += weight * (k.value * product + k.slope * at.N[b] * along);
      }
  }
}

/// r_a = integral of k Grad N_a . Grad theta dV0. An integrand, see ElementLoop.
template <class OfCells>
struct ReferenceConduction {
  using Geometry = OfCells;
  static constexpr int nodes = Geometry::nodes, dimension = Geometry::dimension, components = 1, point_count = Geometry::stiffness_points;
  using Reads = std::tuple<TemperatureAndGradient<dimension>>;
  using Residual = std::array<double, nodes>;
  using Tangent = NodalPairs<nodes>;

  const TemperatureFunction& conductivity;

  template <class Points, class Sums>
  HeatTrouble add(const Points& points, Sums& sums) const {
    for (int q = 0; q < point_count; ++q) {
      const auto at = points[q];
      const auto& theta = std::get<0>(at.fields);
      const ValueAndSlope k = property_at<Sums>(conductivity, theta.value);
      if (!is_conductivity(k.value)) return {HeatTrouble::Kind::conductivity, k.value, theta.value, position_of(points, at)};
      add_conduction_point<Geometry>(at, theta.gradient, at.weight, k, sums);
    }
    return {};
  }
};

/// r_a = integral of k J^n Grad N_a . C^-1 Grad theta dV0, n = 1, or 0 without the volume ratio. With gradients of the current configuration, g_a =
/// F^-T Grad N_a, g = F^-T Grad theta, the integrand is k J^n g_a . g. A displacement of node b has grad du = du x g_b, so
///   dJ/du_b = J (g_b + N_b/r e_r),    d(g_a . g)/du_b = -g_a (g_b . g) - (g_a . g_b) g;
/// N_b/r is there if axisymmetric. An integrand, see ElementLoop.
template <class OfCells>
struct CurrentConduction {
  using Geometry = OfCells;
  static constexpr int nodes = Geometry::nodes, dimension = Geometry::dimension, components = 1, point_count = Geometry::stiffness_points;
  using Motion = Deformation<Geometry>;
  using Reads = std::tuple<TemperatureAndGradient<dimension>, Motion>;
  using Residual = std::array<double, nodes>;
  using Tangent = NodalPairs<nodes>;
  using Coupling = FieldCoupling<nodes, 1, dimension>;

  const TemperatureFunction& conductivity;
  bool with_volume_ratio;

  template <class Points, class Sums>
  HeatTrouble add(const Points& points, Sums& sums) const {
    const auto& nodal = std::get<0>(points.values());
    for (int q = 0; q < point_count; ++q) {
      auto at = points[q];
      const auto& theta = std::get<0>(at.fields);
      const Motion& motion = std::get<1>(at.fields);
      if (!(motion.determinant > 0.0)) return {HeatTrouble::Kind::inverted, motion.determinant, theta.value, position_of(points, at)};
      const ValueAndSlope k = property_at<Sums>(conductivity, theta.value);
      if (!is_conductivity(k.value)) return {HeatTrouble::Kind::conductivity, k.value, theta.value, position_of(points, at)};
      motion.push_forward(at);
      std::array<double, dimension> g{};
      for (int a = 0; a < nodes; ++a)
        for (int i = 0; i < dimension; ++i) g[i] += nodal[a][0] * at.gradient[a][i];
      const double weight = with_volume_ratio ? at.weight * motion.determinant : at.weight;
      add_conduction_point<Geometry>(at, g, weight, k, sums);
      if constexpr (Sums::with_tangent) add_coupling(at, g, weight * k.value, sums.coupling);
    }
    return {};
  }

 private:
  void add_coupling(const typename Geometry::Point& at, const std::array<double, dimension>& g, double factor, Coupling& coupling) const {
    std::array<double, nodes> along{};  // g_a . g
    for (int a = 0; a < nodes; ++a)
      for (int i = 0; i < dimension; ++i) along[a] += at.gradient[a][i] * g[i];
    for (int b = 0; b < nodes; ++b) {
      const auto& of_b = at.gradient[b];
      std::array<double, dimension> of_volume{};
      if (with_volume_ratio) {
        of_volume = of_b;
        if constexpr (Geometry::axisymmetric) of_volume[0] += at.hoop[b];
      }
      for (int a = 0; a < nodes; ++a) {
        double product = 0.0;
        for (int i = 0; i < dimension; ++i) product += at.gradient[a][i] * of_b[i];
        for (int i = 0; i < dimension; ++i)
          coupling(a, 0, b, i) += factor * (along[a] * of_volume[i] - at.gradient[a][i] * along[b] - product * g[i]);
      }
    }
  }
};

/// q = F Q / J at a point: -k J^(n-1) F C^-1 Grad theta with n as in CurrentConduction, or -k F Grad theta / J.
template <class Geometry>
std::array<double, 3> current_flux(const Deformation<Geometry>& motion, const std::array<double, Geometry::dimension>& gradient, double k,
                                   ConductivityActsIn acts_in) {
  constexpr int dimension = Geometry::dimension;
  using Square = Eigen::Matrix<double, dimension, dimension>;
  using Components = Eigen::Matrix<double, dimension, 1>;
  const Square F = motion.F.template topLeftCorner<dimension, dimension>();
  const Components G = Eigen::Map<const Components>(gradient.data());
  const Components g = acts_in == ConductivityActsIn::reference ? Components(F * G) : Components(F.transpose().inverse() * G);
  const double factor = acts_in == ConductivityActsIn::current ? -k : -k / motion.determinant;
  std::array<double, 3> flux{};
  for (int i = 0; i < dimension; ++i) flux[i] = factor * g[i];
  return flux;
}

}  // namespace mortise
