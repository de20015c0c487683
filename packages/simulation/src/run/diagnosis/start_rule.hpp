#pragma once
// Choice of nodes that start a step closed although they do not touch.

#include <functional>
#include <string>
#include <vector>

#include "mortise/simulation/model/model.hpp"
#include "run/stepping/step_guard.hpp"

namespace mortise {

/// A body that bears a load along a motion that nothing holds has a singular system. Nodes that hinder the motion start closed: those of all pairs
/// that are near to contact, at least the nearest. This changes the guess of multipliers and nothing else. A motion without a load needs no node: see
/// motions_without_load().
class StartRule final : public StepGuard {
 public:
  /// @param say  gets a line for each pair of which nodes start closed: which, and why. On every rank
  StartRule(const Model& model, std::vector<int> bodies, double momentum_tolerance, std::function<void(const std::string&)> say);

  RCP<Vector> close(const SemiSmoothSystem& system, const SystemEvaluation& start) override;

 private:
  const Model& model_;
  std::vector<int> bodies_;
  double tolerance_;
  std::function<void(const std::string&)> say_;
};

}  // namespace mortise
