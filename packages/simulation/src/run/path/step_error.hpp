#pragma once
// Local error of steps of time.

#include <optional>

#include "run/stepping/step_guard.hpp"

namespace mortise {

/// Chooses the length of steps by their local error (Zienkiewicz, Xie 1991),
///
///     e = |beta - 1/6| h^2 max |a_(n+1) - a_n| / max |u|,   next h = h clamp(0.9 (tolerance / e)^(1/3), 1/2, 2),
///
/// over dofs with mass; max |u| is the largest displacement so far. A step with e > tolerance is undone.
class StepErrorGuard final : public StepGuard {
 public:
  explicit StepErrorGuard(double tolerance) : tolerance_(tolerance) {}

  /// @throws StepFailure(step_error) on every rank
  RCP<Vector> verify(const SemiSmoothSystem& system, const AcceptedState& from, const SystemEvaluation& found, int round) override;
  std::optional<double> growth() const override { return growth_; }
  void accept(const SemiSmoothSystem& system, const SystemEvaluation& at) override;
  void serialize(StateArchive& archive) override;

 private:
  double tolerance_;
  double largest_ = 0.0;  ///< displacement of accepted states
  double growth_ = 1.0;   ///< of what was verified last
};

}  // namespace mortise
