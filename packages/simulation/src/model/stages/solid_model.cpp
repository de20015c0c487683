#include "model/stages/solid_model.hpp"

#include <Tpetra_CrsGraph.hpp>
#include <Tpetra_MultiVector.hpp>
#include <Tpetra_Vector.hpp>
#include <algorithm>

#include "model/connectors/connectors_of_scene.hpp"
#include "model/contributions.hpp"
#include "model/heat/heat_of_scene.hpp"
#include "model/motion/inertia.hpp"
#include "model/pairs/surface_ties.hpp"
#include "model/support_constraints.hpp"
#include "mortise/simulation/scene/scene_bodies.hpp"

namespace mortise {
namespace {

std::function<NearNullSpace(const Vector&)> near_null_space_of(const std::shared_ptr<const Bodies>& bodies, const MeshedScene& meshed,
                                                               const Scene& scene) {
  return [bodies, apart = 1e6 * meshed.size.length, joined = joined_bodies(*meshed.mesh, scene)](const Vector& displacement) {
    const RCP<MultiVector> coordinates = current_coordinates(*bodies, displacement);
    const auto x = coordinates->getLocalViewHost(Tpetra::Access::ReadWrite);
    for (std::size_t node = 0; node < x.extent(0); ++node) x(node, 0) += apart * joined[bodies->mesh()->body_of_node[node]];
    return NearNullSpace{rigid_body_modes(*bodies, displacement), coordinates, apart};
  };
}

}  // namespace

SolidModel make_solid(const MeshedScene& meshed, const Scene& scene, const Timers& timers, Collector& collect) {
  SolidModel solid;
  // Flows that the system does not weigh are weighed where they are computed.
  const FlowsAtStart at_start = flows_at_start(scene);
  const double heat_at_start = at_start.is_of_system ? 0.0 : at_start.share;
  const auto bodies = std::make_shared<Bodies>(meshed.space, scene.kinematics, scene.thickness, block_properties(scene, *meshed.mesh), heat_at_start);
  solid.bodies = bodies;
  SystemParts& parts = solid.parts;
  parts.dofs = meshed.space->dofs();
  parts.local_dofs = meshed.space->local_dofs();
  parts.bulk_graph = [space = meshed.space] { return space->graph(); };
  parts.length = meshed.size.length;
  parts.near_null_space = near_null_space_of(bodies, meshed, scene);
  const std::optional<double> share =
      scene.heat.acts() && !scene.heat.is_transient() ? std::nullopt : std::optional(at_start.is_of_system ? at_start.share : 0.0);
  const auto bulk = std::make_shared<BulkContribution>(bodies, share, timers);
  parts.contributions.push_back(bulk);
  for (const auto& load : scene.loads)
    collect([&] { solid.loads.push_back(std::make_shared<LoadContribution>(load.name, load.value.load.options->make(solid.bodies), timers)); });
  parts.contributions.insert(parts.contributions.end(), solid.loads.begin(), solid.loads.end());
  collect([&] { solid.connectors = add_connectors(scene, solid.bodies, timers, parts); });
  collect([&] { solid.heat = add_heat(meshed, scene, timers, parts); });
  if (bodies->heat() && share) solid.heat.bulk = bulk;
  collect([&] { solid.motion = std::make_shared<const PrescribedMotion>(*bodies, scene.boundary_conditions); });
  solid.supports.ties = meshed.ties.tied;
  return solid;
}

void add_supports(const MeshedScene& meshed, const Scene& scene, const Timers& timers, SolidModel& solid) {
  const PrescribedMotion& motion = *solid.motion;
  if (!meshed.mesh->reference_points.empty()) solid.parts.rigid = std::make_shared<FollowingNodes>(*solid.bodies, motion.dofs());
  const SupportConstraints supported =
      support_constraints(meshed.space, solid.supports.ties, solid.motion, temperature_constraints(meshed, scene, solid.heat));
  solid.parts.constraints = supported.lines;
  solid.parts.put_support_forces = supported.put_support_forces;
  Supports& supports = solid.supports;
  supports.prescribed = motion.dofs();
  supports.fixed = marked_components(*meshed.space, motion.dofs(), 1.0);
  supports.inclined = motion.inclined();
  const std::vector<LocalOrdinal> inclined = held_dofs(*meshed.space, supports.inclined);
  std::merge(motion.dofs().begin(), motion.dofs().end(), inclined.begin(), inclined.end(), std::back_inserter(supports.dofs));
  solid.inertia = add_inertia(scene, solid.bodies, motion.dofs(), timers, solid.parts);
  if (solid.inertia.mass)
    for (const auto& load : solid.loads) load->weigh_by(solid.inertia.mass);
  else if (std::vector<double> points = weights_of_points(scene, *solid.bodies); !points.empty())
    solid.bodies->set_point_masses(std::move(points));
  if (solid.connectors.springs) supports.connectors.push_back(solid.connectors.springs);
  if (solid.connectors.dashpots && !scene.inertia.acts()) supports.connectors.push_back(solid.connectors.dashpots);
}

RCP<MultiVector> marked_components(const FieldSpace& space, const std::vector<LocalOrdinal>& dofs, double mark) {
  const auto marks = rcp(new MultiVector(space.mesh()->owned_nodes, static_cast<std::size_t>(space.rows(0).components)));
  const auto view = marks->getLocalViewHost(Tpetra::Access::ReadWrite);
  for (const LocalOrdinal dof : dofs)
    if (const FieldPlace at = space.place(dof); at.field == 0) view(at.node, at.component) = mark;
  return marks;
}

}  // namespace mortise
