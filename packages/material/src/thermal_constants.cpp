#include "thermal_constants.hpp"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

namespace mortise {
namespace {

TemperatureJet jet_or(const TemperatureFunction& function, double otherwise, double temperature, int order) {
  return function.is_given() ? jet_of(function, temperature, order) : TemperatureJet{otherwise, 0.0, 0.0};
}

bool is_modulus(double value) { return value > 0.0 && std::isfinite(value); }
bool is_poissons_ratio(double value) { return value > -1.0 && value < 0.5; }

}  // namespace

ThermalConstants::ThermalConstants(const MaterialOptions& material) : constants_(material.elastic_constants()), properties_(material.thermal) {
  if (!properties_.reference_temperature) throw std::invalid_argument("a material with thermal properties needs a reference temperature");
}

ConstantsAtTemperature ThermalConstants::at(const ThermalPoint& point, int order) const {
  ConstantsAtTemperature result;
  if (properties_.expansion.is_given()) {
    const TemperatureJet difference{point.expansion_temperature - *properties_.reference_temperature, 1.0, 0.0};
    result.expansion = -1.0 * (jet_of(properties_.expansion, point.expansion_temperature, order) * difference);
  }
  const TemperatureJet E = jet_or(properties_.youngs_modulus, constants_.youngs_modulus, point.temperature, order);
  const TemperatureJet nu = jet_or(properties_.poissons_ratio, constants_.poissons_ratio, point.temperature, order);
  result.youngs_modulus = E;
  result.poissons_ratio = nu;
  result.shear_modulus = E / (2.0 * (nu + 1.0));
  result.bulk_modulus = E / (3.0 * (-2.0 * nu + 1.0));
  result.yield_factor = jet_or(properties_.yield_stress_factor, 1.0, point.temperature, order);
  result.valid = is_modulus(E.value) && is_poissons_ratio(nu.value) && std::isfinite(result.expansion.value) &&
                 is_modulus(result.yield_factor.value) && (!properties_.thermoelastic_heating || point.temperature > 0.0);
  return result;
}

std::optional<std::string> ThermalConstants::fault(const ThermalPoint& point) const {
  const ConstantsAtTemperature constants = at(point, 0);
  const auto message = [](const char* property, const TemperatureFunction& function, double value, double temperature, const char* allowed) {
    const double shown = std::isnan(value) ? std::abs(value) : value;  // some operations give a sign to what is not a number
    return fmt::format("the {} {} is {:g} at the temperature {:g}; it has to be {}", property, function.source(), shown, temperature, allowed);
  };
  if (!is_modulus(constants.youngs_modulus.value))
    return message("Young's modulus", properties_.youngs_modulus, constants.youngs_modulus.value, point.temperature, "finite and above 0");
  if (!is_poissons_ratio(constants.poissons_ratio.value))
    return message("Poisson's ratio", properties_.poissons_ratio, constants.poissons_ratio.value, point.temperature, "above -1 and below 0.5");
  if (!is_modulus(constants.yield_factor.value))
    return message("yield stress factor", properties_.yield_stress_factor, constants.yield_factor.value, point.temperature, "finite and above 0");
  if (!std::isfinite(constants.expansion.value))
    return message("expansion coefficient", properties_.expansion, properties_.expansion.at(point.expansion_temperature), point.expansion_temperature,
                   "finite");
  if (!constants.valid)
    return fmt::format("the temperature is {:g}; thermoelastic heating needs absolute temperatures, which are above 0", point.temperature);
  return std::nullopt;
}

}  // namespace mortise
