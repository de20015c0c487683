#pragma once
// Heat of a scene: the analysis, temperatures at the start and prescribed ones, loads, heat across contact pairs.

#include <optional>
#include <string>
#include <vector>

#include "mortise/core/parameters.hpp"
#include "mortise/thermal/prescribed_temperatures.hpp"
#include "mortise/thermal/thermal_loads.hpp"
#include "mortise/thermal_contact/conductance.hpp"
#include "mortise/thermal_contact/gap_conductance.hpp"

namespace mortise {

/// Temperature of a body at the start.
struct InitialTemperatureOptions {
  Located<std::string> body;
  ScalarFunction temperature;  ///< of x, y, z (reference position)
  void describe(Parameters& parameters);
};

/// A thermal load; its kind stands behind "type".
struct ThermalLoadChoice {
  Choice<ThermalLoadOptions> load;
  void describe(Parameters& parameters);
};

/// Temperatures of a scene's bodies: those whose materials conduct.
struct HeatOptions {
  enum class Analysis {
    none,      ///< the scene has no temperature
    steady,    ///< bodies store no heat
    transient  ///< rates are those of time
  };
  enum class Integration {
    at_end,      ///< first order, damps all
    trapezoidal  ///< second order, damps nothing
  };
  Analysis analysis = Analysis::none;
  Integration integration = Integration::at_end;
  std::optional<double> error_tolerance;              ///< of a step's local error over the range of temperatures; none: steps do not follow it
  std::optional<ScalarFunction> initial_temperature;  ///< of x, y, z (reference position); no value: none was given
  std::vector<Named<InitialTemperatureOptions>> initial_temperatures;
  std::vector<Named<PrescribedTemperatureOptions>> temperatures;
  std::vector<Named<ThermalLoadChoice>> loads;
  Place place;  ///< of the list
  void describe(Parameters& parameters);

  bool acts() const { return analysis != Analysis::none; }
  bool is_transient() const { return analysis == Analysis::transient; }
};

/// Heat across a contact pair.
struct ContactHeatOptions {
  /// Laws of surfaces that touch; "none" has no law.
  struct Conductance {
    Choice<ConductanceLaw> law;
    Conductance();
    void describe(Parameters& parameters);
  };
  /// Laws of surfaces that do not touch; "none" has no law.
  struct Gap {
    Choice<GapConductance> law;
    Gap();
    void describe(Parameters& parameters);
  };
  Conductance conductance;
  Gap gap;
  bool friction_heats = true;         ///< with friction, and a temperature on either side
  std::optional<double> slave_share;  ///< of the heat of friction; none: that of the materials
  void describe(Parameters& parameters);

  bool conducts() const { return conductance.law.type != "none"; }  ///< where surfaces touch
  bool crosses_gaps() const { return gap.law.type != "none"; }      ///< where they do not
};

}  // namespace mortise
