#include "mortise/thermal/prescribed_temperatures.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "mortise/core/guarded_value.hpp"
#include "mortise/mesh/sets.hpp"

namespace mortise {
namespace {

/// Conditions that share a node have to agree; they are compared at these times.
constexpr double compared_times[] = {0.0, 0.37, 1.0};

/// To the round-off of expressions.
bool agree(double a, double b) { return a == b || std::abs(a - b) <= 1e-12 * std::max(std::abs(a), std::abs(b)); }

std::string shown_position(const std::array<double, 3>& X, int dimension) { return fmt::format("({:g})", fmt::join(X.begin(), X.begin() + dimension, ", ")); }

}  // namespace

void PrescribedTemperatureOptions::describe(Parameters& parameters) {
  parameters.add("set", set, Says("node or side set whose temperature is prescribed").required());
  parameters.add("temperature", temperature, Says("an expression of t and the reference position x, y, z").unit("temperature").required());
}

PrescribedTemperatures::PrescribedTemperatures(const ThermalBodies& bodies, const std::vector<Named<PrescribedTemperatureOptions>>& conditions)
    : conditions_(conditions) {
  const Mesh& mesh = *bodies.mesh();
  const FieldRows& rows = bodies.space().rows(bodies.temperature());
  std::vector<Diagnostic> diagnostics;
  std::map<LocalOrdinal, Source> of_rows;
  for (std::size_t n = 0; n < conditions_.size(); ++n) {
    const auto& [name, place, condition] = conditions_[n];
    const auto refuse = [&, &name = name, &place = place](const std::string& what) {
      diagnostics.push_back({place, fmt::format("prescribed temperature \"{}\": {}", name, what)});
    };
    try {
      for (const LocalOrdinal node : require_node_set(mesh, condition.set)) {
        if (node >= mesh.owned_count()) continue;
        const Source source{n, mesh.coordinates[node]};
        if (!rows.lives(node)) {
          refuse(fmt::format("the node of \"{}\" at {} has no temperature; give its body thermal properties, or a set without it",
                             condition.set.value, shown_position(source.position, mesh.dimension)));
          break;
        }
        const auto [other, is_new] = of_rows.try_emplace(rows(node, 0), source);
        if (is_new) continue;
        std::optional<StepFailure> none;
        const bool same = std::all_of(std::begin(compared_times), std::end(compared_times),
                                      [&, &other = other](double t) { return agree(value(source, t, none), value(other->second, t, none)); });
        if (same) continue;
        refuse(fmt::format("it differs from \"{}\" at the node at {}, which both have; leave the node out of one of them",
                           conditions_[other->second.condition].name, shown_position(source.position, mesh.dimension)));
        break;
      }
    } catch (const InputError& error) {
      diagnostics.insert(diagnostics.end(), error.diagnostics().begin(), error.diagnostics().end());
    }
  }
  throw_if_any(*mesh.comm, diagnostics);
  for (const auto& [row, source] : of_rows) {
    rows_.push_back(row);
    sources_.push_back(source);
  }
}

std::vector<AffineConstraints::Line> PrescribedTemperatures::lines(std::size_t first) const {
  std::vector<AffineConstraints::Line> lines;
  for (std::size_t i = 0; i < rows_.size(); ++i) lines.push_back({rows_[i], {}, {{first + i, 1.0}}});
  return lines;
}

std::vector<double> PrescribedTemperatures::values(double time, std::optional<StepFailure>& failure) const {
  std::vector<double> values;
  values.reserve(sources_.size());
  for (const Source& source : sources_) values.push_back(value(source, time, failure));
  return values;
}

double PrescribedTemperatures::value(const Source& source, double time, std::optional<StepFailure>& failure) const {
  const auto& [name, place, condition] = conditions_[source.condition];
  const auto& X = source.position;
  std::string reason;
  const double result = value_or_nan(condition.temperature, {time, X[0], X[1], X[2]}, &reason);
  if (!std::isfinite(result) && !failure)
    failure.emplace(
        FailureKind::input,
        fmt::format("prescribed temperature \"{}\": \"{}\" is {:g}{} at t = {:g} and ({:g}) of the reference configuration; allowed: finite; "
                    "change the expression where it is not so",
                    name, condition.temperature.source(), result, reason.empty() ? "" : fmt::format(" ({})", reason), time,
                    fmt::join(X.begin(), X.end(), ", ")));
  return result;
}

}  // namespace mortise
