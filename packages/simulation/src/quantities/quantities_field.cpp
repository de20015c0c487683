// Extrema, means and spreads of fields.

#include <Tpetra_Map.hpp>
#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <cmath>
#include <limits>

#include "mortise/mesh/sets.hpp"
#include "mortise/simulation/quantities/quantity_support.hpp"

namespace mortise {
namespace {

enum class Carrier { nodes, points, slave_nodes };

Carrier carrier(PointField field) {
  if (field <= PointField::displacement_magnitude) return Carrier::nodes;
  return field <= PointField::equivalent_plastic_strain ? Carrier::points : Carrier::slave_nodes;
}

/// sqrt(3/2 s : s), s the deviator.
double von_mises(const Matrix3& stress) {
  const Matrix3 deviator = stress - stress.trace() / 3.0 * Matrix3::Identity();
  return std::sqrt(1.5) * deviator.norm();
}

double value_at(PointField field, const MaterialPoint& point) {
  const Matrix3& stress = point.cauchy_stress;
  switch (field) {
    case PointField::equivalent_plastic_strain:
      return point.equivalent_plastic_strain;
    case PointField::stress_xx:
      return stress(0, 0);
    case PointField::stress_yy:
      return stress(1, 1);
    case PointField::stress_zz:
      return stress(2, 2);
    case PointField::stress_xy:
      return stress(0, 1);
    case PointField::stress_yz:
      return stress(1, 2);
    case PointField::stress_xz:
      return stress(0, 2);
    default:
      return von_mises(stress);
  }
}

}  // namespace

void FieldQuantity::describe(Parameters& parameters) {
  parameters.add("field", field,
                 {{"displacement x", PointField::displacement_x},
                  {"displacement y", PointField::displacement_y},
                  {"displacement z", PointField::displacement_z},
                  {"displacement magnitude", PointField::displacement_magnitude},
                  {"stress xx", PointField::stress_xx},
                  {"stress yy", PointField::stress_yy},
                  {"stress zz", PointField::stress_zz},
                  {"stress xy", PointField::stress_xy},
                  {"stress yz", PointField::stress_yz},
                  {"stress xz", PointField::stress_xz},
                  {"von mises", PointField::von_mises},
                  {"equivalent plastic strain", PointField::equivalent_plastic_strain},
                  {"contact pressure", PointField::contact_pressure},
                  {"gap", PointField::gap}},
                 "displacement at nodes, Cauchy stress and accumulated plastic strain at quadrature points, pressure and gap at slave nodes");
  parameters.add("on", on,
                 "a set of nodes or a body (displacement), a body (stress, plastic strain), a contact pair (pressure, gap); empty: everywhere");
}

void FieldQuantity::prepare(const QuantityContext& context) {
  body_.reset();
  pair_.reset();
  const Carrier kind = carrier(field);
  if (kind == Carrier::slave_nodes && context.pairs.empty()) throw InputError(on.place, "the scene has no contact");
  if (on.value.empty()) return;
  if (kind == Carrier::nodes) require_node_set(context.mesh(), on);
  if (kind == Carrier::points) body_ = find_body(context, on);
  if (kind == Carrier::slave_nodes) pair_ = find_pair(context, on);
}

void FieldQuantity::visit(const QuantityContext& context, const std::function<void(double, double)>& visit) const {
  const Mesh& mesh = context.mesh();
  switch (carrier(field)) {
    case Carrier::nodes: {
      const auto displacement = context.displacement->getLocalViewHost(Tpetra::Access::ReadOnly);
      const auto visit_node = [&](LocalOrdinal node) {
        std::array<double, 3> u{};
        for (int i = 0; i < mesh.dimension; ++i) u[i] = displacement(mesh.dimension * node + i, 0);
        const auto component = static_cast<std::size_t>(field) - static_cast<std::size_t>(PointField::displacement_x);
        visit(field == PointField::displacement_magnitude ? std::hypot(u[0], u[1], u[2]) : u[component], 1.0);
      };
      if (on.value.empty()) {
        for (LocalOrdinal node = 0; node < mesh.owned_body_count(); ++node) visit_node(node);
      } else {
        for (const LocalOrdinal node : require_node_set(mesh, on))
          if (node < mesh.owned_count()) visit_node(node);
      }
      break;
    }
    case Carrier::points:
      context.bodies.visit_points(*context.local_displacement, [&](const MaterialPoint& point) {
        if (!body_ || point.block == *body_) visit(value_at(field, point), point.weight * point.volume_ratio);
      });
      break;
    case Carrier::slave_nodes:
      for (std::size_t pair = 0; pair < context.pairs.size(); ++pair)
        if (!pair_ || pair == *pair_)
          for (const auto& state : node_states(*context.laws, pair)) visit(field == PointField::gap ? state.gap : state.pressure, state.weight);
      break;
  }
}

void Extremum::describe(Parameters& parameters) {
  FieldQuantity::describe(parameters);
  parameters.add("which", which, names(), "which extremum");
}

const std::vector<std::pair<std::string, Extremum::Which>>& Extremum::names() {
  static const std::vector<std::pair<std::string, Which>> names{
      {"maximum", Which::maximum}, {"minimum", Which::minimum}, {"maximum absolute", Which::maximum_absolute}};
  return names;
}

double Extremum::evaluate(const QuantityContext& context) {
  const double sign = which == Which::minimum ? -1.0 : 1.0;
  double largest = -std::numeric_limits<double>::infinity();
  visit(context, [&](double value, double) { largest = std::max(largest, which == Which::maximum_absolute ? std::abs(value) : sign * value); });
  return sign * largest_over_ranks(context.mesh(), largest);
}

double Mean::evaluate(const QuantityContext& context) {
  double sum = 0.0, weights = 0.0;
  visit(context, [&](double value, double weight) { sum += weight * value, weights += weight; });
  return sum_over_ranks(context.mesh(), sum) / sum_over_ranks(context.mesh(), weights);
}

void Spread::describe(Parameters& parameters) { parameters.add("bodies", bodies, "bodies whose stresses are compared; empty: all"); }

void Spread::prepare(const QuantityContext& context) {
  chosen_.assign(context.mesh().blocks.size(), bodies.value.empty() ? 1 : 0);
  for (const auto& body : bodies.value) chosen_[find_body(context, {body, bodies.place})] = 1;
}

double Spread::evaluate(const QuantityContext& context) {
  const Mesh& mesh = context.mesh();
  Matrix3 mean = Matrix3::Zero();
  double volume = 0.0;
  const auto visit = [&](const std::function<void(const MaterialPoint&)>& visitor) {
    context.bodies.visit_points(*context.local_displacement, [&](const MaterialPoint& point) {
      if (chosen_[point.block]) visitor(point);
    });
  };
  visit([&](const MaterialPoint& point) {
    const double weight = point.weight * point.volume_ratio;
    mean += weight * point.cauchy_stress;
    volume += weight;
  });
  volume = sum_over_ranks(mesh, volume);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) mean(i, j) = sum_over_ranks(mesh, mean(i, j)) / volume;
  double deviation = 0.0;
  visit([&](const MaterialPoint& point) { deviation = std::max(deviation, (point.cauchy_stress - mean).cwiseAbs().maxCoeff()); });
  const double scale = mean.cwiseAbs().maxCoeff();
  deviation = largest_over_ranks(mesh, deviation);
  return scale > 0.0 ? deviation / scale : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace mortise
