#pragma once
// Thermal properties of a body: conductivity, specific heat, source.

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "mortise/core/parameters.hpp"
#include "mortise/core/temperature_function.hpp"

namespace mortise {

/// How the conductivity k gives the flux Q of heat per reference area, C = F^T F, J = det F. In plane stress J and C are those of the plane: the
/// stretch across it counts as 1.
enum class ConductivityActsIn {
  current,              ///< q = -k grad theta per current area: Q = -k J C^-1 Grad theta
  reference,            ///< Q = -k Grad theta
  without_volume_ratio  ///< Q = -k C^-1 Grad theta, a law of other programs, for comparison
};

/// "current", "reference", "without volume ratio".
const std::vector<std::pair<std::string, ConductivityActsIn>>& conductivity_names();

/// Properties of one body.
struct ThermalProperties {
  TemperatureFunction conductivity;                          ///< k >= 0 [power / (length temperature)]
  TemperatureFunction specific_heat;                         ///< c > 0 per mass [energy / (mass temperature)]; not given: it stores no heat
  ConductivityActsIn acts_in = ConductivityActsIn::current;  ///< without displacements the same as `reference`
  bool lumped_capacity = false;                              ///< heat is stored at nodes, which suits short steps; linear cells only
  std::optional<ScalarFunction> source;  ///< R [power / reference volume] of t, x, y, z (reference position), temperature; no value: none
  void describe(Parameters& parameters);

  /// Error in its numbers; nothing: they make a body.
  std::optional<std::string> fault() const;
};

}  // namespace mortise
