#pragma once
// The constants of a material at a temperature.

#include <optional>
#include <string>

#include "mortise/material/elastic_constants.hpp"
#include "mortise/material/thermal_law.hpp"
#include "temperature_jet.hpp"

namespace mortise {

/// Constants at one point.
struct ConstantsAtTemperature {
  TemperatureJet expansion;  ///< p = -alpha(theta) (theta - theta_0) and its derivatives by the temperature of expansion: F_e = exp(p) F
  TemperatureJet youngs_modulus, poissons_ratio;  ///< E, nu
  TemperatureJet shear_modulus, bulk_modulus;     ///< G, K
  TemperatureJet yield_factor;                    ///< s
  bool valid = true;                              ///< false: see ThermalConstants::fault()

  ElasticConstants elastic() const { return {youngs_modulus.value, poissons_ratio.value}; }
};

/// The functions of a material behind them.
class ThermalConstants {
 public:
  /// @throws std::invalid_argument without a reference temperature
  explicit ThermalConstants(const MaterialOptions& material);

  /// With derivatives up to `order`, which is 0, 1 or 2.
  ConstantsAtTemperature at(const ThermalPoint& point, int order) const;

  /// See ThermalLaw::fault().
  std::optional<std::string> fault(const ThermalPoint& point) const;

  bool thermoelastic_heating() const { return properties_.thermoelastic_heating; }

 private:
  ElasticConstants constants_;  ///< where no function is given
  ThermomechanicalProperties properties_;
};

}  // namespace mortise
