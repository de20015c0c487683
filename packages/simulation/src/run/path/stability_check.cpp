#include "run/path/stability_check.hpp"

#include <fmt/format.h>

#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_Import.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "mortise/core/error.hpp"

namespace mortise {
namespace {

constexpr double much_farther = 2.5;  ///< for what drives a step than in the step before, see StabilityCheck
constexpr int parts_of_the_line = 8;  ///< between two states, at whose ends forces are looked at
constexpr double no_work = 1e-6;      ///< of work, in which forces of rigid motion leave differences
constexpr double goes_as_far = 1.5;   ///< between 1 on a path, 1.4 at a maximum of the load, and 2 of a jump in half the step

/// Sign of det J at an evaluation; 0: not known, as where J is singular.
int determinant_sign_at(const SemiSmoothSystem& system, const SystemEvaluation& at) try {
  Vector direction(system.map());
  system.linearise(at).newton_direction(at.residual(), direction);
  return system.parts().linear_solver->determinant_sign();
} catch (const StepFailure&) {  // on every rank
  return 0;
}

/// True if forces between two displacements are beyond those of both, see StabilityCheck. Internal forces alone: contact only transfers them.
bool passes_a_maximum(const SemiSmoothSystem& system, const Vector& from, const Vector& to) {
  const SystemParts& parts = system.parts();
  if (parts.fields.size() > 1) return false;  // of other units
  const RCP<const Vector> u = system.unknowns(from);
  Vector change(*system.unknowns(to), Teuchos::Copy);
  change.update(-1.0, *u, 1.0);
  const Import to_local(parts.dofs, parts.local_dofs);
  std::array<double, parts_of_the_line + 1> g{};
  double size = 0.0;
  for (int point = 0; point <= parts_of_the_line; ++point) {
    Vector at(*u, Teuchos::Copy), local(parts.local_dofs), forces(parts.dofs);
    at.update(static_cast<double>(point) / parts_of_the_line, change, 1.0);
    local.doImport(at, to_local, Tpetra::REPLACE);
    std::optional<StepFailure> failure;
    for (const auto& contribution : parts.contributions)
      if (contribution->kind() == Contribution::Kind::internal) contribution->add_residual({0.0, at, local}, forces, failure);
    int mine = failure ? 1 : 0, any = 0;
    Teuchos::reduceAll(*parts.dofs->getComm(), Teuchos::REDUCE_MAX, mine, Teuchos::outArg(any));
    if (any != 0) return true;  // bodies are crushed in between
    g[point] = change.dot(forces);
    size = std::max(size, change.norm2() * forces.norm2());
  }
  const auto [least, most] = std::minmax(g.front(), g.back());
  return std::any_of(g.begin(), g.end(),
                     [&, low = least, high = most](double value) { return value > high + no_work * size || value < low - no_work * size; });
}

/// Motion of a step over what drove it. Without a known drive, over the length of the step.
double rate_of(double moved, double strength, double dt, bool by_strength) {
  const double drive = by_strength ? strength : dt;
  return drive > 0.0 ? moved / drive : std::numeric_limits<double>::infinity();
}

}  // namespace

RCP<Vector> StabilityCheck::verify(const SemiSmoothSystem& system, const AcceptedState& from, const SystemEvaluation& to, int) {
  {
    Vector change(*system.unknowns(to.x()), Teuchos::Copy);
    change.update(-1.0, *system.unknowns(*from.x), 1.0);
    passed_moved_ = system.first_field(change)->normInf();
  }
  const double begin = from.context.time, end = to.context().time;
  passed_dt_ = end - begin;
  // The last factors are those of an iterate close to the solution; what they say against it has to hold there.
  const bool has_sign = !system.parts().contact;  // conditions of closed nodes have signs of their own
  passed_unstable_ = has_sign && system.parts().linear_solver->determinant_sign() < 0 && determinant_sign_at(system, to) < 0;
  if (is_unstable_ || (!last_dt_ && !passed_unstable_)) return Teuchos::null;
  const double strength = system.drive(*from.x, begin, end).strength();
  const double last_strength = last_dt_ ? system.drive(*from.x, begin - *last_dt_, begin).strength() : strength;
  const bool by_strength = last_strength > 0.0;
  const double now = rate_of(passed_moved_, strength, passed_dt_, by_strength);
  const double before = last_dt_ ? rate_of(*last_moved_, last_strength, *last_dt_, by_strength) : 0.0;
  if (now <= much_farther * before || passed_moved_ <= resolution_) return Teuchos::null;
  if (refused_rate_ && passed_dt_ < 0.75 * *refused_dt_ && now <= goes_as_far * *refused_rate_) return Teuchos::null;
  if (!passed_unstable_ && !passes_a_maximum(system, *from.x, to.x())) return Teuchos::null;
  refused_rate_ = now;
  refused_dt_ = passed_dt_;
  const std::string farther = last_dt_ && before > 0.0 && by_strength && strength > 0.0
                                  ? fmt::format(", {:.3g} times as far for what drives it as in the step before", now / before)
                                  : "";
  throw StepFailure(
      FailureKind::unstable,
      fmt::format("no equilibrium is near: {}, and a node moves by {:.3g} in a step of {:.3g}{}. The structure may snap through, buckle or tip; "
                  "between two states at rest that are that far apart there is motion with inertia. Prescribe the motion instead of the load, or "
                  "end before",
                  passed_unstable_ ? "the one that was found is not stable (det J < 0)"
                                   : "forces have a maximum between the last state and the one that was found",
                  passed_moved_, passed_dt_, farther));
}

void StabilityCheck::accept(const SemiSmoothSystem&, const SystemEvaluation&) {
  if (passed_unstable_ && !is_unstable_)
    warn_(
        "  this equilibrium is not stable (det J < 0), nor are those that follow until said otherwise: with a small disturbance the structure would "
        "buckle, tip or snap through");
  if (!passed_unstable_ && is_unstable_) warn_("  equilibrium is stable again (det J > 0)");
  is_unstable_ = passed_unstable_;
  last_moved_ = passed_moved_;
  last_dt_ = passed_dt_;
  refused_rate_.reset();
  refused_dt_.reset();
}

void StabilityCheck::serialize(StateArchive& archive) {
  int unstable = is_unstable_ ? 1 : 0;
  mortise::serialize(archive, "stability_check.unstable", unstable);
  mortise::serialize(archive, "stability_check.moved", last_moved_);
  mortise::serialize(archive, "stability_check.dt", last_dt_);
  is_unstable_ = unstable != 0;
}

}  // namespace mortise
