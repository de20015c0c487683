#pragma once
// How stress and energy of elastic laws change with constants that depend on the temperature, at a fixed elastic deformation.

#include <cmath>

#include "mortise/material/materials.hpp"
#include "thermal_constants.hpp"

namespace mortise {

/// At fixed F_e.
struct PropertyRates {
  Matrix3 stress = Matrix3::Zero();  ///< d tau / d theta
  double energy = 0.0;               ///< d W / d theta
  double energy_curvature = 0.0;     ///< d2 W / d theta2
};

/// The law with other constants, which may be rates of constants: they need not be those of a solid.
inline Hencky with_moduli(Hencky law, double shear_modulus, double bulk_modulus) {
  law.shear_modulus = shear_modulus;
  law.bulk_modulus = bulk_modulus;
  return law;
}
template <class Kind>
Kind with_moduli(Kind law, double shear_modulus, double bulk_modulus) {
  law.mu = shear_modulus;
  law.lambda = bulk_modulus - 2.0 / 3.0 * shear_modulus;
  return law;
}

/// Of laws that are linear in G and K: those with the constants G', K' and G'', K''.
template <class Kind>
PropertyRates property_rates(const Kind& law, const ConstantsAtTemperature& at, const Matrix3& F) {
  const TemperatureJet &G = at.shear_modulus, &K = at.bulk_modulus;
  const Kind first = with_moduli(law, G.slope, K.slope), second = with_moduli(law, G.curvature, K.curvature);
  return {first.stress(F), first.energy(F), second.energy(F)};
}

/// phi = (e^x - 1) / x with its first two derivatives, by the series sum_k x^k / (k + 1)! where the closed form would lose digits.
inline TemperatureJet exponential_slope(double x) {
  if (std::abs(x) >= 1.0) {
    const double e = std::exp(x), value = std::expm1(x) / x, slope = (e - value) / x;
    return {value, slope, (e - 2.0 * slope) / x};
  }
  TemperatureJet phi{1.0, 0.0, 0.0};
  double coefficient = 1.0, power[3] = {0.0, 0.0, 1.0};  // 1 / (k + 1)!; x^(k - 2), x^(k - 1), x^k, 0 below x^0
  for (int k = 1; k <= 18; ++k) {
    coefficient /= k + 1.0;
    power[0] = power[1];
    power[1] = power[2];
    power[2] *= x;
    phi.value += coefficient * power[2];
    phi.slope += coefficient * k * power[1];
    phi.curvature += coefficient * k * (k - 1.0) * power[0];
  }
  return phi;
}

/// The neo-Hookean law is not linear in its constants c = G / 2 and beta = nu / (1 - 2 nu). With L = ln J, P = J^(-2 beta) and
/// g = (P - 1) / beta = -2 L phi(-2 beta L):
///   d tau / d theta = 2 c' (b - P I) + 4 c L beta' P I,   W = c (I1 - 3 + g),   dg/d beta = 4 L^2 phi',   d2g/d beta2 = -8 L^3 phi''.
inline PropertyRates property_rates(const NeoHooke&, const ConstantsAtTemperature& at, const Matrix3& F) {
  const TemperatureJet c = 0.5 * at.shear_modulus, beta = at.poissons_ratio / (-2.0 * at.poissons_ratio + 1.0);
  const double L = std::log(F.determinant()), P = std::exp(-2.0 * beta.value * L);
  const TemperatureJet phi = exponential_slope(-2.0 * beta.value * L);
  const double g_beta = 4.0 * L * L * phi.slope, g_beta_beta = -8.0 * L * L * L * phi.curvature;
  const double strain = F.squaredNorm() - 3.0 - 2.0 * L * phi.value;
  PropertyRates rates;
  rates.stress = 2.0 * c.slope * (F * F.transpose() - P * Matrix3::Identity()) + 4.0 * c.value * L * beta.slope * P * Matrix3::Identity();
  rates.energy = c.slope * strain + c.value * g_beta * beta.slope;
  rates.energy_curvature =
      c.curvature * strain + 2.0 * c.slope * g_beta * beta.slope + c.value * (g_beta_beta * beta.slope * beta.slope + g_beta * beta.curvature);
  return rates;
}

}  // namespace mortise
