#pragma once
// Local error of the temperature in steps of time.

#include <optional>
#include <vector>

#include "mortise/simulation/model/model.hpp"
#include "mortise/simulation/scene/scene.hpp"
#include "run/stepping/step_guard.hpp"

namespace mortise {

/// Chooses the length of steps by the local error of the temperature. With the mean rates m of the steps,
///
///     backward Euler:  e = max h^2 |theta''| / 2 = h |m_n - m_(n-1)| / 2,
///     trapezoidal:     e = max h^3 |theta'''| / 12,   theta''' / 2 the divided difference of m_n, m_(n-1), m_(n-2) at the middles of the steps,
///
/// over nodes whose temperature is not prescribed and over the range of temperatures. The range has all temperatures so far. It has those that are
/// prescribed, and those of surroundings and rigid bodies, at the start and the end. It is 1 % of the largest of them or more. Heat of contact counts
/// at the end of a step: with it the trapezoidal rule is of first order.
///
/// next h = h clamp(0.9 (tolerance / e)^(1/(p+1)), 1/2, 2) with the order p. A step with e > tolerance is undone. The first steps of the trapezoidal
/// rule take the error of backward Euler, which is larger.
class HeatErrorGuard final : public StepGuard {
 public:
  HeatErrorGuard(const Model& model, const Scene& scene);

  /// @throws StepFailure(step_error) on every rank
  RCP<Vector> verify(const SemiSmoothSystem& system, const AcceptedState& from, const SystemEvaluation& found, int round) override;
  std::optional<double> growth() const override { return growth_; }
  void accept(const SemiSmoothSystem& system, const SystemEvaluation& at) override;
  void serialize(StateArchive& archive) override;

 private:
  /// The mean rate of a step.
  struct Step {
    double length = 0.0;
    RCP<Vector> rate;
  };
  double error(const Step& last, const Step& before, const Step* first) const;
  double range(const Vector& unknowns, double& lowest, double& highest) const;

  const Model& model_;
  double tolerance_;
  int order_;
  std::vector<LocalOrdinal> rows_;  ///< of temperatures, owned
  std::vector<char> is_free_;       ///< [rows_]
  double lowest_, highest_;         ///< of all states
  std::vector<Step> steps_;         ///< the last accepted ones, newest first; at most two
  Step found_;                      ///< of what was verified last
  double growth_ = 1.0;
};

}  // namespace mortise
