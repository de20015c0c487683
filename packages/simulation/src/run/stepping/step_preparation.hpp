#pragma once
// Contact at the start of a step: crossings of edges, clearances, and the overlap that is left.

#include "mortise/nonlinear/semi_smooth_system.hpp"
#include "mortise/simulation/model/model.hpp"

namespace mortise {

/// An overlap at the start is taken up by the end of the first step unless a pair says when. A try that is cut short takes up its share, as if the
/// bodies were moved into one another.
class StepPreparation {
 public:
  StepPreparation(const Model& model, const Scene& scene, const SemiSmoothSystem& system);

  /// A state with what edges and clearances are at its time or a later one. Collective.
  AcceptedState prepared(AcceptedState state, double time) const;
  /// StepStart of the load stepper. Collective.
  StepContext start(const AcceptedState& from, double time, const Vector& d, Vector& z) const;
  /// Whether bodies are still pushed apart in a step that starts at a time: such a motion does not go on. Predicted, it would let all nodes of a
  /// press fit slip.
  bool is_pushed_apart(double time) const { return begins_pressed_ && time < taken_up_; }

 private:
  const Model& model_;
  const Scene& scene_;
  const SemiSmoothSystem& system_;
  double taken_up_;
  bool begins_pressed_;
};

}  // namespace mortise
