// Quantities of the tractions along one slave surface.

#include <algorithm>
#include <cmath>

#include "mortise/shape/quadrature.hpp"
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

void StickHalfWidth::describe(Parameters& parameters) {
  PairQuantity::describe(parameters);
  describe_measure(parameters, measure);
}

double StickHalfWidth::evaluate(const QuantityContext& context) {
  // s is linear and x is linear on a facet: s x^2 is a cubic, which two points integrate exactly. Moments of order 0, 1, 2.
  static const auto rule = gauss_legendre(2);
  std::array<double, 3> moments{};
  for (const PressedFacet& facet : pressed_facets(context, pair_, measure))
    for (const LinePoint& point : rule) {
      const std::array<double, 2> N{0.5 * (1.0 - point.xi), 0.5 * (1.0 + point.xi)};
      double x = 0.0, s = 0.0;
      for (int end = 0; end < 2; ++end) {
        x += N[end] * facet.position[end][0];
        s += N[end] * std::max(0.0, facet.shear_bound[end] - std::abs(facet.shear[end]));
      }
      s *= 0.5 * facet.length() * point.weight;
      for (int k = 0; k < 3; ++k) moments[k] += s * std::pow(x, k);
    }
  for (double& moment : moments) moment = sum_over_ranks(context.mesh(), moment);
  if (!(moments[0] > 0.0)) return 0.0;
  const double middle = moments[1] / moments[0];
  return 2.0 * std::sqrt(std::max(0.0, moments[2] / moments[0] - middle * middle));
}

void ContactTraction::describe(Parameters& parameters) {
  PairQuantity::describe(parameters);
  parameters.add("x", x, Says("position on the slave surface; left out: the traction of largest size").unit("length"));
  parameters.add("part", part, {{"pressure", Part::pressure}, {"shear", Part::shear}, {"x", Part::x}, {"y", Part::y}},
                 "what acts along or across the normal of the slave surface as it stands, or along an axis; of the traction of slave on master");
  describe_measure(parameters, measure);
}

double ContactTraction::evaluate(const QuantityContext& context) {
  double sum = 0.0, count = 0.0, largest = 0.0, smallest = 0.0;
  for (const PressedFacet& facet : pressed_facets(context, pair_, measure)) {
    const std::array<double, 2> values = part_of(facet, part);
    for (const double value : values) largest = std::max(largest, value), smallest = std::min(smallest, value);
    const double a = facet.position[0][0], b = facet.position[1][0];
    if (!x || a == b || !(std::min(a, b) <= *x && *x <= std::max(a, b))) continue;
    const double share = (*x - a) / (b - a);
    sum += (1.0 - share) * values[0] + share * values[1];
    count += 1.0;
  }
  const Mesh& mesh = context.mesh();
  if (!x) {
    largest = largest_over_ranks(mesh, largest);
    smallest = -largest_over_ranks(mesh, -smallest);
    return largest >= -smallest ? largest : smallest;
  }
  sum = sum_over_ranks(mesh, sum);
  count = sum_over_ranks(mesh, count);
  return count > 0.0 ? sum / count : 0.0;
}

}  // namespace mortise
