#include "run/path/prescribed_velocity.hpp"

#include <fmt/format.h>

#include <Teuchos_CommHelpers.hpp>
#include <algorithm>
#include <cmath>
#include <vector>

namespace mortise {
namespace {

constexpr int samples_of_run = 64;
/// Share of the largest velocity that a difference of neighbouring slopes has at a stop, be it within a quarter; a smooth motion that is resolved has
/// less.
constexpr double jump = 0.4;

/// [times][dofs]; a function without a value there is reported by the step itself.
std::vector<std::vector<double>> values_at(const AffineConstraints& constraints, const std::vector<double>& times) {
  std::vector<std::vector<double>> values;
  std::optional<StepFailure> failure;
  for (const double time : times) values.push_back(constraints.prescribed_values(time, failure));
  return values;
}

}  // namespace

PrescribedVelocityGuard::PrescribedVelocityGuard(const Model& model, const Scene& scene, std::function<void(const std::string&)> warn)
    : model_(model), warn_(std::move(warn)) {
  const double dt = scene.stepping.end_time / samples_of_run;
  std::vector<double> times;
  for (int n = 0; n <= samples_of_run; ++n) times.push_back(n * dt);
  const auto values = values_at(*model.parts().constraints, times);
  double mine = 0.0;
  for (std::size_t n = 1; n < values.size(); ++n)
    for (std::size_t i = 0; i < values[n].size(); ++i) mine = std::max(mine, std::abs(values[n][i] - values[n - 1][i]) / dt);
  Teuchos::reduceAll(*model.mesh()->comm, Teuchos::REDUCE_MAX, mine, Teuchos::outArg(largest_));
}

RCP<Vector> PrescribedVelocityGuard::verify(const SemiSmoothSystem&, const AcceptedState& from, const SystemEvaluation& found, int) {
  if (is_said_ || largest_ == 0.0) return Teuchos::null;
  const double start = from.context.time, quarter = 0.25 * found.context().step->dt;
  std::vector<double> times;
  for (int n = start >= quarter ? -1 : 0; n <= 4; ++n) times.push_back(start + n * quarter);
  const auto values = values_at(*model_.parts().constraints, times);
  struct Jump {
    double size = 0.0, time = 0.0;
  } mine;
  for (std::size_t n = 2; n < values.size(); ++n)
    for (std::size_t i = 0; i < values[n].size(); ++i) {
      const double size = std::abs(values[n][i] - 2.0 * values[n - 1][i] + values[n - 2][i]) / quarter;
      if (size > mine.size) mine = {size, times[n - 1]};
    }
  const Communicator& comm = *model_.mesh()->comm;
  double size = 0.0;
  Teuchos::reduceAll(comm, Teuchos::REDUCE_MAX, mine.size, Teuchos::outArg(size));
  if (!(size > jump * largest_)) return Teuchos::null;
  const double my_time = mine.size == size ? mine.time : -1.0;
  double time = 0.0;
  Teuchos::reduceAll(comm, Teuchos::REDUCE_MAX, my_time, Teuchos::outArg(time));
  is_said_ = true;
  warn_(
      fmt::format("a prescribed velocity jumps by about {:.3g} at t = {:.3g}, where accelerations and forces of supports ring; please round the "
                  "function there, or take a smaller \"spectral radius\"",
                  size, time));
  return Teuchos::null;
}

void PrescribedVelocityGuard::serialize(StateArchive& archive) {
  int is_said = is_said_ ? 1 : 0;
  mortise::serialize(archive, "prescribed_velocity.is_said", is_said);
  is_said_ = is_said != 0;
}

}  // namespace mortise
