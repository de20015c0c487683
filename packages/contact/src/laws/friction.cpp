#include "mortise/contact/friction.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <string>

#include "mortise/core/guarded_value.hpp"

namespace mortise {

void CoulombFriction::describe(Parameters& parameters) {
  parameters.add(
      "coefficient", coefficient,
      Says("friction coefficient mu, an expression of `pressure`, `slip`, the path that the node has slipped, and `temperature`, the mean of both "
           "sides; slip and temperature are those at the start of the step")
          .unit("-")
          .at_least(0.0)
          .arguments({"pressure", "slip", "temperature"})
          .required());
  parameters.add(
      "largest traction", largest_traction,
      Says("shear traction that is never exceeded, as the shear yield stress of the softer side; default: none").unit("stress").above(0.0));
}

namespace {
bool is_coefficient(double value) { return value >= 0.0 && std::isfinite(value); }
}  // namespace

std::optional<Diagnostic> CoulombFriction::missing_bound(const FrictionPoint& point) const {
  if (reads_temperature() && !std::isfinite(point.temperature))
    return Diagnostic{coefficient.place(), fmt::format("\"{}\" depends on the temperature, and none is known", coefficient.source())};
  std::string thrown;
  const double value = value_or_nan(coefficient, {point.pressure, point.slip_path, point.temperature}, &thrown);
  if (is_coefficient(value)) return {};
  const double shown = std::isnan(value) ? std::abs(value) : value;  // some operations give a sign to what is not a number
  const std::string temperature = reads_temperature() ? fmt::format(", temperature = {:g}", point.temperature) : "";
  return Diagnostic{coefficient.place(),
                    fmt::format("\"{}\" is {:g} at pressure = {:g}, slip = {:g}{}{}; allowed: >= 0 and finite", coefficient.source(), shown,
                                point.pressure, point.slip_path, temperature, thrown.empty() ? "" : fmt::format(" ({})", thrown))};
}

// d(mu p)/dp of a function by central differences: exact to 1e-10 of mu, which no Newton step notices.
FrictionBound CoulombFriction::bound(const FrictionPoint& point) const {
  const auto coefficient_at = [&](double p) { return value_or_nan(coefficient, {p, point.slip_path, point.temperature}); };
  const double p = point.pressure, value = coefficient_at(p);
  if (!is_coefficient(value) || (reads_temperature() && !std::isfinite(point.temperature))) return {std::numeric_limits<double>::quiet_NaN(), 0.0};
  FrictionBound result{value * p, 0.0};
  if (largest_traction && result.value >= *largest_traction) return {*largest_traction, 0.0};
  if (coefficient.is_constant()) return {result.value, value};
  const double step = std::cbrt(std::numeric_limits<double>::epsilon()) * p;
  const auto at = [&](double pressure) { return coefficient_at(pressure) * pressure; };
  result.slope = step > 0.0 ? (at(p + step) - at(p - step)) / (2.0 * step) : coefficient_at(0.0);
  return result;
}

void TrescaFriction::describe(Parameters& parameters) {
  parameters.add("traction", traction, Says("shear traction at which closed nodes slip").unit("stress").at_least(0.0).required());
}

const Registry<FrictionLaw>& friction_registry() {
  static const Registry<FrictionLaw> registry = [] {
    Registry<FrictionLaw> laws;
    laws.add<NoFriction>("none", "nodes slip freely");
    laws.add<CoulombFriction>("coulomb", "slip at a shear traction of mu times the pressure, or at a largest traction");
    laws.add<TrescaFriction>("tresca", "slip at a given shear traction");
    return laws;
  }();
  return registry;
}

}  // namespace mortise
