#include "mortise/contact/contact_pair.hpp"

namespace mortise {

namespace {
/// The list "formulation" of a pair.
struct FormulationList {
  Choice<Formulation>& formulation;
  void describe(Parameters& parameters) { parameters.choose(formulation, formulation_registry(), "discretisation and enforcement of contact"); }
};
/// The list "friction" of a pair.
struct FrictionList {
  Choice<FrictionLaw>& friction;
  void describe(Parameters& parameters) { parameters.choose(friction, friction_registry(), "the friction law"); }
};
}  // namespace

void ContactOptions::describe(Parameters& parameters) {
  parameters.add("geometry", geometry, {{"current", ContactGeometry::current}, {"reference", ContactGeometry::reference}},
                 "configuration that carries the contact geometry: current, or reference for small displacements");
  parameters.add("full cover", full_cover,
                 Says("covered share of a facet below which the multiplier of a slave node is tied to those of its neighbours. A sliver of contact "
                      "then bears no peak. 0: none is tied, as in most published computations; penalty ties none")
                     .unit("-")
                     .at_least(0.0)
                     .at_most(1.0));
  parameters.add("clearance", clearance,
                 Says("length that is added to the gap of the meshes, of t and the reference position of a slave node. Below 0 it is an "
                      "interference, which a function of t applies bit by bit. Needs the gap weighting \"dual\"")
                     .unit("length"));
  parameters.add("complementarity constant", complementarity_constant,
                 Says("c_n times A_j: weighs gap against pressure in the choice of the active set; changes no solution; default: Young's modulus "
                      "of the softer side over the shortest slave facet, of penalty, pressure overclosure and augmented Lagrange a tenth of that; "
                      "allowed: 1e-4 to 1e4 times that ratio")
                     .unit("stress / length")
                     .above(0.0));
  mortar.describe(parameters);
  FormulationList formulation_list{formulation};
  parameters.list("formulation", formulation_list, "discretisation and enforcement of contact");
  FrictionList list{friction};
  parameters.list("friction", list, "shear tractions of closed nodes");
}

}  // namespace mortise
