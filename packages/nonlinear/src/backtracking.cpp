#include "backtracking.hpp"

#include <NOX_Solver_Generic.H>

#include "semi_smooth_newton_group.hpp"

namespace mortise::detail {

bool Backtracking::compute(NOX::Abstract::Group& group, double& step, const NOX::Abstract::Vector& direction, const NOX::Solver::Generic& solver) {
  constexpr double sufficient_decrease = 1e-4;
  auto& iterate = dynamic_cast<SemiSmoothNewtonGroup&>(group);
  const NOX::Abstract::Group& before = solver.getPreviousSolutionGroup();
  for (step = 1.0; step >= smallest_step_length; step *= 0.5) {
    iterate.computeX(before, direction, step);
    iterate.computeF();
    if (iterate.getNormF() <= (1.0 - sufficient_decrease * step) * before.getNormF() || is_below_tolerances(iterate.norms())) return true;
  }
  if (iterate.failure()) throw *iterate.failure();
  step = 0.0;
  return false;
}

bool Backtracking::is_below_tolerances(const ResidualNorms& norms) const {
  return norms.finite && (norms.momentum <= options_.momentum_tolerance || norms.momentum_absolute <= norms.round_off) &&
         norms.gap <= options_.gap_tolerance && norms.complementarity <= options_.complementarity_tolerance &&
         norms.prescribed <= options_.increment_tolerance;
}

}  // namespace mortise::detail
