#include "mortise/simulation/scene/heat.hpp"

namespace mortise {
namespace {

const std::vector<std::string> of_position{"x", "y", "z"};

}  // namespace

void InitialTemperatureOptions::describe(Parameters& parameters) {
  parameters.add("body", body, Says("body that has it").required());
  parameters.add("temperature", temperature, Says("of the reference position").unit("temperature").arguments(of_position).required());
}

void ThermalLoadChoice::describe(Parameters& parameters) { parameters.choose(load, thermal_load_registry(), "the kind of load"); }

void HeatOptions::describe(Parameters& parameters) {
  parameters.add("analysis", analysis, {{"none", Analysis::none}, {"steady", Analysis::steady}, {"transient", Analysis::transient}},
                 "none: the scene has no temperature. steady: bodies store no heat, and t is a pseudo-time. transient: bodies store heat, and t is a "
                 "time. Bodies have a temperature whose materials have a list \"heat\" with a conductivity");
  parameters.add("integration", integration, {{"backward euler", Integration::at_end}, {"trapezoidal", Integration::trapezoidal}},
                 "of a transient analysis. backward euler: of first order, damps all; trapezoidal: of second order, lets sudden changes ring");
  parameters.add("error tolerance", error_tolerance,
                 Says("bound on the local error of the temperature in a step, over the range of temperatures; steps get as long as it allows, up to "
                      "\"maximum step\"; default: it does not act on steps")
                     .unit("-")
                     .above(0.0));
  if (error_tolerance && !is_transient()) parameters.error("error tolerance", "steps of time have an error in a \"transient\" analysis alone");
  parameters.add("initial temperature", initial_temperature,
                 Says("temperature of all bodies at the start, of the reference position").unit("temperature").arguments(of_position));
  parameters.named("initial temperatures", initial_temperatures, "temperatures of single bodies at the start, by names of your choice");
  parameters.named("temperatures", temperatures, "prescribed temperatures, by names of your choice");
  parameters.named("loads", loads, "heat through surfaces of bodies, by names of your choice");
  if (acts() && !initial_temperature)
    parameters.error("initial temperature", "a temperature at the start is needed; please give \"initial temperature\", in the unit of all others");
  if (!acts() && (initial_temperature || !initial_temperatures.empty() || !temperatures.empty() || !loads.empty()))
    parameters.error("analysis", "the list \"heat\" has entries, but \"analysis\" is \"none\"; please take \"steady\" or \"transient\"");
}

ContactHeatOptions::Conductance::Conductance() : law{"none", std::make_shared<NoConductance>(), {}} {}
void ContactHeatOptions::Conductance::describe(Parameters& parameters) { parameters.choose(law, conductance_registry(), "the law"); }
ContactHeatOptions::Gap::Gap() : law{"none", std::make_shared<NoGapConductance>(), {}} {}
void ContactHeatOptions::Gap::describe(Parameters& parameters) { parameters.choose(law, gap_conductance_registry(), "the law"); }

void ContactHeatOptions::describe(Parameters& parameters) {
  parameters.list("conductance", conductance, "heat per area, time and jump of temperature where surfaces touch");
  parameters.list("gap conductance", gap, "likewise where they do not touch, up to the search reach");
  parameters.add("friction heats", friction_heats,
                 "true: the work of friction becomes heat of the surfaces; counts with friction in a transient analysis");
  parameters.add("slave share", slave_share,
                 Says("of the heat of friction; left out: that of two half spaces, of the materials' sqrt(conductivity density specific heat)")
                     .unit("-")
                     .at_least(0.0)
                     .at_most(1.0));
}

}  // namespace mortise
