#pragma once
// Quantities and fields of an accepted step.

#include <optional>
#include <string>
#include <vector>

#include "mortise/nonlinear/semi_smooth_system.hpp"
#include "mortise/simulation/model/model.hpp"
#include "mortise/simulation/quantities/contact_profile.hpp"
#include "mortise/simulation/quantities/fields.hpp"
#include "mortise/simulation/run/output/quantity_evaluators.hpp"

namespace mortise {

/// Evaluates what a scene wants to know of the states of one run. Collective in all members.
class StepEvaluation {
 public:
  /// Throws InputError, on all ranks, for sets, bodies and pairs of quantities that do not exist.
  StepEvaluation(const Scene& scene, const Model& model, const SemiSmoothSystem& system);

  std::vector<std::string> names() const;
  /// In the order of names(). To be asked once for each accepted step: some quantities sum up over the steps.
  std::vector<double> quantities(const SystemEvaluation& at);
  /// f_ext of all loads on owned dofs. Throws StepFailure on every rank.
  RCP<Vector> external_force(const Vector& x, double time) const;
  std::vector<Field> fields(const SystemEvaluation& at, const std::vector<std::string>& names);
  /// Stores or restores what the quantities remember of the steps.
  void serialize(StateArchive& archive);
  /// The points along the slave surface of each pair, on rank 0.
  std::vector<std::vector<ProfilePoint>> profiles(const SystemEvaluation& at);

 private:
  double force_round_off(const Vector& displacement) const;
  const ContactLaws* contact_laws(const SystemEvaluation& at) const;
  RCP<Vector> local(const Vector& displacement) const;
  /// Of springs on owned dofs, as it is in balance; null: there are none.
  RCP<Vector> spring_force(const SystemEvaluation& at) const;

  const Scene& scene_;
  const Model& model_;
  const SemiSmoothSystem& system_;
  QuantityEvaluators evaluators_;
  std::vector<ContactProfile> profiles_;
  double last_time_ = 0.0;  ///< at which quantities were evaluated
  bool has_begun_ = false;  ///< quantities of a step were evaluated
};

}  // namespace mortise
