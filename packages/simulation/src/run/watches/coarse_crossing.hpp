#pragma once
// Edges that cross and press on one another over less than the mesh resolves.

#include <functional>
#include <string>

#include "mortise/simulation/model/model.hpp"
#include "run/stepping/step_guard.hpp"

namespace mortise {

/// Has the crossings of edges examined in each solution, for a model that has edges.
class CrossingExamination final : public StepGuard {
 public:
  explicit CrossingExamination(const Model& model) : model_(model) {}

  /// @throws StepFailure on every rank, as EdgeContact::examine() says
  RCP<Vector> verify(const SemiSmoothSystem& system, const AcceptedState& from, const SystemEvaluation& found, int round) override;

 private:
  const Model& model_;
};

/// Says of which crossings that is so at the end of a run, for a model that has edges.
class CoarseCrossingWatch final : public StepGuard {
 public:
  /// @param warn  gets one line for each of them
  CoarseCrossingWatch(const Model& model, const Scene& scene, std::function<void(const std::string&)> warn)
      : model_(model), scene_(scene), warn_(std::move(warn)) {}

  std::optional<StepFailure> end(const SemiSmoothSystem& system, const EndOfSteps& end) override;

 private:
  const Model& model_;
  const Scene& scene_;
  std::function<void(const std::string&)> warn_;
};

}  // namespace mortise
