// Distance of forces from balance.

#include <Tpetra_Map.hpp>
#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <array>
#include <cmath>

#include "mortise/mesh/reference_point.hpp"
#include "mortise/simulation/quantities/quantity_support.hpp"

namespace mortise {
namespace {

using Sums = std::array<double, 3>;

Sums over_ranks(const Mesh& mesh, const Sums& mine) {
  return {sum_over_ranks(mesh, mine[0]), sum_over_ranks(mesh, mine[1]), sum_over_ranks(mesh, mine[2])};
}

/// Radial forces on a ring do not sum to zero: the hoop stress carries them, or the area that contact acts on.
int first_balanced_component(const QuantityContext& context) { return context.bodies.kinematics() == Kinematics::axisymmetric ? 1 : 0; }

double contact_imbalance(const QuantityContext& context) {
  if (context.contact == nullptr) return 0.0;
  Vector force(context.space().dofs());
  context.laws->add_force(force);
  const auto values = force.getLocalViewHost(Tpetra::Access::ReadOnly);
  Sums sum{}, absolute{};
  const Mesh& mesh = context.mesh();
  for (LocalOrdinal node = 0; node < mesh.owned_count(); ++node)
    for (int i = 0; i < mesh.dimension; ++i) {
      const double value = values(context.space().row(node, i), 0);
      sum[i] += value;
      absolute[i] += std::abs(value);
    }
  sum = over_ranks(mesh, sum);
  absolute = over_ranks(mesh, absolute);
  const double scale = 0.5 * std::max({absolute[0], absolute[1], absolute[2]});
  if (first_balanced_component(context) > 0) sum[0] = 0.0;
  return scale > 0.0 ? std::hypot(sum[0], sum[1], sum[2]) / scale : 0.0;
}

/// Forces of springs, dashpots and stabilisation on the bodies: what does not come from the ground has the sum 0. Null: there are none.
RCP<const Vector> forces_of_ground(const QuantityContext& context) {
  const ConnectorsOfStep& connectors = context.connectors;
  if (connectors.springs == nullptr && connectors.dashpots == nullptr && connectors.stabilisation_force == nullptr) return Teuchos::null;
  const auto result = rcp(new Vector(context.space().dofs()));
  std::optional<StepFailure> failure;  // a converged state has none
  if (connectors.springs != nullptr) connectors.springs->add_forces(*context.local_displacement, nullptr, *result, failure);
  if (connectors.dashpots != nullptr) connectors.dashpots->add_forces(*context.local_displacement, connectors.dashpot_velocity, *result, failure);
  if (connectors.stabilisation_force != nullptr) result->update(1.0, *connectors.stabilisation_force, 1.0);
  result->scale(-1.0);
  return result;
}

/// Springs, dashpots and stabilisation on the bodies, and what inertia and damping take. Null: there are none.
RCP<const Vector> further_forces(const QuantityContext& context) {
  if (context.motion == nullptr) return forces_of_ground(context);
  const auto result = rcp(new Vector(context.motion->rate_force, Teuchos::Copy));  // contains dashpots
  result->scale(-1.0);
  if (context.connectors.spring_force != nullptr) result->update(-1.0, *context.connectors.spring_force, 1.0);
  return result;
}

/// Forces no larger than round-off are none, and none are in balance.
double total_imbalance(const QuantityContext& context) {
  const auto load = context.external_force->getLocalViewHost(Tpetra::Access::ReadOnly);
  const auto reaction = context.reaction->getLocalViewHost(Tpetra::Access::ReadOnly);
  Sums sum{}, loads{}, reactions{};
  const Mesh& mesh = context.mesh();
  const auto is_rotation = [&](LocalOrdinal node) {  // moments are no forces
    const auto& points = mesh.reference_points;
    return std::any_of(points.begin(), points.end(), [&](const ReferencePoint& point) { return point.rotation_node == node; });
  };
  for (LocalOrdinal node = 0; node < mesh.owned_count(); ++node) {
    if (is_rotation(node)) continue;
    for (int i = 0; i < mesh.dimension; ++i) {
      const double value = load(context.space().row(node, i), 0);
      sum[i] += value;
      loads[i] += std::abs(value);
    }
  }
  for (const LocalOrdinal dof : *context.prescribed) {
    const FieldPlace at = context.space().place(dof);
    if (at.field != 0 || is_rotation(at.node)) continue;
    sum[at.component] += reaction(dof, 0);
    reactions[at.component] += std::abs(reaction(dof, 0));
  }
  if (const RCP<const Vector> ground = further_forces(context); !ground.is_null()) {
    const auto values = ground->getLocalViewHost(Tpetra::Access::ReadOnly);
    for (LocalOrdinal node = 0; node < mesh.owned_count(); ++node) {
      if (is_rotation(node)) continue;
      for (int i = 0; i < mesh.dimension; ++i) {
        const double value = values(context.space().row(node, i), 0);
        sum[i] += value;
        reactions[i] += std::abs(value);
      }
    }
  }
  sum = over_ranks(mesh, sum), loads = over_ranks(mesh, loads), reactions = over_ranks(mesh, reactions);
  double largest = 0.0, scale = 0.0;
  for (int i = first_balanced_component(context); i < mesh.dimension; ++i) {
    largest = std::max(largest, std::abs(sum[i]));
    scale = std::max({scale, loads[i], reactions[i]});
  }
  return scale > context.force_round_off ? largest / scale : 0.0;
}

/// With f_c the contact forces on all nodes:
///   - contact: |sum f_c| / (1/2 sum |f_c|);
///   - total: |sum of loads + sum of reactions on prescribed dofs - inertia and damping| / the largest sum of absolute values;
///   - both: the larger of the two.
/// Components in which bodies balance: both, axisymmetric the axial one (total).
struct MomentumImbalance : Quantity {
  enum class Of { contact, total, both };
  Of of = Of::both;

  void describe(Parameters& parameters) override {
    parameters.add("of", of, {{"both", Of::both}, {"contact", Of::contact}, {"total", Of::total}},
                   "contact: forces on slave against those on master; total: loads against reactions, with inertia less M a; both: the larger one");
  }

  std::unique_ptr<QuantityEvaluator> make_evaluator(const QuantityContext&) const override {
    return evaluator_of([of = of](const QuantityContext& at) {
      double imbalance = 0.0;
      if (of != Of::total) imbalance = std::max(imbalance, contact_imbalance(at));
      if (of != Of::contact) imbalance = std::max(imbalance, total_imbalance(at));
      return imbalance;
    });
  }
};

}  // namespace

void add_momentum_imbalance(Registry<Quantity>& kinds) { kinds.add<MomentumImbalance>("momentum imbalance", "relative imbalance of the forces"); }

}  // namespace mortise
