#pragma once
// What stabilisation has taken, at the end of a run.

#include <functional>
#include <string>

#include "mortise/simulation/model/model.hpp"
#include "run/stepping/step_guard.hpp"

namespace mortise {

/// Says at the end what viscous stabilisation has taken, and warns where that is more than a share of the energy in bodies and springs: then the way
/// to the end may have been another one, which friction and plasticity remember. The last state has no viscous forces.
class StabilisationWatch final : public StepGuard {
 public:
  using Say = std::function<void(const std::string&)>;
  StabilisationWatch(const Model& model, Say say, Say warn) : model_(model), say_(std::move(say)), warn_(std::move(warn)) {}

  std::optional<StepFailure> end(const SemiSmoothSystem& system, const EndOfSteps& end) override;

 private:
  const Model& model_;
  Say say_, warn_;
};

}  // namespace mortise
