// The area of a contact zone.

#include "mortise/simulation/quantities/quantity_support.hpp"

namespace mortise {

// Half a facet from x_1 on has the area depth((3 x_1 + x_2)/4) length/2, as depth is linear in the radius.
std::unique_ptr<QuantityEvaluator> ContactArea::make_evaluator(const QuantityContext& context) const {
  return evaluator_of([of_pair = find_pair(context, pair)](const QuantityContext& at) {
    double area = 0.0;
    if (at.mesh().dimension == 3) {
      for (const auto& state : node_states(*at.laws, of_pair)) area += state.closed ? state.covered : 0.0;
      return sum_over_ranks(at.mesh(), area);
    }
    for (const PressedFacet& facet : pressed_facets(at, of_pair))
      for (int end = 0; end < 2; ++end)
        if (facet.closed[end]) area += 0.5 * facet.length() * at.bodies.depth(0.75 * facet.position[end][0] + 0.25 * facet.position[1 - end][0]);
    return sum_over_ranks(at.mesh(), area);
  });
}

void add_contact_area(Registry<Quantity>& kinds) {
  kinds.add<ContactArea>("contact area", "area of the slave surface, where the pair's geometry is, that belongs to closed nodes");
}

}  // namespace mortise
