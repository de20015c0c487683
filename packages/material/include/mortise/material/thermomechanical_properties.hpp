#pragma once
// What a material has beside its law where it knows the temperature theta.

#include <optional>

#include "mortise/core/temperature_function.hpp"

namespace mortise {

/// Properties that depend on the temperature are functions of it alone. Those that are absent stay as the material has them.
struct ThermomechanicalProperties {
  std::optional<double> reference_temperature;  ///< theta_0, without thermal strain; needed by all that is given
  /// alpha(theta), the secant coefficient [1 / temperature]: the thermal strain is alpha(theta) (theta - theta_0)
  TemperatureFunction expansion;
  TemperatureFunction youngs_modulus;        ///< E(theta) [stress] > 0
  TemperatureFunction poissons_ratio;        ///< nu(theta) in (-1, 1/2)
  TemperatureFunction yield_stress_factor;   ///< s(theta) > 0 with s(theta_0) = 1: the yield stress is sigma_y(alpha) s(theta); plasticity only
  std::optional<double> plastic_heat_share;  ///< chi, coefficient of Taylor and Quinney: share of plastic power that is heat; plasticity only
  bool thermoelastic_heating = false;        ///< whether elastic strain heats and cools

  /// chi where `plastic_heat_share` is absent.
  static constexpr double usual_plastic_heat_share = 0.9;

  /// Whether there is anything for which the law has to know the temperature.
  bool given() const {
    return expansion.is_given() || youngs_modulus.is_given() || poissons_ratio.is_given() || yield_stress_factor.is_given() || plastic_heat_share ||
           thermoelastic_heating;
  }
};

}  // namespace mortise
