#pragma once
// The second stage of a model: its bodies, loads and supports.

#include <memory>
#include <vector>

#include "model/stages/collector.hpp"
#include "model/stages/meshed_scene.hpp"
#include "mortise/nonlinear/semi_smooth_system.hpp"
#include "mortise/simulation/model/heat_of_model.hpp"
#include "mortise/simulation/model/inertia_of_model.hpp"
#include "mortise/simulation/model/supports.hpp"
#include "mortise/solid/bodies.hpp"

namespace mortise {

class LoadContribution;

/// Objects of the scene but those of contact.
struct SolidModel {
  std::shared_ptr<Bodies> bodies;
  std::shared_ptr<const PrescribedMotion> motion;
  Supports supports;
  std::vector<std::shared_ptr<LoadContribution>> loads;  ///< of parts.contributions
  ConnectorsOfModel connectors;
  InertiaOfModel inertia;
  HeatOfModel heat;
  SystemParts parts;  ///< without contact
};

/// Without supports. Where `collect` finds something wrong it is not whole. Collective.
SolidModel make_solid(const MeshedScene& meshed, const Scene& scene, const Timers& timers, Collector& collect);

/// Adds what follows from prescribed motions, once nothing was found wrong with them: constraints, and inertia. Collective.
/// @throws InputError as add_inertia()
void add_supports(const MeshedScene& meshed, const Scene& scene, const Timers& timers, SolidModel& solid);

/// `mark` in the components of owned nodes that are `dofs`, 0 elsewhere.
RCP<MultiVector> marked_components(const FieldSpace& space, const std::vector<LocalOrdinal>& dofs, double mark);

}  // namespace mortise
