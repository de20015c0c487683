#include "mortise/contact/formulation.hpp"

#include "mortise/contact/formulation/augmented_lagrange.hpp"
#include "mortise/contact/formulation/dual_mortar.hpp"
#include "mortise/contact/formulation/node_to_segment.hpp"
#include "mortise/contact/formulation/penalty.hpp"
#include "mortise/contact/formulation/standard_mortar.hpp"
#include "mortise/contact/formulation/variational_mortar.hpp"

namespace mortise {
void NodeToSegment::describe(Parameters& parameters) {
  parameters.add("passes", passes, {{"single", Passes::single}, {"two", Passes::two}},
                 "whether only slave nodes are kept from penetrating, or master nodes in a second pass as well");
}

void Penalty::describe(Parameters& parameters) {
  parameters.add(
      "discretisation", discretisation,
      {{"dual mortar", Coupling::dual_mortar}, {"standard mortar", Coupling::standard_mortar}, {"node to segment", Coupling::node_to_segment}},
      "what tractions act through");
  parameters.add("stiffness", normal,
                 Says("traction per penetration, over Young's modulus of the softer side over the shortest slave facet").unit("-").above(0.0));
  parameters.add("tangential stiffness", tangential, Says("the same per slip before sliding; default: `stiffness`").unit("-").above(0.0));
}

void AugmentedLagrange::describe(Parameters& parameters) {
  Penalty::describe(parameters);
  parameters.add(
      "tolerance", tolerance,
      Says("error of the multipliers over the largest one of the pair at which a step is done, as told from how they settle").unit("-").above(0.0));
  parameters.add("augmentations", augmentations, Says("updates of the multipliers after which the step is undone").at_least(1));
}

const Registry<Formulation>& formulation_registry() {
  static const Registry<Formulation> registry = [] {
    Registry<Formulation> formulations;
    formulations.add<DualMortar>("dual mortar", "mortar integrals, dual multipliers, which are condensed");
    formulations.add<StandardMortar>("standard mortar", "mortar integrals, multipliers interpolated like displacements, saddle point system");
    formulations.add<VariationalMortar>("variational mortar",
                                        "standard mortar whose normal forces are the gaps' derivatives and do no work while contact lasts; in the "
                                        "plane; saddle point system");
    formulations.add<NodeToSegment>("node to segment", "multipliers at slave nodes, saddle point system");
    formulations.add<Penalty>("penalty", "tractions in proportion to penetration and slip");
    formulations.add<AugmentedLagrange>("augmented lagrange", "penalty, its multipliers updated until nothing penetrates (Uzawa)");
    return formulations;
  }();
  return registry;
}

}  // namespace mortise
