#include "run/output/step_motion.hpp"

#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Vector.hpp>
#include <algorithm>

namespace mortise {

MotionOfStep StepMotion::of_quantities() const {
  return {*velocity,
          *acceleration,
          *rate_force,
          *damping_force,
          *displacement_before,
          *velocity_before,
          dt,
          is_over_step,
          alpha_f,
          external_force_before.get(),
          damping_force_before.get()};
}

std::optional<StepMotion> step_motion(const Model& model, const SemiSmoothSystem& system, const SystemEvaluation& at) {
  const TimeStep* step = at.context().step.get();
  if (step == nullptr) return std::nullopt;
  const RCP<const Vector> d = system.unknowns(at.x());
  const AcceptedRates rates = rates_at_end(*step, *d, at.external_forces());
  const RCP<const Vector> acceleration = rates.balanced_acceleration.is_null() ? rates.acceleration : rates.balanced_acceleration;
  StepMotion motion;
  motion.velocity = rates.velocity;
  motion.acceleration = acceleration;
  if (!step->integration->extension.is_null()) {
    const auto extended = rcp(new Vector(acceleration->getMap()));
    step->integration->extension->apply(*acceleration, *extended);
    motion.acceleration = extended;
  }
  const auto damping = rcp(new Vector(at.rate_forces(), Teuchos::Copy));
  damping->update(-1.0, *model.inertia().mass->times(*blended_rates(*step, *d).acceleration), 1.0);
  motion.rate_force = rcp(new Vector(at.rate_forces(), Teuchos::Copy));
  motion.damping_force = damping;
  motion.displacement_before = step->unknowns;
  motion.velocity_before = step->start.velocity;
  motion.dt = step->dt;
  motion.alpha_f = step->integration->scheme.alpha_f;
  motion.is_over_step = step->integration->scheme.balance == TimeScheme::Balance::over_step;
  return motion;
}

void add_forces_at_start(const Model& model, const SystemEvaluation& at, StepMotion& motion) {
  const FieldSpace& space = model.space();
  const auto with_ghosts = [&](const Vector& v) {
    const auto local = rcp(new Vector(space.local_dofs()));
    local->doImport(v, *space.ghost_import(), Tpetra::INSERT);
    return local;
  };
  const RCP<const Vector> u = motion.displacement_before, v = motion.velocity_before;
  const RCP<const Vector> local_u = with_ghosts(*u), local_v = with_ghosts(*v);
  const Vector a(space.dofs()), local_a(space.local_dofs());
  const Configuration start{at.context().time - motion.dt, *u, *local_u, v.get(), local_v.get(), &a, &local_a};
  const auto external = rcp(new Vector(space.dofs())), damping = rcp(new Vector(space.dofs()));
  std::optional<StepFailure> failure;
  for (const auto& contribution : model.parts().contributions) {
    const std::vector<std::string> writes = contribution->uses().writes;
    if (std::find(writes.begin(), writes.end(), "displacement") == writes.end()) continue;
    if (contribution->kind() == Contribution::Kind::external) contribution->add_residual(start, *external, failure);
    if (contribution->uses().time_derivatives > 0) contribution->add_residual(start, *damping, failure);
  }
  throw_if_any(*model.mesh()->comm, failure);
  external->scale(-1.0);
  motion.external_force_before = external;
  motion.damping_force_before = damping;
}

}  // namespace mortise
