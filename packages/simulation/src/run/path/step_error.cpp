#include "run/path/step_error.hpp"

#include <fmt/format.h>

#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <cmath>

namespace mortise {

RCP<Vector> StepErrorGuard::verify(const SemiSmoothSystem& system, const AcceptedState&, const SystemEvaluation& found, int) {
  const TimeStep& step = *found.context().step;
  const RCP<const Vector> d = system.unknowns(found.x());
  Vector change(*rates_at_end(step, *d, found.external_forces()).acceleration, Teuchos::Copy);
  change.update(-1.0, *step.start.acceleration, 1.0);
  {
    const auto rows = change.getLocalViewHost(Tpetra::Access::ReadWrite);
    for (const LocalOrdinal dof : step.integration->massless) rows(dof, 0) = 0.0;
  }
  const double size = std::max(largest_, system.first_field(*d)->normInf());
  const double beta = 1.0 / step.integration->scheme.acceleration[0];
  const double error = std::abs(beta - 1.0 / 6.0) * step.dt * step.dt * system.first_field(change)->normInf();
  growth_ = error > 0.0 ? std::clamp(0.9 * std::cbrt(tolerance_ * size / error), 0.5, 2.0) : 2.0;
  if (error > tolerance_ * size)
    throw StepFailure(FailureKind::step_error,
                      fmt::format("the local error of the step, {:.3g} of a displacement of {:.3g}, is above the \"error tolerance\" of {:.3g}",
                                  size > 0.0 ? error / size : error, size, tolerance_));
  return Teuchos::null;
}

void StepErrorGuard::accept(const SemiSmoothSystem& system, const SystemEvaluation& at) {
  largest_ = std::max(largest_, system.first_field(*system.unknowns(at.x()))->normInf());
}

void StepErrorGuard::serialize(StateArchive& archive) { mortise::serialize(archive, "step_error.largest", largest_); }

}  // namespace mortise
