// The traction of a pair at a place, or where it is largest.

#include <algorithm>
#include <array>

#include "mortise/simulation/quantities/quantity_support.hpp"

namespace mortise {
namespace {

/// At both ends.
std::array<double, 2> part_of(const PressedFacet& facet, ContactTraction::Part part) {
  using Part = ContactTraction::Part;
  if (part == Part::pressure) return facet.pressure;
  if (part == Part::shear) return facet.shear;
  const std::size_t axis = part == Part::x ? 0 : 1;
  return {facet.traction[0][axis], facet.traction[1][axis]};
}

}  // namespace

void ContactTraction::describe(Parameters& parameters) {
  PairQuantity::describe(parameters);
  parameters.add("x", x, Says("position on the slave surface; left out: the traction of largest size").unit("length"));
  parameters.add("part", part, {{"pressure", Part::pressure}, {"shear", Part::shear}, {"x", Part::x}, {"y", Part::y}},
                 "part of the traction of slave on master: along or across the current normal of the slave surface, or along an axis");
  describe_measure(parameters, measure);
}

std::unique_ptr<QuantityEvaluator> ContactTraction::make_evaluator(const QuantityContext& context) const {
  return evaluator_of([quantity = *this, of_pair = find_pair_of_plane(context, pair)](const QuantityContext& at) {
    double sum = 0.0, count = 0.0, largest = 0.0, smallest = 0.0;
    for (const PressedFacet& facet : pressed_facets(at, of_pair, quantity.measure)) {
      const std::array<double, 2> values = part_of(facet, quantity.part);
      for (const double value : values) largest = std::max(largest, value), smallest = std::min(smallest, value);
      const double a = facet.position[0][0], b = facet.position[1][0];
      if (!quantity.x || a == b || !(std::min(a, b) <= *quantity.x && *quantity.x <= std::max(a, b))) continue;
      const double share = (*quantity.x - a) / (b - a);
      sum += (1.0 - share) * values[0] + share * values[1];
      count += 1.0;
    }
    const Mesh& mesh = at.mesh();
    if (!quantity.x) {
      largest = largest_over_ranks(mesh, largest);
      smallest = -largest_over_ranks(mesh, -smallest);
      // Of a symmetric state both are of one size but for round-off: the positive one.
      return largest >= -smallest * (1.0 - same_but_for_round_off) ? largest : smallest;
    }
    sum = sum_over_ranks(mesh, sum);
    count = sum_over_ranks(mesh, count);
    return count > 0.0 ? sum / count : 0.0;
  });
}

void add_contact_traction(Registry<Quantity>& kinds) {
  kinds.add<ContactTraction>("contact traction", "pressure or shear of a pair: the largest, or at a position");
}

}  // namespace mortise
