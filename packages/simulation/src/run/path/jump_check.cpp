#include "mortise/simulation/run/path/jump_check.hpp"

#include <fmt/format.h>

#include <Tpetra_Vector.hpp>

#include "mortise/core/error.hpp"

namespace mortise {
namespace {

constexpr double far = 0.05;         ///< of the model: what a step has to go to be asked, if no body goes farther than it is carried
constexpr double much_faster = 2.5;  ///< than the step before: up to a maximum of the load, where u goes like a root, it is 1/(sqrt 2 - 1) = 2.4
constexpr double same_rate = 1.5;    ///< between 1 on a path, 1.4 at a maximum of the load, and 2 of a jump

}  // namespace

void JumpCheck::verify(const Vector& from, const Vector& to, double dt, bool is_far) {
  Vector change(to, Teuchos::Copy);
  change.update(-1.0, from, 1.0);
  const double moved = change.normInf();
  passed_ = moved / dt;
  if (!accepted_ || (moved <= far * length_ && !is_far) || passed_ <= much_faster * *accepted_) return;
  if (refused_ && passed_ <= same_rate * *refused_) return;
  refused_ = passed_;
  throw StepFailure(
      FailureKind::lost_contact,
      fmt::format("no equilibrium is near: a node moves by {:.3g} in a step of {:.3g}, {:.3g} times as fast as in the step before. The structure may "
                  "snap through or buckle; between two states at rest that are that far apart there is motion with inertia. Prescribe "
                  "the motion instead of the load, or end before",
                  moved, dt, passed_ / *accepted_));
}

void JumpCheck::accept() {
  accepted_ = passed_;
  refused_.reset();
}

void JumpCheck::serialize(StateArchive& archive) { mortise::serialize(archive, "jump_check.rate", accepted_); }

}  // namespace mortise
