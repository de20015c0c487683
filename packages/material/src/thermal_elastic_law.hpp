#pragma once
// Elastic laws that know the temperature.

#include <algorithm>

#include "thermal_elasticity.hpp"

namespace mortise {

/// A point remembers its principal stretches if elastic strain heats, and what HeatWeights needs; else nothing.
template <class Kind, bool plane_stress>
class ThermalElasticLaw final : public ThermalLaw {
  static constexpr bool small = Kind::small_strain;

 public:
  ThermalElasticLaw(const MaterialOptions& material, double share_at_start) : constants_(material), weights_(share_at_start) {}

  bool small_strain() const override { return small; }
  const char* name() const override { return Kind::name; }
  bool has_plasticity() const override { return false; }
  bool heats() const override { return constants_.thermoelastic_heating(); }
  int state_size() const override { return heats() ? temperatures + weights_.state_size() : 0; }
  void start(double* state) const override {
    if (!heats()) return;
    std::fill_n(state, temperatures, 1.0);
    weights_.start(state + temperatures);
  }
  void begin(const ThermalPoint& at, double* state) const override {
    if (heats()) weights_.remember(at, state + temperatures);
  }
  std::optional<std::string> fault(const ThermalPoint& at, const double* state) const override {
    std::optional<std::string> result = constants_.fault(at);
    return result || !has_start() ? result : constants_.fault(HeatWeights::with_start(at, state + temperatures));
  }

  ThermalForces forces(const ThermalPoint& at, const double* state) const override {
    const ConstantsAtTemperature constants = constants_.at(at, heats() ? 1 : 0);
    ThermalForces result;
    if (!constants.valid) return result;
    const Kind law(constants.elastic());
    const Matrix3 F = elastic(law, constants, at.F);
    result.stress = law.stress(F);
    result.thickness = thickness(F, constants);
    if (heats()) {
      const Matrix3 start = start_of(constants, state);
      result.heat = weights_.at_end() * at.temperature / at.time_step * (slope_value(law, constants, F) - slope_value(law, constants, start));
    }
    if (has_start()) {
      const ThermalPoint then = HeatWeights::with_start(at, state + temperatures);
      const ConstantsAtTemperature constants_then = constants_.at(then, 1);
      if (!constants_then.valid) return {};
      const Kind law_then(constants_then.elastic());
      result.heat += factor_of_start(then, weights_) * (slope_value(law_then, constants_then, with_expansion_of(constants_then, constants, F)) -
                                                        slope_value(law_then, constants_then, start_of(constants_then, state)));
    }
    return result;
  }

  ThermalResponse respond(const ThermalPoint& at, const double* state) const override {
    const ConstantsAtTemperature constants = constants_.at(at, heats() ? 2 : 1);
    ThermalResponse result;
    if (!constants.valid) return result;
    const Kind law(constants.elastic());
    const Matrix3 F = elastic(law, constants, at.F);
    const auto response = law.template stress_and_tangent<SolidComponents>(F);
    const PropertyRates rates = property_rates(law, constants, F);
    result.stress = response.stress;
    result.thickness = thickness(F, constants);
    result.tangent = response.tangent;
    result.stress_by_expansion = constants.expansion.slope * stress_by_expansion_exponent<small>(response);
    result.stress_by_temperature = rates.stress;
    if (heats()) {
      const Matrix3 start = start_of(constants, state);
      add_thermoelastic_heat(
          at, weights_.at_end(), energy_slope<small>(constants, response, rates),
          energy_slope<small>(constants, law.template stress_and_tangent<SolidComponents>(start), property_rates(law, constants, start)), result);
    }
    if (has_start() && !add_heat_of_start(at, constants, F, state, result)) return {};
    if constexpr (plane_stress) condense_thickness(result);
    return result;
  }

  ThermalOutput output(const ThermalPoint& at, const double* state) const override {
    const ConstantsAtTemperature constants = constants_.at(at, 0);
    const Kind law(constants.elastic());
    const Matrix3 F = elastic(law, constants, at.F);
    ThermalOutput result;
    static_cast<ThermalForces&>(result) = forces(at, state);
    result.F = total_deformation<small>(F, constants.expansion.value);
    result.energy = law.energy(F);
    return result;
  }

  void update(const ThermalPoint& at, double* state) const override {
    if (!heats()) return;
    const ConstantsAtTemperature constants = constants_.at(at, 0);
    const Matrix3 F = total_deformation<small>(elastic(Kind(constants.elastic()), constants, at.F), constants.expansion.value);
    const Eigen::Vector3d stretches = principal_stretches<small>(F);
    std::copy_n(stretches.data(), 3, state);
    weights_.remember(at, state + temperatures);
  }

 private:
  static constexpr int temperatures = 3;  ///< place after the stretches

  bool has_start() const { return heats() && weights_.has_start(); }

  static double thickness([[maybe_unused]] const Matrix3& F_e, [[maybe_unused]] const ConstantsAtTemperature& constants) {
    return plane_stress ? total_deformation<small>(F_e, constants.expansion.value)(2, 2) : 1.0;
  }

  static Matrix3 elastic(const Kind& law, const ConstantsAtTemperature& constants, const Matrix3& F) {
    const Matrix3 F_e = elastic_deformation<small>(F, constants.expansion.value);
    if constexpr (plane_stress)
      return law.with_plane_stress(F_e);
    else
      return F_e;
  }

  /// F_e at the end of the step if there were the thermal strain of its start.
  static Matrix3 with_expansion_of(const ConstantsAtTemperature& start, const ConstantsAtTemperature& end, const Matrix3& F_e) {
    return elastic_deformation<small>(total_deformation<small>(F_e, end.expansion.value), start.expansion.value);
  }

  /// Adds s theta_n (m(F, theta_n) - m(F_n, theta_n)) / Delta t and its derivative by F, which is all that it depends on.
  /// @return false where the constants of the start have no meaning
  bool add_heat_of_start(const ThermalPoint& at, const ConstantsAtTemperature& of_end, const Matrix3& F_e, const double* state,
                         ThermalResponse& response) const {
    const ThermalPoint then = HeatWeights::with_start(at, state + temperatures);
    const ConstantsAtTemperature constants = constants_.at(then, 1);
    if (!constants.valid) return false;
    const Kind law(constants.elastic());
    const Matrix3 F = with_expansion_of(constants, of_end, F_e);
    const EnergySlope end = energy_slope<small>(constants, law.template stress_and_tangent<SolidComponents>(F), property_rates(law, constants, F));
    const double factor = factor_of_start(then, weights_);
    response.heat += factor * (end.value - slope_value(law, constants, start_of(constants, state)));
    response.heat_by_gradient += factor * end.by_gradient;
    return true;
  }

  /// A deformation with the stretches of the step's start at the temperature of `constants`.
  static Matrix3 start_of(const ConstantsAtTemperature& constants, const double* state) {
    return elastic_deformation<small>(Eigen::Map<const Eigen::Vector3d>(state).asDiagonal().toDenseMatrix(), constants.expansion.value);
  }

  static double slope_value(const Kind& law, const ConstantsAtTemperature& constants, const Matrix3& F) {
    return constants.expansion.slope * law.stress(F).trace() + property_rates(law, constants, F).energy;
  }

  /// With d tau_33 = 0, A_33kl L_kl + b_33 d theta = 0 gives L_33, b the derivative of the stress by a temperature; as in PlaneStress.
  static void condense_thickness(ThermalResponse& response) {
    constexpr int thickness = 8;
    Eigen::Matrix<double, 9, 9>& A = response.tangent;
    const Eigen::Matrix<double, 9, 1> column = A.col(thickness);
    const Eigen::Matrix<double, 1, 9> row = A.row(thickness) / A(thickness, thickness);  // -dL_33/dL
    const double by_expansion = response.stress_by_expansion(2, 2) / A(thickness, thickness);
    const double by_temperature = response.stress_by_temperature(2, 2) / A(thickness, thickness), heat = response.heat_by_gradient(2, 2);
    A.noalias() -= column * row;
    for (int p = 0; p < 9; ++p) {
      response.stress_by_expansion(p / 3, p % 3) -= by_expansion * column(p);
      response.stress_by_temperature(p / 3, p % 3) -= by_temperature * column(p);
      response.heat_by_gradient(p / 3, p % 3) -= heat * row(p);
    }
    response.heat_by_expansion -= heat * by_expansion;
    response.heat_by_temperature -= heat * by_temperature;
  }

  ThermalConstants constants_;
  HeatWeights weights_;
};

}  // namespace mortise
