#include "run/path/transient_guards.hpp"

#include <fmt/format.h>

#include <Tpetra_Vector.hpp>
#include <limits>

#include "run/path/contact_work.hpp"
#include "run/path/damped_rotation.hpp"
#include "run/path/impact_loss.hpp"
#include "run/path/prescribed_velocity.hpp"
#include "run/path/step_error.hpp"

namespace mortise {
namespace {

/// Bodies that cross the reach of the search within a step may pass through one another.
class SpeedGuard final : public StepGuard {
 public:
  SpeedGuard(double reach, std::function<void(const std::string&)> warn) : reach_(reach), warn_(std::move(warn)) {}

  RCP<Vector> verify(const SemiSmoothSystem& system, const AcceptedState& from, const SystemEvaluation& found, int) override {
    if (is_said_) return Teuchos::null;
    const double speed = system.first_field(*from.rates->velocity)->normInf(), dt = found.context().step->dt;
    if (speed * dt <= reach_) return Teuchos::null;
    is_said_ = true;
    warn_(fmt::format(
        "the step of {:.3g} is longer than {:.3g}, the time in which the fastest node, at {:.3g}, crosses the search reach of {:.3g}: bodies "
        "may pass through one another; please take a smaller \"step\", or a larger \"search reach\"",
        dt, reach_ / speed, speed, reach_));
    return Teuchos::null;
  }
  void serialize(StateArchive& archive) override {
    int is_said = is_said_ ? 1 : 0;
    mortise::serialize(archive, "speed.is_said", is_said);
    is_said_ = is_said != 0;
  }

 private:
  double reach_;
  std::function<void(const std::string&)> warn_;
  bool is_said_ = false;
};

}  // namespace

StepGuards transient_guards(const Model& model, const Scene& scene, std::function<void(const std::string&)> warn) {
  StepGuards guards;
  guards.push_back(std::make_shared<PrescribedVelocityGuard>(model, scene, warn));
  if (!scene.contact.empty()) {
    double reach = std::numeric_limits<double>::infinity();
    for (std::size_t pair = 0; pair < scene.contact.size(); ++pair)
      reach = std::min(reach, scene.contact[pair].value.contact.mortar.search_reach.value_or(model.surfaces_at_start().pairs[pair].longest));
    guards.push_back(std::make_shared<SpeedGuard>(reach, warn));
    guards.push_back(std::make_shared<ContactWorkGuard>(model, warn));
    if (scene.inertia.impact_tolerance) guards.push_back(std::make_shared<ImpactLossGuard>(model.inertia().mass, *scene.inertia.impact_tolerance));
  }
  if (scene.inertia.stiffness_damping > 0.0) guards.push_back(std::make_shared<DampedRotationGuard>(model, warn));
  if (scene.inertia.error_tolerance) guards.push_back(std::make_shared<StepErrorGuard>(*scene.inertia.error_tolerance));
  return guards;
}

}  // namespace mortise
