#include "newton/backtracking.hpp"

#include <NOX_Solver_Generic.H>

#include <algorithm>
#include <cmath>

#include "newton/semi_smooth_newton_group.hpp"

namespace mortise::detail {
namespace {
constexpr double sufficient_decrease = 1e-4;

/// Share of the longest step below which none is taken where the longest one changes states.
constexpr double shortest_beside_kinks = 1.0 / 32.0;

/// Steps in a row that are shortened with nodes in contact; the next one is not.
constexpr int most_shortened = 3;
}  // namespace

bool Backtracking::compute(NOX::Abstract::Group& group, double& step, const NOX::Abstract::Vector& direction, const NOX::Solver::Generic& solver) {
  auto& iterate = dynamic_cast<SemiSmoothNewtonGroup&>(group);
  const auto& before = dynamic_cast<const SemiSmoothNewtonGroup&>(solver.getPreviousSolutionGroup());
  const auto try_step = [&](double length) {
    step = length;
    iterate.computeX(before, direction, step);
    iterate.computeF();
    return std::isfinite(iterate.getNormF());
  };
  const bool is_stuck = shortened_ == most_shortened || before.starts_elsewhere();
  double longest = 0.0, shortest = smallest_step_length;  // that can be evaluated; that is worth taking
  bool changes_states = false;                            // the longest
  for (double length = 1.0; length >= shortest; length *= 0.5) {
    if (!try_step(length)) continue;
    if (longest == 0.0) {
      longest = length;
      changes_states = iterate.norms().active_set != before.norms().active_set;
      if (changes_states) shortest = std::max(shortest, shortest_beside_kinks * longest);
    }
    if (!falls(before.norms(), iterate.norms(), sufficient_decrease * length) && !is_stuck && !is_below_tolerances(iterate.norms())) continue;
    shortened_ = length < longest && iterate.norms().active > 0 ? shortened_ + 1 : 0;
    return true;
  }
  if (iterate.failure()) throw *iterate.failure();
  shortened_ = 0;
  if (longest > 0.0 && try_step(longest) && (changes_states || iterate.increment() <= longest * negligible_correction(options_, length_)))
    return true;
  step = 0.0;
  return false;
}

bool Backtracking::falls(const ResidualNorms& before, const ResidualNorms& now, double share) const {
  if (now.fields.empty()) return now.merit <= (1.0 - share) * before.merit;
  double old_squares = 0.0, new_squares = 0.0;
  for (std::size_t field = 0; field < now.fields.size(); ++field) {
    const double size = std::max(before.fields[field].reference, now.fields[field].reference);
    if (size == 0.0) continue;
    old_squares += std::pow(before.fields[field].merit / size, 2);
    new_squares += std::pow(now.fields[field].merit / size, 2);
  }
  const FieldMerit &old_first = before.fields.front(), &new_first = now.fields.front();
  const bool is_out_of_balance = old_first.merit > options_.momentum_tolerance * std::max(old_first.reference, new_first.reference);
  return (is_out_of_balance && new_first.merit <= (1.0 - share) * old_first.merit) || new_squares <= std::pow(1.0 - share, 2) * old_squares;
}

bool Backtracking::is_below_tolerances(const ResidualNorms& norms) const {
  return norms.finite && (norms.momentum <= options_.momentum_tolerance || norms.momentum_absolute <= norms.round_off) &&
         norms.gap <= options_.gap_tolerance && norms.complementarity <= options_.complementarity_tolerance &&
         norms.prescribed <= options_.increment_tolerance;
}

}  // namespace mortise::detail
