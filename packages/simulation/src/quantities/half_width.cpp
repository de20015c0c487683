// The half width of a contact zone.

#include <algorithm>
#include <cmath>

#include "mortise/shape/quadrature.hpp"
#include "mortise/simulation/quantities/quantity_support.hpp"

namespace mortise {

void HalfWidth::describe(Parameters& parameters) {
  PairQuantity::describe(parameters);
  parameters.add("centre", center, Says("x of the middle of the contact zone").unit("length").formerly("center"));
  describe_measure(parameters, measure);
}

std::unique_ptr<QuantityEvaluator> HalfWidth::make_evaluator(const QuantityContext& context) const {
  return evaluator_of([quantity = *this, of_pair = find_pair_of_plane(context, pair)](const QuantityContext& at) {
    // p is linear and x is linear on a facet: p x^2 is a cubic, which two points integrate exactly.
    static const auto rule = gauss_legendre(2);
    double force = 0.0, moment = 0.0;
    for (const PressedFacet& facet : pressed_facets(at, of_pair, quantity.measure))
      for (const LinePoint& point : rule) {
        const double left = 0.5 * (1.0 - point.xi), right = 0.5 * (1.0 + point.xi);
        const double x = left * facet.position[0][0] + right * facet.position[1][0] - quantity.center;
        const double p = (left * facet.pressure[0] + right * facet.pressure[1]) * 0.5 * facet.length() * point.weight;
        force += p;
        moment += p * x * x;
      }
    force = sum_over_ranks(at.mesh(), force);
    moment = sum_over_ranks(at.mesh(), moment);
    return force > 0.0 ? 2.0 * std::sqrt(std::max(0.0, moment / force)) : 0.0;
  });
}

void add_half_width(Registry<Quantity>& kinds) {
  kinds.add<HalfWidth>("half width", "half width of the contact zone from the second moment of the pressure: 2 sqrt(int p x^2 / int p)");
}

}  // namespace mortise
