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
      Says("friction coefficient mu, an expression of `pressure` and `slip`, the path that the node has slipped up to the start of the step")
          .unit("-")
          .at_least(0.0)
          .arguments({"pressure", "slip"})
          .required());
  parameters.add(
      "largest traction", largest_traction,
      Says("shear traction that is never exceeded, as the shear yield stress of the softer side; default: none").unit("stress").above(0.0));
}

namespace {
bool is_coefficient(double value) { return value >= 0.0 && std::isfinite(value); }
}  // namespace

std::optional<Diagnostic> CoulombFriction::missing_bound(double pressure, double slip_path) const {
  std::string thrown;
  const double value = value_or_nan(coefficient, {pressure, slip_path}, &thrown);
  if (is_coefficient(value)) return {};
  const double shown = std::isnan(value) ? std::abs(value) : value;  // some operations give a sign to what is not a number
  return Diagnostic{coefficient.place(),
                    fmt::format("\"{}\" is {:g} at pressure = {:g}, slip = {:g}{}; allowed: >= 0 and finite", coefficient.source(), shown, pressure,
                                slip_path, thrown.empty() ? "" : fmt::format(" ({})", thrown))};
}

// d(mu p)/dp of a function by central differences: exact to 1e-10 of mu, which no Newton step notices.
FrictionBound CoulombFriction::bound(double pressure, double slip_path) const {
  const auto at = [&](double p) { return value_or_nan(coefficient, {p, slip_path}) * p; };
  if (!is_coefficient(value_or_nan(coefficient, {pressure, slip_path}))) return {std::numeric_limits<double>::quiet_NaN(), 0.0};
  FrictionBound result{at(pressure), 0.0};
  if (largest_traction && result.value >= *largest_traction) return {*largest_traction, 0.0};
  if (coefficient.is_constant()) return {result.value, coefficient.at({0.0, 0.0})};
  const double step = std::cbrt(std::numeric_limits<double>::epsilon()) * pressure;
  result.slope = step > 0.0 ? (at(pressure + step) - at(pressure - step)) / (2.0 * step) : value_or_nan(coefficient, {0.0, slip_path});
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
