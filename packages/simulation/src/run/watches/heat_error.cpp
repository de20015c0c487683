#include "run/watches/heat_error.hpp"

#include <fmt/format.h>

#include <Tpetra_Map.hpp>
#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <cmath>
#include <limits>

#include "model/heat/heat_of_scene.hpp"
#include "mortise/core/guarded_value.hpp"
#include "mortise/core/over_ranks.hpp"

namespace mortise {
namespace {

/// The least range, over the largest temperature: heat that flows in or is made has no temperature of its own, and no range is there at the start.
constexpr double least_range = 0.01;

}  // namespace

HeatErrorGuard::HeatErrorGuard(const Model& model, const Scene& scene)
    : model_(model),
      tolerance_(*scene.heat.error_tolerance),
      order_(scene.heat.integration == HeatOptions::Integration::trapezoidal && !model.heat().contact ? 2 : 1),
      lowest_(std::numeric_limits<double>::infinity()),
      highest_(-lowest_) {
  const FieldRows& rows = model.space().rows(model.heat().bodies->temperature());
  const std::vector<LocalOrdinal>& prescribed = model.parts().constraints->prescribed();
  for (LocalOrdinal node = 0; node < model.mesh()->owned_count(); ++node) {
    if (!rows.lives(node)) continue;
    rows_.push_back(rows(node, 0));
    is_free_.push_back(std::binary_search(prescribed.begin(), prescribed.end(), rows(node, 0)) ? 0 : 1);
  }
  const auto see = [&](double value) {
    if (std::isfinite(value)) lowest_ = std::min(lowest_, value), highest_ = std::max(highest_, value);
  };
  std::optional<StepFailure> failure;  // said when the step is tried
  for (const double time : {0.0, scene.stepping.end_time}) {
    for (const double value : model.heat().prescribed->values(time, failure)) see(value);
    for (const ScalarFunction* around : temperatures_around(scene)) {
      const bool is_one = !around->depends_on(1) && !around->depends_on(2) && !around->depends_on(3);  // else surfaces see other values
      if (is_one) see(value_or_nan(*around, {time, 0.0, 0.0, 0.0}));
    }
  }
}

double HeatErrorGuard::error(const Step& last, const Step& before, const Step* first) const {
  const auto m_last = last.rate->getLocalViewHost(Tpetra::Access::ReadOnly), m_before = before.rate->getLocalViewHost(Tpetra::Access::ReadOnly);
  const double h = last.length;
  double mine = 0.0;
  if (first == nullptr) {
    for (std::size_t n = 0; n < rows_.size(); ++n)
      if (is_free_[n] != 0) mine = std::max(mine, 0.5 * h * std::abs(m_last(rows_[n], 0) - m_before(rows_[n], 0)));
  } else {
    const auto m_first = first->rate->getLocalViewHost(Tpetra::Access::ReadOnly);
    const double to_before = 0.5 * (last.length + before.length), to_first = 0.5 * (before.length + first->length);
    for (std::size_t n = 0; n < rows_.size(); ++n) {
      if (is_free_[n] == 0) continue;
      const LocalOrdinal row = rows_[n];
      const double change = (m_last(row, 0) - m_before(row, 0)) / to_before - (m_before(row, 0) - m_first(row, 0)) / to_first;
      mine = std::max(mine, h * h * h / 6.0 * std::abs(change / (to_before + to_first)));
    }
  }
  return most_over_ranks(*model_.mesh()->comm, mine);
}

double HeatErrorGuard::range(const Vector& unknowns, double& lowest, double& highest) const {
  const auto theta = unknowns.getLocalViewHost(Tpetra::Access::ReadOnly);
  double least = lowest, most = highest;
  for (const LocalOrdinal row : rows_) {
    least = std::min(least, theta(row, 0));
    most = std::max(most, theta(row, 0));
  }
  highest = most_over_ranks(*model_.mesh()->comm, most);
  lowest = -most_over_ranks(*model_.mesh()->comm, -least);
  return highest - lowest;
}

RCP<Vector> HeatErrorGuard::verify(const SemiSmoothSystem& system, const AcceptedState& from, const SystemEvaluation& found, int) {
  const RCP<const Vector> before = system.unknowns(*from.x), now = system.unknowns(found.x());
  found_.length = found.context().time - from.context.time;
  found_.rate = rcp(new Vector(now->getMap()));
  found_.rate->update(1.0 / found_.length, *now, -1.0 / found_.length, *before, 0.0);
  double lowest = lowest_, highest = highest_;
  range(*before, lowest, highest);
  double size = range(*now, lowest, highest);
  size = std::max(size, least_range * std::max({1.0, std::abs(lowest), std::abs(highest)}));
  const Step at_rest{found_.length, rcp(new Vector(now->getMap()))};
  const bool has_two = order_ == 2 && steps_.size() == 2;
  const double e = error(found_, steps_.empty() ? at_rest : steps_[0], has_two ? &steps_[1] : nullptr);
  growth_ = e > 0.0 ? std::clamp(0.9 * std::pow(tolerance_ * size / e, has_two ? 1.0 / 3.0 : 0.5), 0.5, 2.0) : 2.0;
  if (e > tolerance_ * size)
    throw StepFailure(FailureKind::step_error,
                      fmt::format("the local error of the temperature is {:.3g}, {:.3g} of the range of temperatures; allowed is an \"error "
                                  "tolerance\" of {:.3g}; where the first step fails, please begin with a smaller \"step\"",
                                  e, e / size, tolerance_));
  return Teuchos::null;
}

void HeatErrorGuard::accept(const SemiSmoothSystem& system, const SystemEvaluation& at) {
  range(*system.unknowns(at.x()), lowest_, highest_);
  if (found_.rate.is_null()) return;
  steps_.insert(steps_.begin(), std::move(found_));
  if (steps_.size() > 2) steps_.pop_back();
  found_ = {};
}

void HeatErrorGuard::serialize(StateArchive& archive) {
  mortise::serialize(archive, "heat_error.lowest", lowest_);
  mortise::serialize(archive, "heat_error.highest", highest_);
  int count = static_cast<int>(steps_.size());
  mortise::serialize(archive, "heat_error.steps", count);
  archive.refuse_if(count < 0 || count > 2 ? std::optional(fmt::format("\"heat_error.steps\" is {}; allowed: 0 to 2", count)) : std::nullopt);
  steps_.resize(static_cast<std::size_t>(count));
  for (int n = 0; n < count; ++n) {
    Step& step = steps_[static_cast<std::size_t>(n)];
    if (step.rate.is_null()) step.rate = rcp(new Vector(model_.parts().dofs));
    mortise::serialize(archive, fmt::format("heat_error.length.{}", n), step.length);
    mortise::serialize(archive, fmt::format("heat_error.rate.{}", n), "dofs", *step.rate);
  }
}

}  // namespace mortise
