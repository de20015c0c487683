#include "run/path/impact_loss.hpp"

#include <fmt/format.h>

#include <Tpetra_Vector.hpp>
#include <algorithm>

namespace mortise {

RCP<Vector> ImpactLossGuard::verify(const SemiSmoothSystem& system, const AcceptedState& from, const SystemEvaluation& found, int) {
  largest_ = std::max(largest_, 0.5 * mass_->times(*from.rates->velocity)->dot(*from.rates->velocity));
  const ContactLaws& laws = found.contact_laws();
  Vector pressures(laws.multipliers(), Teuchos::Copy);
  pressures.update(-1.0, *laws.evaluation().shear_tractions(laws.multipliers()), 1.0);
  const RCP<const Vector> d = system.unknowns(found.x());
  Vector force(d->getMap()), change(*d, Teuchos::Copy);
  laws.evaluation().add_force(pressures, force);
  change.update(-1.0, *system.unknowns(*from.x), 1.0);
  const double loss = force.dot(change);
  if (loss > tolerance_ * largest_)
    throw StepFailure(
        FailureKind::step_error,
        fmt::format("nodes that close within the step take {:.3g} of the kinetic energy, {:.3g}, above the \"impact tolerance\" of {:.3g}",
                    loss / largest_, largest_, tolerance_));
  return Teuchos::null;
}

void ImpactLossGuard::serialize(StateArchive& archive) { mortise::serialize(archive, "impact_loss.largest", largest_); }

}  // namespace mortise
