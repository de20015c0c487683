#pragma once
// What thermal expansion makes of an elastic law, and the energy that its heat follows from.

#include "heat_weights.hpp"
#include "property_rates.hpp"

namespace mortise {

/// F_e = exp(p) F; small strain: F + p I.
template <bool small_strain>
Matrix3 elastic_deformation(const Matrix3& F, double p) {
  return small_strain ? Matrix3(F + p * Matrix3::Identity()) : Matrix3(std::exp(p) * F);
}

/// The inverse.
template <bool small_strain>
Matrix3 total_deformation(const Matrix3& F_e, double p) {
  return elastic_deformation<small_strain>(F_e, -p);
}

/// d tau / dp: dF_e = dp F_e, so that d tau / dp = A : I + tau; small strain: A : I.
template <bool small_strain>
Matrix3 stress_by_expansion_exponent(const StressAndTangent<SolidComponents>& response) {
  Matrix3 result = small_strain ? Matrix3(Matrix3::Zero()) : response.stress;
  for (int p = 0; p < 9; ++p) result(p / 3, p % 3) += response.tangent(p, 0) + response.tangent(p, 4) + response.tangent(p, 8);
  return result;
}

/// d tr tau for dF = L F, as the tensor that multiplies L: I : A + tau; small strain: I : A.
template <bool small_strain>
Matrix3 trace_by_gradient(const StressAndTangent<SolidComponents>& response) {
  Matrix3 result = small_strain ? Matrix3(Matrix3::Zero()) : response.stress;
  for (int q = 0; q < 9; ++q) result(q / 3, q % 3) += response.tangent(0, q) + response.tangent(4, q) + response.tangent(8, q);
  return result;
}

/// m = d psi / d theta at fixed F, psi = W(exp(p) F; constants of theta), with both temperatures moving: m = p' tr tau + W_theta. It is minus the
/// elastic entropy.
struct EnergySlope {
  double value = 0.0;
  Matrix3 by_gradient = Matrix3::Zero();  ///< dm = by_gradient : L
  double by_expansion = 0.0;              ///< dm / d theta_e
  double by_temperature = 0.0;            ///< dm / d theta
};

template <bool small_strain>
EnergySlope energy_slope(const ConstantsAtTemperature& at, const StressAndTangent<SolidComponents>& response, const PropertyRates& rates) {
  const TemperatureJet& p = at.expansion;
  EnergySlope m;
  m.value = p.slope * response.stress.trace() + rates.energy;
  m.by_gradient = p.slope * trace_by_gradient<small_strain>(response) + rates.stress;
  m.by_expansion = p.curvature * response.stress.trace() +
                   p.slope * (p.slope * stress_by_expansion_exponent<small_strain>(response).trace() + rates.stress.trace());
  m.by_temperature = p.slope * rates.stress.trace() + rates.energy_curvature;
  return m;
}

/// Principal stretches of F, or 1 and the principal strains; in no order. They are what an isotropic energy remembers of a deformation.
template <bool small_strain>
Eigen::Vector3d principal_stretches(const Matrix3& F) {
  const Matrix3 b = small_strain ? Matrix3(0.5 * (F + F.transpose())) : Matrix3(F * F.transpose());
  const Eigen::Vector3d values = spectral_decomposition(b).values;
  return small_strain ? values : Eigen::Vector3d(values.cwiseSqrt());
}

/// Adds (1 - s) theta (m - m_n) / Delta t and its derivatives. `start` is m_n, m of the start's stretches at the temperatures of the end.
/// @param weight  1 - s
inline void add_thermoelastic_heat(const ThermalPoint& point, double weight, const EnergySlope& end, const EnergySlope& start,
                                   ThermalResponse& response) {
  const double rate = weight / point.time_step, factor = point.temperature * rate;
  response.heat += factor * (end.value - start.value);
  response.heat_by_gradient += factor * end.by_gradient;
  response.heat_by_expansion += factor * (end.by_expansion - start.by_expansion);
  response.heat_by_temperature += factor * (end.by_temperature - start.by_temperature) + rate * (end.value - start.value);
}

/// s theta_n / Delta t, the factor of m(E, theta_n) - m(E_n, theta_n) in the heat.
inline double factor_of_start(const ThermalPoint& at_start, const HeatWeights& weights) {
  return weights.at_start() * at_start.temperature / at_start.time_step;
}

}  // namespace mortise
