#include "quantities/work.hpp"

#include <Tpetra_Map.hpp>
#include <Tpetra_Vector.hpp>
#include <optional>
#include <string>

#include "mortise/simulation/quantities/quantity_support.hpp"

namespace mortise {
namespace {

/// Adds the forces of dashpots, as the residual has them.
void add_dashpots(const QuantityContext& context, Vector& force) {
  const ConnectorsOfStep& connectors = context.connectors;
  if (connectors.dashpots == nullptr) return;
  std::optional<StepFailure> failure;  // a converged state has none
  connectors.dashpots->add_forces(*context.local_displacement, connectors.dashpot_velocity, force, failure);
}

void add_stabilisation(const QuantityContext& context, Vector& force) {
  if (context.connectors.stabilisation_force != nullptr) force.update(1.0, *context.connectors.stabilisation_force, 1.0);
}

/// What counts at reference points themselves. Followers bear what is left of loads and supports after springs, dashpots and inertia at the point, so
/// that external work lacks these there.
RCP<const Vector> forces_at_points(EnergyOf of, const QuantityContext& context) {
  const auto result = rcp(new Vector(context.space().dofs()));
  if (context.connectors.spring_force != nullptr) result->assign(*context.connectors.spring_force);
  if (of == EnergyOf::internal_work) return result;
  if (context.motion != nullptr)
    result->update(1.0, context.motion->rate_force, 1.0);
  else
    add_dashpots(context, *result);
  return result;
}

// What a work is done by, on all owned dofs. From outside act loads, and supports on prescribed dofs. Reference points act on their followers, and
// there their work is counted. A point that is carried round by an angle a with a moment M would do M a. Its followers do M sin a along the chords of
// their ways, as do all other nodes of the body. With r = f_int - f_ext + f_c the internal forces are r + f_ext - f_c, and what supports and points
// do is r. Friction takes what its forces on both sides do not give back: f_c of the shear tractions alone.
RCP<Vector> working_force(EnergyOf of, const QuantityContext& context) {
  const auto result = rcp(new Vector(context.space().dofs()));
  const auto add_contact_force = [&](const Vector& multipliers) { context.laws->evaluation().add_force(multipliers, *result); };
  if (of == EnergyOf::friction) {
    add_contact_force(*context.laws->evaluation().shear_tractions(context.laws->multipliers()));
    return result;
  }
  if (of == EnergyOf::damping) {
    if (context.motion != nullptr) result->assign(context.motion->damping_force);
    return result;
  }
  if (of == EnergyOf::dashpots) {
    add_dashpots(context, *result);
    return result;
  }
  if (of == EnergyOf::stabilisation) {
    add_stabilisation(context, *result);
    return result;
  }
  if (of == EnergyOf::contact_work) {
    add_contact_force(context.laws->multipliers());
    result->scale(-1.0);
    return result;
  }
  if (of == EnergyOf::internal_work) {
    if (context.contact != nullptr) add_contact_force(context.laws->multipliers());
    if (context.motion == nullptr) {  // viscous forces of statics are no internal ones
      add_dashpots(context, *result);
      add_stabilisation(context, *result);
    }
    result->update(1.0, *context.reaction, 1.0, *context.external_force, -1.0);
    if (context.motion != nullptr) result->update(-1.0, context.motion->rate_force, 1.0);
  } else {
    result->assign(*context.external_force);
    const auto reaction = context.reaction->getLocalViewHost(Tpetra::Access::ReadOnly);
    const auto values = result->getLocalViewHost(Tpetra::Access::ReadWrite);
    for (const auto* dofs : {context.prescribed, context.following})
      for (std::size_t n = 0; dofs != nullptr && n < dofs->size(); ++n) values((*dofs)[n], 0) += reaction((*dofs)[n], 0);
  }
  const Mesh& mesh = context.mesh();
  if (mesh.reference_points.empty()) return result;
  const RCP<const Vector> own = forces_at_points(of, context);
  const auto at_points = own->getLocalViewHost(Tpetra::Access::ReadOnly);
  const auto values = result->getLocalViewHost(Tpetra::Access::ReadWrite);
  for (const ReferencePoint& point : mesh.reference_points)
    for (const LocalOrdinal node : {point.node, point.rotation_node})
      for (int i = 0; i < mesh.dimension && node >= 0 && node < mesh.owned_count(); ++i) {
        const LocalOrdinal row = context.space().row(node, i);
        values(row, 0) = at_points(row, 0);
      }
  return result;
}

/// A work, summed up over the steps.
class WorkEvaluator final : public QuantityEvaluator {
 public:
  WorkEvaluator(EnergyOf of, const QuantityContext& context, WorkRule rule)
      : of_(of), rule_(rule), force_(rcp(new Vector(context.space().dofs()))), displacement_(rcp(new Vector(context.space().dofs()))) {}

  double evaluate(const QuantityContext& context) override {
    if ((of_ == EnergyOf::friction || of_ == EnergyOf::contact_work) && context.contact == nullptr) return 0.0;
    const RCP<Vector> now = working_force(of_, context);
    if (!has_begun_ && context.motion != nullptr) {
      displacement_->assign(context.motion->displacement_before);
      if (const Vector* start = force_at_start(*context.motion)) force_->assign(*start);
    }
    has_begun_ = true;
    Vector change(*context.displacement, Teuchos::Copy);
    change.update(-1.0, *displacement_, 1.0);
    force_->update(1.0 - share_before(context), *now, share_before(context));
    work_ += force_->dot(change);
    has_force_ = true;
    force_ = now;
    displacement_->assign(*context.displacement);
    return work_;
  }

  void serialize(StateArchive& archive, const std::string& name) override {
    int has_begun = has_begun_ ? 1 : 0;
    mortise::serialize(archive, name + ".has_begun", has_begun);
    has_begun_ = has_begun != 0;
    has_force_ = has_begun_;
    mortise::serialize(archive, name + ".work", work_);
    mortise::serialize(archive, name + ".force", "dofs", *force_);
    mortise::serialize(archive, name + ".displacement", "dofs", *displacement_);
  }

 private:
  /// Of the force before in the work of a step.
  double share_before(const QuantityContext& context) const {
    if (context.motion == nullptr) return rule_ == WorkRule::at_end ? 0.0 : 0.5;
    if (!context.motion->is_over_step) return 0.5;
    return rule_ == WorkRule::central && has_force_ ? 0.5 - context.motion->alpha_f : 0.0;
  }

  /// Null: 0, or not known. Contact and supports have none.
  const Vector* force_at_start(const MotionOfStep& motion) const {
    if (of_ == EnergyOf::external_work) return motion.external_force_before;
    return of_ == EnergyOf::damping || of_ == EnergyOf::dashpots ? motion.damping_force_before : nullptr;
  }

  EnergyOf of_;
  WorkRule rule_;
  double work_ = 0.0;
  bool has_begun_ = false;
  bool has_force_ = false;            ///< `force_` is that of a step before
  RCP<Vector> force_, displacement_;  ///< at the last step
};

}  // namespace

std::unique_ptr<QuantityEvaluator> work(EnergyOf of, const QuantityContext& context, WorkRule rule) {
  return std::make_unique<WorkEvaluator>(of, context, rule);
}

}  // namespace mortise
