// The forces and moments of supports.

#include <Eigen/Dense>
#include <Tpetra_Map.hpp>
#include <Tpetra_Vector.hpp>

#include "mortise/mesh/reference_point.hpp"
#include "mortise/mesh/sets.hpp"
#include "mortise/simulation/quantities/quantity_support.hpp"
#include "mortise/solid/rotation_vector.hpp"

namespace mortise {
namespace {

/// This rank's part of the moment that holds a reference point in 3D. With x_i and x the current positions of followers and point it is
///   sum_i (x_i - x) x r_i - m.
/// The forces on the followers are r_i; m is the moment of loads, of which external forces hold T^T m / arm.
Eigen::Vector3d holding_moment(const QuantityContext& context, const ReferencePoint& point) {
  const Mesh& mesh = context.mesh();
  const auto u = context.local_displacement->getLocalViewHost(Tpetra::Access::ReadOnly);
  const auto r = context.reaction->getLocalViewHost(Tpetra::Access::ReadOnly),
             load = context.external_force->getLocalViewHost(Tpetra::Access::ReadOnly);
  const auto at = [&](const auto& values, LocalOrdinal node) {
    const LocalOrdinal first = context.space().row(node, 0);
    return Eigen::Vector3d(values(first, 0), values(first + 1, 0), values(first + 2, 0));
  };
  const auto position = [&](LocalOrdinal node) { return Eigen::Vector3d(Eigen::Vector3d(mesh.coordinates[node].data()) + at(u, node)); };
  const Eigen::Vector3d x = position(point.node);
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
  for (const LocalOrdinal node : point.followers)
    if (node < mesh.owned_count()) moment += (position(node) - x).cross(at(r, node));
  if (point.rotation_node < mesh.owned_count())
    moment -= spatial_moment(at(u, point.rotation_node) / point.arm, at(load, point.rotation_node) * point.arm);
  return moment;
}

/// This rank's part of a component of the reaction of a set.
double reaction_of(const Reaction& quantity, const QuantityContext& context) {
  const Mesh& mesh = context.mesh();
  const auto reaction = context.reaction->getLocalViewHost(Tpetra::Access::ReadOnly);
  if (quantity.component > Reaction::Of::rotation) {
    const int about = static_cast<int>(quantity.component) - static_cast<int>(Reaction::Of::rotation_x);
    return holding_moment(context, require_rotating_point(mesh, quantity.set))[about];
  }
  if (quantity.component == Reaction::Of::rotation) {  // the rotation node's dof is arm * theta
    const ReferencePoint& point = require_rotating_point(mesh, quantity.set);
    return point.rotation_node < mesh.owned_count() ? reaction(context.space().row(point.rotation_node, 0), 0) * point.arm : 0.0;
  }
  double sum = 0.0;
  for (const LocalOrdinal node : require_node_set(mesh, quantity.set))
    if (node < mesh.owned_count()) sum += reaction(context.space().row(node, static_cast<int>(quantity.component)), 0);
  return sum;
}

}  // namespace

void Reaction::describe(Parameters& parameters) {
  parameters.add("set", set, Says("nodes whose supports are summed up").required());
  parameters.add(
      "component", component,
      {{"x", Of::x},
       {"y", Of::y},
       {"z", Of::z},
       {"rotation", Of::rotation},
       {"rotation x", Of::rotation_x},
       {"rotation y", Of::rotation_y},
       {"rotation z", Of::rotation_z}},
      "direction of the force; rotation, in 3D rotation x, y, z: the moment that holds a reference point that turns, about axes that do not");
}

std::unique_ptr<QuantityEvaluator> Reaction::make_evaluator(const QuantityContext& context) const {
  const bool in_space = context.mesh().dimension == 3;
  if (component >= Of::rotation)
    require_rotating_point(context.mesh(), set);
  else
    require_node_set(context.mesh(), set);
  if (component == Of::z && !in_space)
    throw InputError(set.place, "a component z exists in three-dimensional scenes only; in 2D please take \"x\" or \"y\"");
  if (component == Of::rotation && in_space)
    throw InputError(set.place, "a component rotation exists in 2D only; in 3D please take \"rotation x\", \"rotation y\" or \"rotation z\"");
  if (component > Of::rotation && !in_space)
    throw InputError(set.place, "components rotation x, y and z exist in three-dimensional scenes only; in 2D please take \"rotation\"");
  return evaluator_of([quantity = *this](const QuantityContext& at) { return sum_over_ranks(at.mesh(), reaction_of(quantity, at)); });
}

void add_reaction(Registry<Quantity>& kinds) { kinds.add<Reaction>("reaction", "force of the supports on a set of nodes"); }

}  // namespace mortise
