#pragma once
// Choice of the length of a step along a Newton direction.

#include <NOX_LineSearch_Generic.H>
#include <NOX_LineSearch_UserDefinedFactory.H>

#include "mortise/nonlinear/newton_solver.hpp"

namespace mortise::detail {

/// Least share of a Newton direction that is taken. A semi-smooth step that has to be shorter leads nowhere: a smaller load step is cheaper.
constexpr double smallest_step_length = 1.0 / 1024.0;

/// A correction below it tells nothing about a displacement: a tenth of its tolerance. `length`: size of the model.
inline double negligible_correction(const NewtonOptions& options, double length) { return 0.1 * options.increment_tolerance * length; }

/// Halves a step until the merit m falls: m(x + lambda dx) <= (1 - 1e-4 lambda) m(x). An iterate that cannot be evaluated counts as infinite; one
/// whose residual is below all tolerances is taken, as what is left of it is round-off. The merit has kinks where contact changes its state or
/// friction its direction. Beside one of them it may rise along any step or fall by next to nothing. To get away from there, the longest step that
/// can be evaluated is taken in three cases:
/// * it changes states, and no step of 1/32 of it or more makes the merit fall;
/// * three steps in a row were shortened with nodes in contact;
/// * no step makes the merit fall, and the longest is negligible: the merit jumps there, and whether it is small enough is not asked here.
///
/// Several fields have no common unit. Heat that friction sets free appears at once where contact begins to slip, however well momentum is in
/// balance: it may not stop a step that leads motion to balance. So a step may be taken in two cases:
/// * the merit m_0 of the first field is above its tolerance, and falls;
/// * sum_f (m_f / S_f)^2 falls, with S_f the larger of the references of both iterates.
class Backtracking : public NOX::LineSearch::Generic {
 public:
  Backtracking(const NewtonOptions& options, double length) : options_(options), length_(length) {}

  /// @returns false, and a step of 0, where no step makes the merit fall and the longest is not taken either
  /// @throws StepFailure where the smallest one cannot be evaluated
  bool compute(NOX::Abstract::Group& group, double& step, const NOX::Abstract::Vector& direction, const NOX::Solver::Generic& solver) override;

 private:
  /// m falls from `before` to `now` by `share` of itself or more.
  bool falls(const ResidualNorms& before, const ResidualNorms& now, double share) const;
  bool is_below_tolerances(const ResidualNorms& norms) const;

  NewtonOptions options_;
  double length_;
  int shortened_ = 0;  ///< steps in a row, with nodes in contact
};

class BacktrackingFactory : public NOX::LineSearch::UserDefinedFactory {
 public:
  BacktrackingFactory(const NewtonOptions& options, double length) : options_(options), length_(length) {}
  Teuchos::RCP<NOX::LineSearch::Generic> buildLineSearch(const Teuchos::RCP<NOX::GlobalData>&, Teuchos::ParameterList&) const override {
    return Teuchos::rcp(new Backtracking(options_, length_));
  }

 private:
  NewtonOptions options_;
  double length_;
};

}  // namespace mortise::detail
