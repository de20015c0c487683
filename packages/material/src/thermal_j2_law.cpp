#include "thermal_j2_law.hpp"

#include <algorithm>

namespace mortise {
namespace {

FiniteJ2::State unpack(const double* state) {
  FiniteJ2::State result;
  std::copy_n(state, 6, result.inverse_plastic_metric.begin());
  result.equivalent_plastic_strain = state[6];
  return result;
}

void pack(const FiniteJ2::State& from, double* state) {
  std::copy_n(from.inverse_plastic_metric.begin(), 6, state);
  state[6] = from.equivalent_plastic_strain;
}

/// EnergySlope of Hencky's law at principal elastic strains, and M = dm/de in their axes:
///   m = 3 p' K T + G' |dev e|^2 + K'/2 T^2,   M = 2 G' dev e + (3 p' K + K' T) 1,   T = tr e with dT/d theta_e = 3 p'.
struct PrincipalEnergySlope {
  EnergySlope m;  ///< by_gradient is left to the caller
  Eigen::Vector3d by_strain;
};
PrincipalEnergySlope energy_slope(const ConstantsAtTemperature& at, const Eigen::Vector3d& strain) {
  const TemperatureJet &p = at.expansion, &G = at.shear_modulus, &K = at.bulk_modulus;
  const double T = strain.sum();
  const Eigen::Vector3d deviator = strain.array() - T / 3.0;
  PrincipalEnergySlope result;
  result.m.value = 3.0 * p.slope * K.value * T + G.slope * deviator.squaredNorm() + 0.5 * K.slope * T * T;
  result.m.by_expansion = 3.0 * p.curvature * K.value * T + 3.0 * p.slope * (3.0 * p.slope * K.value + K.slope * T);
  result.m.by_temperature = 3.0 * p.slope * K.slope * T + G.curvature * deviator.squaredNorm() + 0.5 * K.curvature * T * T;
  result.by_strain = 2.0 * G.slope * deviator + (3.0 * p.slope * K.value + K.slope * T) * Eigen::Vector3d::Ones();
  return result;
}

const double root = std::sqrt(1.5);

}  // namespace

ThermalJ2Law::ThermalJ2Law(const MaterialOptions& material, double share_at_start)
    : constants_(material),
      hardening_(std::get<FiniteJ2>(material.law()).hardening),
      heat_share_(material.thermal.plastic_heat_share.value_or(ThermomechanicalProperties::usual_plastic_heat_share)),
      softens_(material.thermal.yield_stress_factor.is_given()),
      weights_(share_at_start) {}

FiniteJ2 ThermalJ2Law::law_at(const ConstantsAtTemperature& constants) const {
  FiniteJ2 law(constants.elastic(), hardening_);
  law.yield_factor = constants.yield_factor.value;
  return law;
}

Eigen::Vector3d ThermalJ2Law::strain_at_start(const ConstantsAtTemperature& constants, const double* state) const {
  return Eigen::Map<const Eigen::Vector3d>(state + stretches_start()).array().log() + constants.expansion.value;
}

void ThermalJ2Law::start(double* state) const {
  std::fill_n(state, state_size(), 0.0);
  pack({}, state);
  if (constants_.thermoelastic_heating()) std::fill_n(state + stretches_start(), 3, 1.0);
  if (has_start()) weights_.start(state + temperatures_start());
}

void ThermalJ2Law::begin(const ThermalPoint& at, double* state) const {
  if (has_start()) weights_.remember(at, state + temperatures_start());
}

std::optional<std::string> ThermalJ2Law::fault(const ThermalPoint& at, const double* state) const {
  std::optional<std::string> result = constants_.fault(at);
  return result || !has_start() ? result : constants_.fault(with_start(at, state));
}

double ThermalJ2Law::mean_yield_factor(const ConstantsAtTemperature& end, const ThermalPoint& at, const double* state) const {
  if (!has_start()) return end.yield_factor.value;
  return weights_.at_end() * end.yield_factor.value + weights_.at_start() * constants_.at(with_start(at, state), 0).yield_factor.value;
}

ThermalJ2Law::HeatOfStart ThermalJ2Law::heat_of_start(const ThermalPoint& at, const double* state, const Eigen::Vector3d& strain) const {
  const ThermalPoint then = with_start(at, state);
  const ConstantsAtTemperature constants = constants_.at(then, constants_.thermoelastic_heating() ? 1 : 0);
  HeatOfStart result;
  result.valid = constants.valid;
  if (!result.valid) return result;
  result.by_flow = weights_.at_start() * heat_share_ / at.time_step * constants.yield_factor.value * yield_stress(hardening_, state[6]);
  if (!constants_.thermoelastic_heating()) return result;
  const double factor = factor_of_start(then, weights_);
  const PrincipalEnergySlope end = energy_slope(constants, strain.array() + constants.expansion.value);
  result.thermoelastic = factor * (end.m.value - energy_slope(constants, strain_at_start(constants, state)).m.value);
  result.by_strain = factor * end.by_strain;
  return result;
}

ThermalForces ThermalJ2Law::forces(const ThermalPoint& at, const double* state) const {
  const bool thermoelastic = constants_.thermoelastic_heating();
  const ConstantsAtTemperature constants = constants_.at(at, thermoelastic ? 1 : 0);
  ThermalForces result;
  if (!constants.valid) return result;
  const FiniteJ2 law = law_at(constants);
  const FiniteJ2::Return end = law.return_to_yield_surface(elastic_deformation<false>(at.F, constants.expansion.value), unpack(state));
  result.stress = law.kirchhoff(end);
  if (const double x = end.increment.strain; x > 0.0)
    result.heat += weights_.at_end() * heat_share_ / at.time_step * law.yield_factor * yield_stress(hardening_, state[6] + x) * x;
  const Eigen::Vector3d strain = FiniteJ2::elastic_strain(end);
  if (thermoelastic)
    result.heat += weights_.at_end() * at.temperature / at.time_step *
                   (energy_slope(constants, strain).m.value - energy_slope(constants, strain_at_start(constants, state)).m.value);
  if (has_start()) {
    const HeatOfStart start = heat_of_start(at, state, strain.array() - constants.expansion.value);
    if (!start.valid) return {};
    result.heat += start.by_flow * end.increment.strain + start.thermoelastic;
  }
  return result;
}

ThermalResponse ThermalJ2Law::respond(const ThermalPoint& at, const double* state) const {
  const bool thermoelastic = constants_.thermoelastic_heating();
  const ConstantsAtTemperature constants = constants_.at(at, thermoelastic ? 2 : 1);
  ThermalResponse result;
  if (!constants.valid) return result;
  const FiniteJ2 law = law_at(constants);
  const FiniteJ2::Return end = law.return_to_yield_surface(elastic_deformation<false>(at.F, constants.expansion.value), unpack(state));
  const auto response = law.stress_and_tangent<SolidComponents>(end);
  result.stress = response.stress;
  result.tangent = response.tangent;
  result.stress_by_expansion = constants.expansion.slope * stress_by_expansion_exponent<false>(response);

  const TemperatureJet &G = constants.shear_modulus, &K = constants.bulk_modulus;
  const double x = end.increment.strain;
  Eigen::Vector3d n = Eigen::Vector3d::Zero();
  double x_by_n = 0.0, x_by_temperature = 0.0;  // dx = x_by_n (n : L) + x_by_temperature d theta
  if (x > 0.0) {
    n = end.deviator.normalized();
    const double q = std::sqrt(6.0) * G.value * end.deviator.norm(), stiffness = 3.0 * G.value + end.increment.slope;
    const double curve = yield_stress(hardening_, state[6] + x), yield = law.yield_factor * curve;
    x_by_n = 2.0 * G.value * root / stiffness;
    x_by_temperature = (q * G.slope / G.value - 3.0 * G.slope * x - constants.yield_factor.slope * curve) / stiffness;
    const double rate = weights_.at_end() * heat_share_ / at.time_step, by_x = rate * (yield + end.increment.slope * x);
    result.heat += rate * yield * x;
    result.heat_by_gradient += by_x * x_by_n * in_axes_of(end.trial, n);
    result.heat_by_temperature += by_x * x_by_temperature + rate * constants.yield_factor.slope * curve * x;
  }
  // tau = 2 G (dev e - sqrt(3/2) x n) + K tr e I at fixed e.
  const Eigen::Vector3d strain = FiniteJ2::elastic_strain(end);
  result.stress_by_temperature = in_axes_of(end.trial, 2.0 * G.slope * end.scale * end.deviator - 2.0 * G.value * root * x_by_temperature * n +
                                                           K.slope * end.volumetric * Eigen::Vector3d::Ones());
  if (thermoelastic) {
    // The elastic strain moves by d e - sqrt(3/2) (n dx + x dn); M has no part along dn.
    PrincipalEnergySlope slope = energy_slope(constants, strain);
    const double along = root * slope.by_strain.dot(n);
    slope.m.by_gradient = in_axes_of(end.trial, slope.by_strain - along * x_by_n * n);
    slope.m.by_temperature -= along * x_by_temperature;
    add_thermoelastic_heat(at, weights_.at_end(), slope.m, energy_slope(constants, strain_at_start(constants, state)).m, result);
  }
  if (has_start()) {
    // It depends on F and theta by x and the strain of the end alone.
    const HeatOfStart start = heat_of_start(at, state, strain.array() - constants.expansion.value);
    if (!start.valid) return {};
    const double by_x = start.by_flow - root * start.by_strain.dot(n);
    result.heat += start.by_flow * x + start.thermoelastic;
    result.heat_by_gradient += in_axes_of(end.trial, start.by_strain + by_x * x_by_n * n);
    result.heat_by_temperature += by_x * x_by_temperature;
  }
  return result;
}

ThermalOutput ThermalJ2Law::output(const ThermalPoint& at, const double* state) const {
  const ConstantsAtTemperature constants = constants_.at(at, 0);
  const FiniteJ2 law = law_at(constants);
  const FiniteJ2::Return end = law.return_to_yield_surface(elastic_deformation<false>(at.F, constants.expansion.value), unpack(state));
  ThermalOutput result;
  static_cast<ThermalForces&>(result) = forces(at, state);
  result.F = at.F;
  result.energy = law.elastic.energy(FiniteJ2::elastic_strain(end));
  result.equivalent_plastic_strain = state[6] + end.increment.strain;
  const double work = plastic_work(hardening_, result.equivalent_plastic_strain);
  result.plastic_work = softens_ ? state[work_place] + mean_yield_factor(constants, at, state) * (work - plastic_work(hardening_, state[6])) : work;
  return result;
}

void ThermalJ2Law::update(const ThermalPoint& at, double* state) const {
  const ConstantsAtTemperature constants = constants_.at(at, 0);
  const FiniteJ2 law = law_at(constants);
  const FiniteJ2::State start = unpack(state);
  const Matrix3 F = elastic_deformation<false>(at.F, constants.expansion.value);
  const FiniteJ2::State end = law.updated(F, start);
  // The mean factor of the yield stress over the curve: the work of a step at one temperature is exact.
  if (softens_)
    state[work_place] += mean_yield_factor(constants, at, state) *
                         (plastic_work(hardening_, end.equivalent_plastic_strain) - plastic_work(hardening_, start.equivalent_plastic_strain));
  if (constants_.thermoelastic_heating())
    Eigen::Map<Eigen::Array3d>(state + stretches_start()) =
        (FiniteJ2::elastic_strain(law.return_to_yield_surface(F, start)).array() - constants.expansion.value).exp();
  pack(end, state);
  begin(at, state);  // the next step
}

}  // namespace mortise
