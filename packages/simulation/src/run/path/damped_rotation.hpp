#pragma once
// Energy that stiffness damping takes from bodies that turn.

#include <functional>
#include <string>

#include "mortise/simulation/model/model.hpp"
#include "run/stepping/step_guard.hpp"

namespace mortise {

/// Stiffness damping b K_0 is that of the reference orientation: K_0 v = 0 for the velocity of a rigid-body motion holds as long as a body has not
/// turned. With v_r the rigid part of the velocity of each deformable body it takes v_r . b K_0 v_r from motions that strain nothing. Warns once
/// where that sums up to a share of the largest kinetic energy.
class DampedRotationGuard final : public StepGuard {
 public:
  DampedRotationGuard(const Model& model, std::function<void(const std::string&)> warn) : model_(model), warn_(std::move(warn)) {}

  void accept(const SemiSmoothSystem& system, const SystemEvaluation& at) override;
  void serialize(StateArchive& archive) override;

 private:
  const Model& model_;
  std::function<void(const std::string&)> warn_;
  double taken_ = 0.0, largest_ = 0.0;  ///< [work] from rigid-body motions; kinetic energy
  bool is_said_ = false;
};

}  // namespace mortise
