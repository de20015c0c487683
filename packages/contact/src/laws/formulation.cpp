#include "mortise/contact/formulation.hpp"

#include "mortise/contact/formulation/augmented_lagrange.hpp"
#include "mortise/contact/formulation/dual_mortar.hpp"
#include "mortise/contact/formulation/node_to_segment.hpp"
#include "mortise/contact/formulation/penalty.hpp"
#include "mortise/contact/formulation/pressure_overclosure.hpp"
#include "mortise/contact/formulation/standard_mortar.hpp"
#include "mortise/contact/formulation/variational_mortar.hpp"

namespace mortise {
const Registry<Formulation>& formulation_registry() {
  static const Registry<Formulation> registry = [] {
    Registry<Formulation> formulations;
    formulations.add<DualMortar>("dual mortar", "mortar integrals, dual multipliers, which are condensed");
    formulations.add<StandardMortar>("standard mortar", "mortar integrals, multipliers interpolated like displacements, saddle point system");
    formulations.add<VariationalMortar>(
        "variational mortar",
        "standard mortar whose normal forces are the gaps' derivatives and do no work while contact lasts; in 2D; saddle point system");
    formulations.add<NodeToSegment>("node to segment", "multipliers at slave nodes, saddle point system");
    formulations.add<Penalty>("penalty", "tractions in proportion to penetration and slip");
    formulations.add<AugmentedLagrange>("augmented lagrange", "penalty, its multipliers updated until nothing penetrates (Uzawa)");
    formulations.add<PressureOverclosure>("pressure overclosure", "pressures that are a given function of the mean gap");
    return formulations;
  }();
  return registry;
}

}  // namespace mortise
