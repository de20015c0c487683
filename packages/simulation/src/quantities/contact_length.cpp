// The length of a contact zone.

#include "mortise/simulation/quantities/quantity_support.hpp"

namespace mortise {

std::unique_ptr<QuantityEvaluator> ContactLength::make_evaluator(const QuantityContext& context) const {
  return evaluator_of([of_pair = find_pair_of_plane(context, pair)](const QuantityContext& at) {
    double length = 0.0;
    for (const PressedFacet& facet : pressed_facets(at, of_pair)) length += 0.5 * facet.length() * (int(facet.closed[0]) + int(facet.closed[1]));
    return sum_over_ranks(at.mesh(), length);
  });
}

void add_contact_length(Registry<Quantity>& kinds) {
  kinds.add<ContactLength>("contact length", "length of the slave surface, where the pair's geometry is, that belongs to closed nodes");
}

}  // namespace mortise
