#include "run/path/contact_work.hpp"

#include <fmt/format.h>

#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <cmath>
#include <string>

namespace mortise {
namespace {

constexpr double noticeable_gain = 0.05;  ///< of what was given
constexpr const char* remedy_of_gain =
    "; please take the \"balance\" \"over the step\" with \"contact mass\" \"removed\", shorter steps, or \"geometry\" \"reference\" where surfaces "
    "turn "
    "by little";

}  // namespace

RCP<Vector> ContactWorkGuard::verify(const SemiSmoothSystem& system, const AcceptedState& from, const SystemEvaluation& found, int) {
  const double kinetic = 0.5 * mass_->times(*from.rates->velocity)->dot(*from.rates->velocity);
  given_ = std::max(given_, std::abs(kinetic + strain_ - work_));
  const RCP<const Vector> d = system.unknowns(found.x());
  Vector change(*d, Teuchos::Copy);
  change.update(-1.0, *system.unknowns(*from.x), 1.0);
  next_force_ = rcp(new Vector(d->getMap()));
  found.contact_laws().add_force(*next_force_);
  const bool is_over_step = found.context().step->integration->scheme.balance == TimeScheme::Balance::over_step;
  double work = -next_force_->dot(change);
  if (!is_over_step) work = 0.5 * (work - force_->dot(change));
  next_work_ = work_ + work;
  next_internal_ = rcp(new Vector(found.internal_forces(), Teuchos::Copy));
  next_strain_ = strain_ + 0.5 * (internal_->dot(change) + next_internal_->dot(change));
  return Teuchos::null;
}

void ContactWorkGuard::accept(const SemiSmoothSystem&, const SystemEvaluation&) {
  work_ = next_work_;
  strain_ = next_strain_;
  force_ = next_force_;
  internal_ = next_internal_;
  least_ = std::min(least_, work_);
  rise_ = std::max(rise_, work_ - least_);
}

std::optional<StepFailure> ContactWorkGuard::end(const SemiSmoothSystem&, const EndOfSteps&) {
  if (!(rise_ > noticeable_gain * given_)) return std::nullopt;
  const std::string text =
      fmt::format("contact has given the energy {:.3g}, and the start, loads and supports {:.3g}{}", rise_, given_, remedy_of_gain);
  if (rise_ > given_) return StepFailure(FailureKind::step_error, text);
  warn_(text);
  return std::nullopt;
}

void ContactWorkGuard::serialize(StateArchive& archive) {
  mortise::serialize(archive, "contact_work.work", work_);
  mortise::serialize(archive, "contact_work.least", least_);
  mortise::serialize(archive, "contact_work.rise", rise_);
  mortise::serialize(archive, "contact_work.strain", strain_);
  mortise::serialize(archive, "contact_work.given", given_);
  mortise::serialize(archive, "contact_work.force", "dofs", *force_);
  mortise::serialize(archive, "contact_work.internal", "dofs", *internal_);
}

}  // namespace mortise
