#pragma once
// Guards that assume statics: forces on bodies are in balance, and motions that nothing holds cost nothing.

#include <functional>
#include <string>

#include "mortise/simulation/model/model.hpp"
#include "run/stepping/step_guard.hpp"

namespace mortise {

/// Settings that the guards of a static analysis are made of.
struct StaticGuardSettings {
  const Model& model;
  const Scene& scene;
  const Timers& timers;
  std::function<void(const std::string&)> say, warn;  ///< get their lines, on every rank
};

/// The guards that a model has a use for. An analysis with inertia has none of them. Collective.
/// @param parts  of the system to be made, which get what holds bodies that contact alone holds: better_start and held_motions
StepGuards static_guards(const StaticGuardSettings& settings, SystemParts& parts);

}  // namespace mortise
