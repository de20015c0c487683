#include "mortise/material/materials.hpp"

#include <fmt/format.h>

#include <cmath>

namespace mortise {
namespace {

template <class Kind>
struct OptionsOf {
  using type = ElasticMaterialOptions<Kind>;
};
template <>
struct OptionsOf<FiniteJ2> {
  using type = FiniteJ2Options;
};

/// One entry for each alternative of Law.
template <class... Laws>
Registry<MaterialOptions> make_material_registry(const std::variant<Laws...>*) {
  Registry<MaterialOptions> registry;
  (registry.add<typename OptionsOf<Laws>::type>(Laws::name, Laws::sentence), ...);
  return registry;
}

/// The list "thermomechanics" of a material.
struct ThermalList {
  MaterialOptions& material;
  void describe(Parameters& parameters) { material.describe_thermomechanics(parameters); }
};

/// A function of the temperature has to agree at the reference temperature with the number that it stands for.
void check_at_reference(Parameters& parameters, const ThermomechanicalProperties& thermal, const TemperatureFunction& function,
                        const std::string& name, double expected) {
  if (!function.is_given() || function.fault() || !thermal.reference_temperature) return;
  constexpr double round_off_of_input = 1e-6;  // numbers are written with a few digits
  const double value = function.at(*thermal.reference_temperature);
  if (!(std::abs(value - expected) <= round_off_of_input * std::abs(expected)))
    parameters.error(name, fmt::format("\"{}\" is {:.9g} at the reference temperature {:g}; it has to be {:.9g} there", name, value,
                                       *thermal.reference_temperature, expected));
}

}  // namespace

void MaterialOptions::describe(Parameters& parameters) {
  parameters.add("young's modulus", youngs_modulus, Says("Young's modulus at zero strain").unit("stress").above(0.0).required());
  parameters.add("poisson's ratio", poissons_ratio, Says("Poisson's ratio at zero strain").unit("-").above(-1.0).below(0.5).required());
  parameters.add("density", density, Says("mass per reference volume").unit("mass / volume").at_least(0.0));
  ThermalList list{*this};
  parameters.list("thermomechanics", list,
                  "thermal expansion, properties that depend on the temperature, heat of deformation; for models with a temperature");
}

void MaterialOptions::describe_thermomechanics(Parameters& parameters) {
  parameters.add("reference temperature", thermal.reference_temperature,
                 Says("without thermal strain; left out: nothing else of this list is given").unit("temperature"));
  thermal.expansion.describe(
      parameters, "expansion coefficient",
      Says("secant coefficient a(temperature): the thermal strain is a (temperature - reference temperature), measured from the "
           "reference temperature")
          .unit("1 / temperature"));
  thermal.youngs_modulus.describe(parameters, "young's modulus",
                                  Says("an expression of `temperature` in the place of the material's constant").unit("stress"));
  thermal.poissons_ratio.describe(parameters, "poisson's ratio",
                                  Says("an expression of `temperature` in the place of the material's constant").unit("-"));
  parameters.add("thermoelastic heating", thermal.thermoelastic_heating,
                 Says("whether elastic strain heats and cools; temperatures are then absolute"));
  check_at_reference(parameters, thermal, thermal.youngs_modulus, "young's modulus", youngs_modulus);
  check_at_reference(parameters, thermal, thermal.poissons_ratio, "poisson's ratio", poissons_ratio);
  if (thermal.given() && !thermal.reference_temperature)
    parameters.error("reference temperature", "\"reference temperature\" is missing; please add it: the temperature without thermal strain");
}

namespace {
/// The list "hardening" of a material.
struct HardeningList {
  Choice<HardeningOptions>& hardening;
  void describe(Parameters& parameters) {
    parameters.choose(hardening, hardening_registry(), "kind of the curve of yield stress over the accumulated plastic strain alpha");
  }
};
}  // namespace

void FiniteJ2Options::describe_thermomechanics(Parameters& parameters) {
  thermal.yield_stress_factor.describe(
      parameters, "yield stress factor",
      Says("an expression of `temperature` by which the yield stress is multiplied; 1 at the reference temperature; left out: 1").unit("-"));
  parameters.add("plastic heat share", thermal.plastic_heat_share,
                 Says("of the plastic power that becomes heat (Taylor and Quinney's coefficient); left out: 0.9 if anything of this list is given")
                     .unit("-")
                     .at_least(0.0)
                     .at_most(1.0));
  MaterialOptions::describe_thermomechanics(parameters);
  check_at_reference(parameters, thermal, thermal.yield_stress_factor, "yield stress factor", 1.0);
}

void FiniteJ2Options::describe(Parameters& parameters) {
  MaterialOptions::describe(parameters);
  HardeningList list{hardening};
  parameters.list("hardening", list, "the yield stress as a function of the accumulated plastic strain alpha");
}

const Registry<MaterialOptions>& material_registry() {
  static const Registry<MaterialOptions> registry = make_material_registry(static_cast<const Law*>(nullptr));
  return registry;
}

}  // namespace mortise
