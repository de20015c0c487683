#include "mortise/thermal_contact/gap_conductance.hpp"

#include <fmt/format.h>

#include <cmath>

#include "mortise/core/piecewise_linear.hpp"
#include "straight_lines.hpp"

namespace mortise {

void MediumConductance::describe(Parameters& parameters) {
  parameters.add("conductivity", conductivity, Says("of the medium in the gap").unit("power / (length temperature)").at_least(0.0).required());
  parameters.add(
      "distance", distance,
      Says("distance that is left between surfaces that touch, as roughness and the jump distance of a gas").unit("length").above(0.0).required());
}

ConductanceOfGap MediumConductance::at(double gap) const {
  const double value = conductivity / (gap + distance);
  return {value, -value / (gap + distance)};
}

std::optional<std::string> MediumConductance::fault() const {
  if (conductivity >= 0.0 && distance > 0.0 && std::isfinite(conductivity / distance)) return std::nullopt;
  return fmt::format("the conductivity of a gap is {:g} and its distance {:g}; give a conductivity that is not negative and a distance above 0",
                     conductivity, distance);
}

void TabulatedGapConductance::describe(Parameters& parameters) {
  parameters.add("gaps", gaps, Says("of the points, ascending; beyond them the conductance is constant").unit("length").required());
  parameters.add("conductances", conductances, Says("at the points").unit("power / (area temperature)").required());
  if (const auto wrong = fault()) parameters.error("conductances", *wrong);
}

ConductanceOfGap TabulatedGapConductance::at(double gap) const {
  const auto [value, slope] = piecewise_linear(gaps, conductances, gap);
  return {value, slope};
}

std::optional<std::string> TabulatedGapConductance::fault() const {
  return detail::fault_of_straight_lines(gaps, conductances, "gaps", "conductances");
}

const Registry<GapConductance>& gap_conductance_registry() {
  static const Registry<GapConductance> registry = [] {
    Registry<GapConductance> laws;
    laws.add<NoGapConductance>("none", "nothing flows");
    laws.add<MediumConductance>("medium", "a medium at rest: its conductivity over the distance");
    laws.add<TabulatedGapConductance>("table", "straight lines between given gaps");
    return laws;
  }();
  return registry;
}

}  // namespace mortise
