// Variation of the contact pressure along the surface.

#include <cmath>

#include "mortise/simulation/quantities/quantity_support.hpp"

namespace mortise {

std::unique_ptr<QuantityEvaluator> PressureVariation::make_evaluator(const QuantityContext& context) const {
  return evaluator_of([of_pair = find_pair_of_plane(context, pair)](const QuantityContext& at) {
    double variation = 0.0;
    for (const PressedFacet& facet : pressed_facets(at, of_pair)) variation += std::abs(facet.pressure[1] - facet.pressure[0]);
    return sum_over_ranks(at.mesh(), variation);
  });
}

void add_pressure_variation(Registry<Quantity>& kinds) {
  kinds.add<PressureVariation>("pressure variation", "total variation of the nodal contact pressures along the slave surface of a pair");
}

}  // namespace mortise
