#pragma once
// Quantities of a scene from the results of another program.

#include <vector>

#include "mortise/simulation/model/model.hpp"
#include "mortise/simulation/quantities/contact_profile.hpp"
#include "mortise/simulation/quantities/quantity_kinds.hpp"
#include "mortise/simulation/run/output/quantity_evaluators.hpp"
#include "peer/calculix_results.hpp"

namespace mortise {

/// The end state that CalculiX found, on the model's mesh. The contact of the model is evaluated at its displacement: normals and surfaces are ours,
/// pressures at the slave nodes are theirs; shears, whose directions they do not say, are 0.
class PeerEvaluation {
 public:
  PeerEvaluation(const Scene& scene, const Model& model, const CalculixResults& results);
  ~PeerEvaluation();

  /// In the order of the scene; not a number for what cannot be had: energies, stresses, shears, what has to be followed over the steps.
  /// @param evaluators  new ones of the scene
  std::vector<double> quantities(const QuantityEvaluators& evaluators) const;

  /// Slave surfaces with the pressures, of each pair.
  std::vector<std::vector<ProfilePoint>> profiles() const;

 private:
  QuantityContext context() const;
  void read_displacement(const CalculixResults& results);
  void read_pressure(const CalculixResults& results);
  void read_forces(const CalculixResults& results);
  double evaluate(const Quantity& quantity, QuantityEvaluator& evaluator, const QuantityContext& context) const;
  double contact_force(const ContactForce& quantity, const QuantityContext& context) const;

  const Scene& scene_;
  const Model& model_;
  RCP<Vector> displacement_, local_displacement_, nodal_force_, external_, reaction_;
  std::optional<ContactLaws> laws_;  ///< none without contact
};

}  // namespace mortise
