#include "run/output/step_motion.hpp"

#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Vector.hpp>

namespace mortise {

MotionOfStep StepMotion::of_quantities() const {
  return {*velocity, *acceleration, *rate_force, *damping_force, *displacement_before, *velocity_before, dt, is_over_step};
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
  motion.is_over_step = step->integration->scheme.balance == TimeScheme::Balance::over_step;
  return motion;
}

}  // namespace mortise
