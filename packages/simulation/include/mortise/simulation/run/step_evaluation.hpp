#pragma once
// Quantities and fields of an accepted step.

#include <optional>
#include <string>
#include <vector>

#include "mortise/nonlinear/semi_smooth_system.hpp"
#include "mortise/simulation/model/model.hpp"
#include "mortise/simulation/quantities/contact_profile.hpp"
#include "mortise/simulation/quantities/fields.hpp"
#include "mortise/simulation/run/quantity_evaluators.hpp"

namespace mortise {

/// Evaluates what a scene wants to know of the states of one run. Collective in all members.
class StepEvaluation {
 public:
  /// Throws InputError, on all ranks, for sets, bodies and pairs of quantities that do not exist.
  StepEvaluation(const Scene& scene, const Model& model, SemiSmoothSystem& system);

  std::vector<std::string> names() const;
  /// In the order of names(), at x and pseudo-time `time`. To be asked once for each accepted step: some quantities sum up over the steps.
  std::vector<double> quantities(const Vector& x, double time);
  std::vector<Field> fields(const Vector& x, const std::vector<std::string>& names);
  /// The points along the slave surface of each pair, on rank 0.
  std::vector<std::vector<ProfilePoint>> profiles(const Vector& x);

 private:
  double force_round_off(const Vector& displacement) const;
  RCP<Vector> local(const Vector& displacement) const;
  std::optional<ContactLaws> contact_laws(const Vector& x) const;

  const Scene& scene_;
  const Model& model_;
  SemiSmoothSystem& system_;
  QuantityEvaluators evaluators_;
  std::vector<ContactProfile> profiles_;
};

}  // namespace mortise
