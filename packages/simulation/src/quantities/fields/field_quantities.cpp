// Extrema and means of fields.

#include <Tpetra_Map.hpp>
#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "mortise/mesh/sets.hpp"
#include "mortise/simulation/quantities/quantity_support.hpp"
#include "quantities/fields/principal_stress.hpp"

namespace mortise {
namespace {

enum class Carrier { nodes, points, slave_nodes };

Carrier carrier(PointField field) {
  if (field <= PointField::temperature) return Carrier::nodes;
  return field <= PointField::equivalent_plastic_strain ? Carrier::points : Carrier::slave_nodes;
}

/// sqrt(3/2 s : s), s the deviator.
double equivalent_stress(const Matrix3& stress) {
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
    case PointField::largest_principal_stress:
      return principal_stresses(stress)[0].value;
    case PointField::middle_principal_stress:
      return principal_stresses(stress)[1].value;
    case PointField::smallest_principal_stress:
      return principal_stresses(stress)[2].value;
    default:
      return equivalent_stress(stress);
  }
}

/// The points that a quantity looks at.
class FieldPoints {
 public:
  FieldPoints(const FieldQuantity& quantity, const QuantityContext& context) : field_(quantity.field), on_(quantity.on) {
    const Carrier kind = carrier(field_);
    if (kind == Carrier::slave_nodes && context.pairs.empty()) throw InputError(on_.place, "the scene has no contact");
    if (field_ == PointField::temperature) require_temperature(context);
    if (on_.value.empty()) return;
    if (kind == Carrier::nodes) require_node_set(context.mesh(), on_);
    if (kind == Carrier::points) body_ = find_body(context, on_);
    if (kind == Carrier::slave_nodes) pair_ = find_pair(context, on_);
  }

  using Position = std::array<double, 3>;
  /// Calls visit(value, weight, reference position) for the points of this rank. Weights: 1, current volume, or A_j.
  void visit(const QuantityContext& context, const std::function<void(double, double, const Position&)>& visit) const {
    const Mesh& mesh = context.mesh();
    const auto place = [&](LocalOrdinal node) -> const Position& { return mesh.coordinates[static_cast<std::size_t>(node)]; };
    switch (carrier(field_)) {
      case Carrier::nodes: {
        const auto displacement = context.displacement->getLocalViewHost(Tpetra::Access::ReadOnly);
        const auto visit_node = [&](LocalOrdinal node) {
          if (field_ == PointField::temperature) {
            const FieldRows& rows = context.space().rows(context.heat.bodies->temperature());
            if (rows.lives(node)) visit(displacement(rows(node, 0), 0), 1.0, place(node));
            return;
          }
          std::array<double, 3> u{};
          for (int i = 0; i < mesh.dimension; ++i) u[i] = displacement(context.space().row(node, i), 0);
          const auto component = static_cast<std::size_t>(field_) - static_cast<std::size_t>(PointField::displacement_x);
          visit(field_ == PointField::displacement_magnitude ? std::hypot(u[0], u[1], u[2]) : u[component], 1.0, place(node));
        };
        if (on_.value.empty()) {
          for (LocalOrdinal node = 0; node < mesh.owned_body_count(); ++node) visit_node(node);
        } else {
          for (const LocalOrdinal node : require_node_set(mesh, on_))
            if (node < mesh.owned_count()) visit_node(node);
        }
        break;
      }
      case Carrier::points:
        context.bodies.visit_points(*context.local_displacement, [&](const MaterialPoint& point) {
          if (!body_ || context.mesh().blocks[point.block].body == *body_)
            visit(value_at(field_, point), point.weight * point.volume_ratio, point.reference_position);
        });
        break;
      case Carrier::slave_nodes:
        for (std::size_t pair = 0; pair < context.pairs.size(); ++pair)
          if (!pair_ || pair == *pair_)
            for (const auto& state : node_states(*context.laws, pair))
              visit(field_ == PointField::gap ? state.gap : state.pressure, state.weight, place(state.owned_node));
        break;
    }
  }

 private:
  PointField field_;
  Located<std::string> on_;
  std::optional<LocalOrdinal> body_;
  std::optional<std::size_t> pair_;
};

}  // namespace

void FieldQuantity::describe(Parameters& parameters) {
  parameters.add(
      "field", field,
      {{"displacement x", PointField::displacement_x},
       {"displacement y", PointField::displacement_y},
       {"displacement z", PointField::displacement_z},
       {"displacement magnitude", PointField::displacement_magnitude},
       {"temperature", PointField::temperature},
       {"stress xx", PointField::stress_xx},
       {"stress yy", PointField::stress_yy},
       {"stress zz", PointField::stress_zz},
       {"stress xy", PointField::stress_xy},
       {"stress yz", PointField::stress_yz},
       {"stress xz", PointField::stress_xz},
       {"von mises", PointField::von_mises},
       {"largest principal stress", PointField::largest_principal_stress},
       {"middle principal stress", PointField::middle_principal_stress},
       {"smallest principal stress", PointField::smallest_principal_stress},
       {"equivalent plastic strain", PointField::equivalent_plastic_strain},
       {"contact pressure", PointField::contact_pressure},
       {"gap", PointField::gap}},
      "displacement and temperature at nodes, Cauchy stress and accumulated plastic strain at quadrature points, pressure and gap at slave nodes");
  parameters.add(
      "on", on,
      "a set of nodes or a body (displacement, temperature), a body (stress, plastic strain), a contact pair (pressure, gap); empty: everywhere");
}

void Extremum::describe(Parameters& parameters) {
  FieldQuantity::describe(parameters);
  parameters.add("which", which, names(), "kind of extremum");
  parameters.add("gives", gives, {{"value", Gives::value}, {"x", Gives::x}, {"y", Gives::y}, {"z", Gives::z}},
                 "the extremum itself, or a coordinate of the place where it is, in the reference configuration; of several places that with the "
                 "smallest coordinates");
}

const std::vector<std::pair<std::string, Extremum::Which>>& Extremum::names() {
  static const std::vector<std::pair<std::string, Which>> names{
      {"maximum", Which::maximum}, {"minimum", Which::minimum}, {"maximum absolute", Which::maximum_absolute}};
  return names;
}

std::unique_ptr<QuantityEvaluator> Extremum::make_evaluator(const QuantityContext& context) const {
  return evaluator_of([which = which, gives = gives, points = FieldPoints(*this, context)](const QuantityContext& at) {
    const double sign = which == Which::minimum ? -1.0 : 1.0;
    const auto size = [&](double value) { return which == Which::maximum_absolute ? std::abs(value) : sign * value; };
    double mine = -std::numeric_limits<double>::infinity();
    points.visit(at, [&](double value, double, const auto&) { mine = std::max(mine, size(value)); });
    const double largest = largest_over_ranks(at.mesh(), mine);
    if (gives == Gives::value) return sign * largest;
    // Of a symmetric state several places have it but for round-off.
    const double least = largest - same_but_for_round_off * std::abs(largest);
    std::array<double, 3> place{};
    bool has_it = false;
    points.visit(at, [&](double value, double, const std::array<double, 3>& position) {
      if (!(size(value) >= least) || (has_it && !(position < place))) return;
      has_it = true;
      place = position;
    });
    // Of the ranks that have it the one with the smallest coordinates.
    constexpr double none = std::numeric_limits<double>::infinity();
    double coordinate = none;
    for (std::size_t i = 0; i < place.size(); ++i) {
      coordinate = -largest_over_ranks(at.mesh(), has_it ? -place[i] : -none);
      has_it = has_it && place[i] == coordinate;
      if (i + 1 == static_cast<std::size_t>(gives)) return coordinate;
    }
    return coordinate;
  });
}

std::unique_ptr<QuantityEvaluator> Mean::make_evaluator(const QuantityContext& context) const {
  return evaluator_of([points = FieldPoints(*this, context)](const QuantityContext& at) {
    double sum = 0.0, weights = 0.0;
    points.visit(at, [&](double value, double weight, const auto&) { sum += weight * value, weights += weight; });
    return sum_over_ranks(at.mesh(), sum) / sum_over_ranks(at.mesh(), weights);
  });
}

void add_extremum(Registry<Quantity>& kinds) { kinds.add<Extremum>("extremum", "largest or smallest value of a field"); }

void add_mean(Registry<Quantity>& kinds) { kinds.add<Mean>("mean", "mean of a field: over nodes, over volume, over the slave surface"); }

}  // namespace mortise
