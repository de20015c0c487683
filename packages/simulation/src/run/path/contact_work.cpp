#include "run/path/contact_work.hpp"

#include <fmt/format.h>

#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <cmath>

namespace mortise {
namespace {

constexpr double noticeable_gain = 0.05;  ///< of E
constexpr const char* remedy_of_gain =
    "; please take the \"balance\" \"over the step\" with \"contact mass\" \"removed\", shorter steps, or \"geometry\" \"reference\" where surfaces "
    "turn "
    "by little";

}  // namespace

RCP<Vector> ContactWorkGuard::verify(const SemiSmoothSystem& system, const AcceptedState& from, const SystemEvaluation& found, int) {
  largest_ = std::max({largest_, 0.5 * mass_->times(*from.rates->velocity)->dot(*from.rates->velocity), std::abs(strain_)});
  const RCP<const Vector> d = system.unknowns(found.x());
  Vector change(*d, Teuchos::Copy);
  change.update(-1.0, *system.unknowns(*from.x), 1.0);
  next_force_ = rcp(new Vector(d->getMap()));
  found.contact_laws().add_force(*next_force_);
  const bool is_over_step = found.context().step->integration->scheme.balance == TimeScheme::Balance::over_step;
  double work = -next_force_->dot(change);
  if (!is_over_step) work = 0.5 * (work - force_->dot(change));
  next_work_ = work_ + work;
  next_strain_ = strain_ + found.internal_forces().dot(change);
  const double rise = next_work_ - least_;
  if (largest_ > 0.0 && rise > std::max(largest_, std::abs(next_strain_)))
    throw StepFailure(FailureKind::step_error,
                      fmt::format("contact gives the energy {:.3g}, more than the {:.3g} that the bodies had{}", rise, largest_, remedy_of_gain));
  return Teuchos::null;
}

void ContactWorkGuard::accept(const SemiSmoothSystem&, const SystemEvaluation&) {
  work_ = next_work_;
  strain_ = next_strain_;
  force_ = next_force_;
  least_ = std::min(least_, work_);
  largest_ = std::max(largest_, std::abs(strain_));
  if (is_said_ || !(work_ - least_ > noticeable_gain * largest_)) return;
  is_said_ = true;
  warn_(fmt::format("contact has given the energy {:.3g}, {:.2g} of the largest that the bodies had{}", work_ - least_, (work_ - least_) / largest_,
                    remedy_of_gain));
}

void ContactWorkGuard::serialize(StateArchive& archive) {
  int is_said = is_said_ ? 1 : 0;
  mortise::serialize(archive, "contact_work.work", work_);
  mortise::serialize(archive, "contact_work.least", least_);
  mortise::serialize(archive, "contact_work.strain", strain_);
  mortise::serialize(archive, "contact_work.largest", largest_);
  mortise::serialize(archive, "contact_work.force", "dofs", *force_);
  mortise::serialize(archive, "contact_work.is_said", is_said);
  is_said_ = is_said != 0;
}

}  // namespace mortise
