// Reactions, contact forces, balance.

#include <Eigen/Dense>
#include <Tpetra_Map.hpp>
#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <boost/math/constants/constants.hpp>
#include <cmath>

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
  const auto at = [](const auto& values, LocalOrdinal node) {
    return Eigen::Vector3d(values(3 * node, 0), values(3 * node + 1, 0), values(3 * node + 2, 0));
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

void Reaction::prepare(const QuantityContext& context) {
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
}

double Reaction::evaluate(const QuantityContext& context) {
  const Mesh& mesh = context.mesh();
  const auto reaction = context.reaction->getLocalViewHost(Tpetra::Access::ReadOnly);
  double sum = 0.0;
  if (component > Of::rotation) {
    const int about = static_cast<int>(component) - static_cast<int>(Of::rotation_x);
    return sum_over_ranks(mesh, holding_moment(context, require_rotating_point(mesh, set))[about]);
  }
  if (component == Of::rotation) {  // the rotation node's dof is arm * theta
    const ReferencePoint& point = require_rotating_point(mesh, set);
    if (point.rotation_node < mesh.owned_count()) sum = reaction(2 * point.rotation_node, 0) * point.arm;
    return sum_over_ranks(mesh, sum);
  }
  for (const LocalOrdinal node : require_node_set(mesh, set))
    if (node < mesh.owned_count()) sum += reaction(mesh.dimension * node + static_cast<int>(component), 0);
  return sum_over_ranks(mesh, sum);
}

void Rotation::describe(Parameters& parameters) {
  parameters.add("set", point, Says("a reference point that turns: the name of a tied set, or \"body/reference\" of a rigid body").required());
  parameters.add("component", component, component_names(), "of the rotation vector, in 3D scenes");
}

void Rotation::prepare(const QuantityContext& context) { require_rotating_point(context.mesh(), point); }

double Rotation::evaluate(const QuantityContext& context) {
  const ReferencePoint& turning = require_rotating_point(context.mesh(), point);
  const auto displacement = context.local_displacement->getLocalViewHost(Tpetra::Access::ReadOnly);
  const LocalOrdinal dof = context.mesh().dimension * turning.rotation_node + (context.mesh().dimension == 3 ? static_cast<int>(component) : 0);
  return displacement(dof, 0) / turning.arm * boost::math::constants::radian<double>();
}

void ContactForce::describe(Parameters& parameters) {
  parameters.add("pair", pair, "contact pair; may be left out if the scene has one only");
  parameters.add("component", component, component_names(), "direction of the force on the slave side");
  parameters.add("part", part, {{"all", Part::all}, {"normal", Part::normal}, {"tangential", Part::tangential}},
                 "what of it: all, the pressures along the nodes' normals, or the shear tractions across them");
}

void ContactForce::prepare(const QuantityContext& context) {
  pair_ = find_pair(context, pair);
  require_component(context, component);
}

double ContactForce::evaluate(const QuantityContext& context) {
  const int i = static_cast<int>(component);
  if (part == Part::all) return resultant(*context.laws, pair_)[i];
  double force = 0.0;
  const auto subtract = [&](std::size_t pair, double sign) {
    for (const auto& state : node_states(*context.laws, pair)) {
      const double normal = state.pressure * state.normal[i];
      force -= sign * state.covered * (part == Part::normal ? normal : state.traction[i] - normal);
    }
  };
  subtract(pair_, 1.0);
  if (const auto other = context.contact->second_pass(pair_)) subtract(*other, -1.0);
  return sum_over_ranks(context.mesh(), force);
}

namespace {

using Sums = std::array<double, 3>;

Sums over_ranks(const Mesh& mesh, const Sums& mine) {
  return {sum_over_ranks(mesh, mine[0]), sum_over_ranks(mesh, mine[1]), sum_over_ranks(mesh, mine[2])};
}

/// Radial forces on a ring do not sum to zero: the hoop stress carries them, or the area that contact acts on.
int first_balanced_component(const QuantityContext& context) { return context.bodies.kinematics() == Kinematics::axisymmetric ? 1 : 0; }

double contact_imbalance(const QuantityContext& context) {
  if (context.contact == nullptr) return 0.0;
  Vector force(context.bodies.dofs());
  context.laws->add_force(force);
  const auto values = force.getLocalViewHost(Tpetra::Access::ReadOnly);
  Sums sum{}, absolute{};
  const int dimension = context.mesh().dimension;
  for (std::size_t dof = 0; dof < values.extent(0); ++dof) {
    sum[dof % dimension] += values(dof, 0);
    absolute[dof % dimension] += std::abs(values(dof, 0));
  }
  sum = over_ranks(context.mesh(), sum);
  absolute = over_ranks(context.mesh(), absolute);
  const double scale = 0.5 * std::max({absolute[0], absolute[1], absolute[2]});
  if (first_balanced_component(context) > 0) sum[0] = 0.0;
  return scale > 0.0 ? std::hypot(sum[0], sum[1], sum[2]) / scale : 0.0;
}

/// Forces no larger than round-off are none, and none are in balance.
double total_imbalance(const QuantityContext& context) {
  const auto load = context.external_force->getLocalViewHost(Tpetra::Access::ReadOnly);
  const auto reaction = context.reaction->getLocalViewHost(Tpetra::Access::ReadOnly);
  Sums sum{}, loads{}, reactions{};
  const int dimension = context.mesh().dimension;
  const auto is_rotation = [&](LocalOrdinal dof) {  // moments are no forces
    const auto& points = context.mesh().reference_points;
    return std::any_of(points.begin(), points.end(), [&](const ReferencePoint& point) { return point.rotation_node == dof / dimension; });
  };
  for (std::size_t dof = 0; dof < load.extent(0); ++dof) {
    if (is_rotation(static_cast<LocalOrdinal>(dof))) continue;
    sum[dof % dimension] += load(dof, 0);
    loads[dof % dimension] += std::abs(load(dof, 0));
  }
  for (const LocalOrdinal dof : *context.prescribed) {
    if (is_rotation(dof)) continue;
    sum[dof % dimension] += reaction(dof, 0);
    reactions[dof % dimension] += std::abs(reaction(dof, 0));
  }
  const Mesh& mesh = context.mesh();
  sum = over_ranks(mesh, sum), loads = over_ranks(mesh, loads), reactions = over_ranks(mesh, reactions);
  double largest = 0.0, scale = 0.0;
  for (int i = first_balanced_component(context); i < dimension; ++i) {
    largest = std::max(largest, std::abs(sum[i]));
    scale = std::max({scale, loads[i], reactions[i]});
  }
  return scale > context.force_round_off ? largest / scale : 0.0;
}

}  // namespace

void MomentumImbalance::describe(Parameters& parameters) {
  parameters.add("of", of, {{"both", Of::both}, {"contact", Of::contact}, {"total", Of::total}},
                 "contact: forces on slave against those on master; total: loads against reactions; both: the larger one");
}

void MomentumImbalance::prepare(const QuantityContext&) {}

double MomentumImbalance::evaluate(const QuantityContext& context) {
  double imbalance = 0.0;
  if (of != Of::total) imbalance = std::max(imbalance, contact_imbalance(context));
  if (of != Of::contact) imbalance = std::max(imbalance, total_imbalance(context));
  return imbalance;
}

}  // namespace mortise
