#pragma once
// The heat of a scene, made into objects.

#include <memory>
#include <vector>

#include "model/heat/booked_heat.hpp"
#include "model/stages/meshed_scene.hpp"
#include "model/support_constraints.hpp"
#include "mortise/nonlinear/semi_smooth_system.hpp"
#include "mortise/simulation/model/heat_of_model.hpp"
#include "mortise/solid/bodies.hpp"

namespace mortise {

/// The fields of a scene: the displacement, and with heat the temperature on the nodes of bodies whose materials conduct. Collective.
/// @throws InputError on all ranks if the scene has an analysis of heat and no body has a temperature
std::shared_ptr<const FieldSpace> space_of_scene(const RCP<const Mesh>& mesh, const Scene& scene);

/// Weight of flows at the start of a step in what is in balance over it.
FlowsAtStart flows_at_start(const Scene& scene);

/// Adds conduction, storage, sources and loads of heat. Without an analysis nothing is made. Collective.
/// @throws InputError on all ranks for sets that do not exist and properties without meaning
HeatOfModel add_heat(const MeshedScene& meshed, const Scene& scene, const Timers& timers, SystemParts& parts);

/// Prescribed temperatures, and those of surfaces that are tied: theta_s = sum_m P_sm theta_m, with P of the displacements where nothing is
/// prescribed. Collective.
FurtherConstraints temperature_constraints(const MeshedScene& meshed, const Scene& scene, const HeatOfModel& heat);

/// Temperatures at the start, put into a vector on the dofs. Collective.
/// @throws InputError on all ranks for bodies that do not exist, and values that are not finite
void put_initial_temperatures(const Scene& scene, const FieldSpace& space, Vector& unknowns);

/// Reference of changes of temperature: the largest one at the start or prescribed at the start or the end, at least 1. Collective.
double size_of_temperatures(const Scene& scene, const MeshedScene& meshed, const HeatOfModel& heat);

/// Temperatures of t, x, y, z that are no unknowns: those of surroundings and of rigid bodies.
std::vector<const ScalarFunction*> temperatures_around(const Scene& scene);

/// mesh.bodies indices of bodies that store no heat and whose temperature nothing determines: no prescribed one, no surroundings, no body that it
/// conducts to. Collective.
/// @param joined  [mesh bodies] number of the group of bodies that conduct to one another
std::vector<int> undetermined_bodies(const Scene& scene, const FieldSpace& space, const HeatOfModel& heat, const std::vector<int>& joined);

/// Refuses a steady analysis of a body whose temperature nothing determines. Collective.
/// @param joined  [mesh bodies] number of the group of bodies that conduct to one another
void refuse_undetermined(const MeshedScene& meshed, const Scene& scene, const HeatOfModel& heat, const std::vector<int>& joined);

}  // namespace mortise
