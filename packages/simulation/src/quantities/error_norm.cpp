// Errors against exact solutions.

#include <fmt/format.h>

#include <Tpetra_Map.hpp>
#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <cmath>
#include <limits>

#include "mortise/shape/quadrature.hpp"
#include "mortise/simulation/quantities/quantity_support.hpp"

namespace mortise {
namespace {

/// The list "exact" of an error norm.
struct ExactList {
  Choice<ExactSolution>& exact;
  void describe(Parameters& parameters) { parameters.choose(exact, exact_solution_registry(), "the exact solution"); }
};

/// Squares of a difference and of its reference, integrated.
struct Squares {
  double difference = 0.0, reference = 0.0;
  double relative(const Mesh& mesh) const {
    const double above = sum_over_ranks(mesh, difference), below = sum_over_ranks(mesh, reference);
    return below > 0.0 ? std::sqrt(above / below) : std::numeric_limits<double>::quiet_NaN();
  }
};

/// True if the exact solution has what the field is compared with.
bool is_known(const ErrorNorm& quantity, double time) {
  const ExactSolution::Point somewhere{1.0, 1.0};
  if (quantity.of == ErrorNorm::Of::contact_pressure) return quantity.exact.options->pressure(somewhere, time).has_value();
  if (quantity.of == ErrorNorm::Of::displacement) return quantity.exact.options->displacement(somewhere, time).has_value();
  return quantity.exact.options->stress(somewhere, time).has_value();
}

double pressure_error(const ErrorNorm& quantity, const QuantityContext& context, std::size_t pair) {
  const ExactSolution& solution = *quantity.exact.options;
  const auto zone = solution.zone(context.time);
  const double infinity = std::numeric_limits<double>::infinity();
  double low = quantity.from.value_or(-infinity), high = quantity.to.value_or(infinity);
  if (quantity.unit == ErrorNorm::Unit::half_width) {
    low = zone->center + low * zone->half_width;
    high = zone->center + high * zone->half_width;
  }
  std::vector<double> kinks{low, high};  // between these places on a facet the integrand is smooth
  if (zone) kinks.insert(kinks.end(), {zone->center - zone->half_width, zone->center + zone->half_width});

  static const auto rule = gauss_legendre(8);
  Squares squares;
  for (const PressedFacet& facet : pressed_facets(context, pair)) {
    const double start = facet.position[0][0], run = facet.position[1][0] - start;
    std::vector<double> cuts{0.0, 1.0};
    for (const double kink : kinks)
      if (const double s = (kink - start) / run; std::isfinite(s) && s > 0.0 && s < 1.0) cuts.push_back(s);
    std::sort(cuts.begin(), cuts.end());
    for (std::size_t part = 0; part + 1 < cuts.size(); ++part) {
      const double size = cuts[part + 1] - cuts[part], middle = cuts[part] + 0.5 * size;
      if (const double x = start + middle * run; x < low || x > high) continue;
      for (const LinePoint& point : rule) {
        const double s = middle + 0.5 * size * point.xi;
        const ExactSolution::Point x{start + s * run, facet.position[0][1] + s * (facet.position[1][1] - facet.position[0][1])};
        const double weight = 0.5 * size * point.weight * facet.length() * context.bodies.depth(x[0]);
        const double expected = *solution.pressure(x, context.time), found = (1.0 - s) * facet.pressure[0] + s * facet.pressure[1];
        squares.difference += weight * (found - expected) * (found - expected);
        squares.reference += weight * expected * expected;
      }
    }
  }
  return squares.relative(context.mesh());
}

/// @param body  none: all
double body_error(const ErrorNorm& quantity, const QuantityContext& context, const std::optional<LocalOrdinal>& body) {
  const ExactSolution& solution = *quantity.exact.options;
  Squares squares;
  context.bodies.visit_points(*context.local_displacement, [&](const MaterialPoint& point) {
    if (body && context.mesh().blocks[point.block].body != *body) return;
    const ExactSolution::Point X{point.reference_position[0], point.reference_position[1]};
    if (quantity.of == ErrorNorm::Of::stress) {
      const Eigen::Matrix3d expected = *solution.stress(X, context.time);
      squares.difference += point.weight * (point.cauchy_stress - expected).squaredNorm();
      squares.reference += point.weight * expected.squaredNorm();
    } else {
      const auto expected = *solution.displacement(X, context.time);
      for (int i = 0; i < 2; ++i) {
        const double difference = point.position[i] - X[i] - expected[i];
        squares.difference += point.weight * difference * difference;
        squares.reference += point.weight * expected[i] * expected[i];
      }
    }
  });
  return squares.relative(context.mesh());
}

}  // namespace

void ErrorNorm::describe(Parameters& parameters) {
  parameters.add("field", of, {{"contact pressure", Of::contact_pressure}, {"displacement", Of::displacement}, {"stress", Of::stress}},
                 "the pressure p_h = sum N_j z_n,j on the slave surface, or a field over bodies");
  parameters.add("on", on, "contact pair (may be left out if there is one only) or body (empty: all)");
  parameters.add("from", from,
                 Says("start of the range of x (where the pair's geometry is: current or reference position) that counts for the contact pressure; "
                      "default: all of the surface"));
  parameters.add("to", to, Says("end of that range"));
  parameters.add("unit", unit, {{"length", Unit::length}, {"half width", Unit::half_width}},
                 "unit of the range: a length, or half widths of the exact contact zone, from its centre");
  ExactList list{exact};
  parameters.list("exact", list, "exact solution with which the field is compared");
  if (of != Of::contact_pressure && (from || to))
    parameters.error(from ? "from" : "to", "a range counts for the contact pressure only; please remove it");
  if (from && to && *from >= *to) parameters.error("to", fmt::format("is {:g}; it has to lie above \"from\", {:g}", *to, *from));
}

std::unique_ptr<QuantityEvaluator> ErrorNorm::make_evaluator(const QuantityContext& context) const {
  if (context.mesh().dimension != 2) throw InputError(exact.place, "error norms are quantities of plane and axisymmetric scenes only");
  if (!is_known(*this, 0.0)) {
    const char* const names[] = {"contact pressure", "displacement", "stress"};
    throw InputError(exact.place, fmt::format("the exact solution \"{}\" knows no {}", exact.type, names[static_cast<int>(of)]));
  }
  if (unit == Unit::half_width && !exact.options->zone(0.0)) throw InputError(exact.place, fmt::format("\"{}\" has no half width", exact.type));
  const std::size_t pair = of == Of::contact_pressure ? find_pair(context, on) : 0;
  const std::optional<LocalOrdinal> body = of == Of::contact_pressure ? std::nullopt : find_optional_body(context, on);
  return evaluator_of([quantity = *this, pair, body](const QuantityContext& at) {
    is_known(quantity, at.time);  // an expression without a value at this time throws here, on all ranks, and not below, on those with facets only
    return quantity.of == Of::contact_pressure ? pressure_error(quantity, at, pair) : body_error(quantity, at, body);
  });
}

void add_error_norm(Registry<Quantity>& kinds) { kinds.add<ErrorNorm>("error norm", "relative L2 error of a field against a named exact solution"); }

}  // namespace mortise
