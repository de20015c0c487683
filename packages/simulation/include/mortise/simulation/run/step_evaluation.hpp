#pragma once
// Quantities and fields of an accepted step.

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "mortise/nonlinear/semi_smooth_system.hpp"
#include "mortise/simulation/model/model.hpp"
#include "mortise/simulation/quantities/contact_profile.hpp"
#include "mortise/simulation/quantities/fields.hpp"

namespace mortise {

/// Evaluates what a scene wants to know of a state. Collective in all members.
class StepEvaluation {
 public:
  /// Prepares the quantities. Throws InputError on all ranks for sets, bodies and pairs that do not exist.
  StepEvaluation(const Scene& scene, const Model& model, const SemiSmoothSystem& system);

  std::vector<std::string> names() const;
  /// In the order of names(), of an accepted step.
  std::vector<double> quantities(const SystemEvaluation& at);
  std::vector<Field> fields(const SystemEvaluation& at, const std::vector<std::string>& names);
  /// The points along the slave surface of each pair, on rank 0.
  std::vector<std::vector<ProfilePoint>> profiles(const SystemEvaluation& at);

 private:
  QuantityContext context() const;
  double force_round_off(const Vector& displacement) const;
  const ContactLaws* contact_laws(const SystemEvaluation& at) const;
  RCP<Vector> local(const Vector& displacement) const;

  const Scene& scene_;
  const Model& model_;
  const SemiSmoothSystem& system_;
  std::vector<ContactProfile> profiles_;
};

}  // namespace mortise
