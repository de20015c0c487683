#include "mortise/thermal/thermal_properties.hpp"

#include <fmt/format.h>

#include <cmath>

namespace mortise {
namespace {

/// Error in the constant or in the table of a property; expressions are looked at where they are evaluated.
template <class Allowed>
std::optional<std::string> fault_of(const TemperatureFunction& function, const char* name, const Allowed& allowed, const char* range) {
  if (const auto wrong = function.fault()) return fmt::format("{}: {}", name, *wrong);
  std::vector<double> values = function.table.values;
  if (function.expression && function.expression->is_constant()) values.push_back(function.expression->at({}));
  for (const double value : values)
    if (!allowed(value) || !std::isfinite(value)) return fmt::format("the {} is {:g}; allowed: {} and finite", name, value, range);
  return std::nullopt;
}

}  // namespace

const std::vector<std::pair<std::string, ConductivityActsIn>>& conductivity_names() {
  static const std::vector<std::pair<std::string, ConductivityActsIn>> names{{"current", ConductivityActsIn::current},
                                                                             {"reference", ConductivityActsIn::reference},
                                                                             {"without volume ratio", ConductivityActsIn::without_volume_ratio}};
  return names;
}

void ThermalProperties::describe(Parameters& parameters) {
  conductivity.describe(parameters, "conductivity",
                        Says("k >= 0, heat per area and time over the gradient of the temperature, an expression of `temperature`; left out, without "
                             "\"conductivity table\": bodies of the material have no temperature")
                            .unit("power / (length temperature)"));
  specific_heat.describe(parameters, "specific heat",
                         Says("c > 0, per mass, an expression of `temperature`; left out, without \"specific heat table\": the body stores no heat")
                             .unit("energy / (mass temperature)"));
  parameters.add(
      "conductivity acts in", acts_in, conductivity_names(),
      "with displacements, the configuration in which k gives the flux: \"current\", of large strains; \"reference\", of small ones; \"without "
      "volume ratio\", Q = -k C^-1 Grad theta, as some programs have it");
  parameters.add("lumped capacity", lumped_capacity,
                 "heat is stored at the nodes of linear cells: temperatures do not overshoot in steps that are short for the mesh");
  parameters.add("source", source,
                 Says("heat per reference volume and time, an expression of t, x, y, z and `temperature`; left out: none")
                     .unit("power / volume")
                     .arguments({"t", "x", "y", "z", "temperature"}));
  if (conductivity.fault() || specific_heat.fault()) return;                                         // of tables, which they have said
  if (!conductivity.is_given() && !specific_heat.is_given() && !source && !lumped_capacity) return;  // nothing is said of heat
  if (const auto wrong = fault()) parameters.error(wrong->rfind("the specific heat", 0) == 0 ? "specific heat" : "conductivity", *wrong);
}

std::optional<std::string> ThermalProperties::fault() const {
  if (const auto wrong = fault_of(
          conductivity, "conductivity", [](double k) { return k >= 0.0; }, ">= 0"))
    return wrong;
  if (const auto wrong = fault_of(
          specific_heat, "specific heat", [](double c) { return c > 0.0; }, "> 0"))
    return wrong;
  if (!conductivity.is_given()) return "there is no conductivity; give \"conductivity\" or \"conductivity table\"";
  if (lumped_capacity && !specific_heat.is_given())
    return "a lumped capacity needs a specific heat; give \"specific heat\" or \"specific heat table\"";
  return std::nullopt;
}

}  // namespace mortise
