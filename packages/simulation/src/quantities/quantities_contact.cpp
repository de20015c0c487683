// Quantities of one contact pair.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Geometry>
#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <cmath>

#include "mortise/shape/quadrature.hpp"
#include "mortise/simulation/quantities/quantity_support.hpp"

namespace mortise {

void PairQuantity::describe(Parameters& parameters) { parameters.add("pair", pair, "contact pair; may be left out if the scene has one only"); }

void PairQuantity::prepare(const QuantityContext& context) {
  pair_ = find_pair(context, pair);
  const bool plane = context.mesh().dimension == 2;
  if (plane ? in_plane() : in_space()) return;
  throw InputError(pair.place, plane ? "this quantity has a meaning in three-dimensional scenes only"
                                     : "this quantity is one of lines and has a meaning in plane and axisymmetric scenes only");
}

void HalfWidth::describe(Parameters& parameters) {
  PairQuantity::describe(parameters);
  parameters.add("centre", center, Says("x of the middle of the contact zone").unit("length").formerly("center"));
  describe_measure(parameters, measure);
}

double HalfWidth::evaluate(const QuantityContext& context) {
  // p is linear and x is linear on a facet: p x^2 is a cubic, which two points integrate exactly.
  static const auto rule = gauss_legendre(2);
  double force = 0.0, moment = 0.0;
  for (const PressedFacet& facet : pressed_facets(context, pair_, measure))
    for (const LinePoint& point : rule) {
      const double left = 0.5 * (1.0 - point.xi), right = 0.5 * (1.0 + point.xi);
      const double x = left * facet.position[0][0] + right * facet.position[1][0] - center;
      const double p = (left * facet.pressure[0] + right * facet.pressure[1]) * 0.5 * facet.length() * point.weight;
      force += p;
      moment += p * x * x;
    }
  force = sum_over_ranks(context.mesh(), force);
  moment = sum_over_ranks(context.mesh(), moment);
  return force > 0.0 ? 2.0 * std::sqrt(std::max(0.0, moment / force)) : 0.0;
}

double PeakPressure::evaluate(const QuantityContext& context) {
  double peak = 0.0;
  for (const auto& state : node_states(*context.laws, pair_)) peak = std::max(peak, state.pressure);
  return largest_over_ranks(context.mesh(), peak);
}

double ContactLength::evaluate(const QuantityContext& context) {
  double length = 0.0;
  for (const PressedFacet& facet : pressed_facets(context, pair_)) length += 0.5 * facet.length() * (int(facet.closed[0]) + int(facet.closed[1]));
  return sum_over_ranks(context.mesh(), length);
}

// Half a facet from x_1 on has the area depth((3 x_1 + x_2)/4) length/2, as depth is linear in the radius.
double ContactArea::evaluate(const QuantityContext& context) {
  double area = 0.0;
  if (context.mesh().dimension == 3) {
    for (const auto& state : node_states(*context.laws, pair_)) area += state.closed ? state.covered : 0.0;
    return sum_over_ranks(context.mesh(), area);
  }
  for (const PressedFacet& facet : pressed_facets(context, pair_))
    for (int end = 0; end < 2; ++end)
      if (facet.closed[end]) area += 0.5 * facet.length() * context.bodies.depth(0.75 * facet.position[end][0] + 0.25 * facet.position[1 - end][0]);
  return sum_over_ranks(context.mesh(), area);
}

void ContactRadius::describe(Parameters& parameters) {
  PairQuantity::describe(parameters);
  parameters.add("centre", center, Says("a point of the axis: \"x, y, z\"").unit("length").formerly("center"));
  parameters.add("axis", axis, "direction of the axis: \"x, y, z\"");
  for (auto [name, values] : {std::pair{"centre", &center}, std::pair{"axis", &axis}})
    if (values->size() != 3) {
      parameters.error(name, fmt::format("is \"{}\"; it needs three numbers, \"x, y, z\"", fmt::join(*values, ", ")));
      values->assign({0.0, 0.0, 1.0});
    }
  if (Eigen::Vector3d(axis.data()).isZero(0.0)) parameters.error("axis", "needs a direction, not \"0, 0, 0\"");
}

double ContactRadius::evaluate(const QuantityContext& context) {
  const Mesh& mesh = context.mesh();
  const auto displacement = context.displacement->getLocalViewHost(Tpetra::Access::ReadOnly);
  const double moves = context.contact->geometry(pair_) == ContactGeometry::current ? 1.0 : 0.0;
  const Eigen::Vector3d origin(center.data()), direction = Eigen::Vector3d(axis.data()).normalized();
  double force = 0.0, moment = 0.0;
  for (const auto& state : node_states(*context.laws, pair_)) {
    Eigen::Vector3d x(mesh.coordinates[state.owned_node].data());
    for (int i = 0; i < 3; ++i) x[i] += moves * displacement(3 * state.owned_node + i, 0);
    const double normal_force = state.covered * state.pressure;
    force += normal_force;
    moment += normal_force * direction.cross(x - origin).squaredNorm();
  }
  force = sum_over_ranks(mesh, force);
  moment = sum_over_ranks(mesh, moment);
  return force > 0.0 ? std::sqrt(std::max(0.0, 2.5 * moment / force)) : 0.0;
}

double PressureVariation::evaluate(const QuantityContext& context) {
  double variation = 0.0;
  for (const PressedFacet& facet : pressed_facets(context, pair_)) variation += std::abs(facet.pressure[1] - facet.pressure[0]);
  return sum_over_ranks(context.mesh(), variation);
}

double ActiveCount::evaluate(const QuantityContext& context) {
  double count = 0.0;
  for (const auto& state : node_states(*context.laws, pair_)) count += state.closed ? 1.0 : 0.0;
  return sum_over_ranks(context.mesh(), count);
}

}  // namespace mortise
