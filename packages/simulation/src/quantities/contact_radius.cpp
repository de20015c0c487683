// The radius of a contact zone of revolution.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Geometry>
#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <cmath>

#include "mortise/simulation/quantities/quantity_support.hpp"

namespace mortise {

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

std::unique_ptr<QuantityEvaluator> ContactRadius::make_evaluator(const QuantityContext& context) const {
  const std::size_t of_pair = find_pair(context, pair);
  if (context.mesh().dimension == 2) throw InputError(pair.place, "this quantity has a meaning in three-dimensional scenes only");
  return evaluator_of([quantity = *this, of_pair](const QuantityContext& at) {
    const Mesh& mesh = at.mesh();
    const auto displacement = at.displacement->getLocalViewHost(Tpetra::Access::ReadOnly);
    const double moves = at.contact->geometry(of_pair) == ContactGeometry::current ? 1.0 : 0.0;
    const Eigen::Vector3d origin(quantity.center.data()), direction = Eigen::Vector3d(quantity.axis.data()).normalized();
    double force = 0.0, moment = 0.0;
    for (const auto& state : node_states(*at.laws, of_pair)) {
      Eigen::Vector3d x(mesh.coordinates[state.owned_node].data());
      for (int i = 0; i < 3; ++i) x[i] += moves * displacement(at.space().row(state.owned_node, i), 0);
      const double normal_force = state.covered * state.pressure;
      force += normal_force;
      moment += normal_force * direction.cross(x - origin).squaredNorm();
    }
    force = sum_over_ranks(mesh, force);
    moment = sum_over_ranks(mesh, moment);
    return force > 0.0 ? std::sqrt(std::max(0.0, 2.5 * moment / force)) : 0.0;
  });
}

void add_contact_radius(Registry<Quantity>& kinds) {
  kinds.add<ContactRadius>("contact radius", "radius of a Hertzian pressure about an axis, from the pressures' second moment; in 3D");
}

}  // namespace mortise
