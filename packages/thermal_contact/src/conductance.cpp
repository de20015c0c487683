#include "mortise/thermal_contact/conductance.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "mortise/core/guarded_value.hpp"
#include "mortise/core/piecewise_linear.hpp"
#include "straight_lines.hpp"

namespace mortise {

void ConstantConductance::describe(Parameters& parameters) {
  parameters.add("value", value, Says("conductance h").unit("power / (area temperature)").at_least(0.0).required());
}

std::optional<std::string> ConstantConductance::fault() const {
  if (value >= 0.0 && std::isfinite(value)) return std::nullopt;
  return fmt::format("the conductance is {:g}; give one that is finite and not negative", value);
}

PerfectConductance PerfectConductance::of(double conductivity, double facet) {
  PerfectConductance law;
  law.value = over_facet * conductivity / facet;
  return law;
}

void PowerConductance::describe(Parameters& parameters) {
  parameters.add("factor", factor, Says("h_0 of h = h_g + h_0 (p / H)^m").unit("power / (area temperature)").at_least(0.0).required());
  parameters.add("hardness", hardness, Says("H, of the softer surface").unit("stress").above(0.0).required());
  parameters.add("exponent", exponent, Says("m").unit("-").above(0.0));
  parameters.add("without pressure", without_pressure,
                 Says("h_g, as of a gas between the asperities").unit("power / (area temperature)").at_least(0.0));
}

// Below p_s = 1e-6 of the largest pressure h - h_g = (h_0 (p_s / H)^m / p_s) p. The largest pressure is that of another node as a rule. The
// derivative by it, (m - 1) (h - h_g) / p_largest at a node that bears less than p_s, is left out: it would couple all nodes, and it is 1e-6 of the
// largest one.
Conductance PowerConductance::at(const TouchingPoint& point) const {
  const double p = point.pressure, least = of_largest * (point.largest_pressure > 0.0 ? point.largest_pressure : hardness);
  if (p < least) {
    const double slope = factor * std::pow(least / hardness, exponent) / least;
    return {without_pressure + slope * p, slope, 0.0, 0.0};
  }
  const double value = factor * std::pow(p / hardness, exponent);
  return {without_pressure + value, exponent * value / p, 0.0, 0.0};
}

std::optional<std::string> PowerConductance::fault() const {
  if (!(factor >= 0.0) || !(without_pressure >= 0.0) || !std::isfinite(factor + without_pressure))
    return fmt::format("the factor of a conductance is {:g} and that without pressure {:g}; give ones that are finite and not negative", factor,
                       without_pressure);
  if (!(hardness > 0.0) || !(exponent > 0.0))
    return fmt::format("the hardness of a conductance is {:g}, its exponent {:g}; give both above 0", hardness, exponent);
  return std::nullopt;
}

void TabulatedConductance::describe(Parameters& parameters) {
  parameters.add("pressures", pressures, Says("of the points, ascending; beyond them the conductance is constant").unit("stress").required());
  parameters.add("conductances", conductances, Says("at the points").unit("power / (area temperature)").required());
  if (const auto wrong = fault()) parameters.error("conductances", *wrong);
}

Conductance TabulatedConductance::at(const TouchingPoint& point) const {
  const auto [value, slope] = piecewise_linear(pressures, conductances, point.pressure);
  return {value, slope, 0.0, 0.0};
}

std::optional<std::string> TabulatedConductance::fault() const {
  return detail::fault_of_straight_lines(pressures, conductances, "pressures", "conductances");
}

void ConductanceFunction::describe(Parameters& parameters) {
  parameters.add("conductance", conductance,
                 Says("h, an expression of `pressure`, `temperature`, the mean of both sides, and `slip_rate`")
                     .unit("power / (area temperature)")
                     .arguments({"pressure", "temperature", "slip_rate"})
                     .required());
}

namespace {
/// Step of a difference at an argument of 0, which has no size to tell a step by, in the unit of the argument.
constexpr double from_zero = 1e-5;
}  // namespace

// Central differences are exact to about 1e-10, which no Newton step notices. At an argument of 0 they are those of a step that may be too large or
// too small for the law; a pressure of 0 is that of a node which has just closed, and of the first iterate alone.
Conductance ConductanceFunction::at(const TouchingPoint& point) const {
  const std::array<double, 3> at = {point.pressure, point.temperature, point.slip_rate};
  const auto value_at = [&](std::size_t changed, double by) {
    std::vector<double> arguments(at.begin(), at.end());
    arguments[changed] += by;
    return value_or_nan(conductance, arguments);
  };
  Conductance result;
  result.value = value_at(0, 0.0);
  if (conductance.is_constant()) return result;
  const std::array<double*, 3> slopes = {&result.of_pressure, &result.of_temperature, &result.of_slip_rate};
  for (std::size_t i = 0; i < at.size(); ++i) {
    const double step = at[i] != 0.0 ? std::cbrt(std::numeric_limits<double>::epsilon()) * std::abs(at[i]) : from_zero;
    const double back = at[i] == 0.0 && i != 1 ? 0.0 : step;  // pressures and slip rates are not negative
    *slopes[i] = (value_at(i, step) - value_at(i, -back)) / (step + back);
  }
  return result;
}

const Registry<ConductanceLaw>& conductance_registry() {
  static const Registry<ConductanceLaw> registry = [] {
    Registry<ConductanceLaw> laws;
    laws.add<NoConductance>("none", "nothing flows");
    laws.add<ConstantConductance>("constant", "the same at any pressure");
    laws.add<PerfectConductance>("perfect", "no resistance, at any pressure: both sides have one temperature");
    laws.add<PowerConductance>("power", "a power of the pressure over the hardness, as of rough surfaces");
    laws.add<TabulatedConductance>("table", "straight lines between given pressures");
    laws.add<ConductanceFunction>("function", "an expression of pressure, temperature and slip rate");
    return laws;
  }();
  return registry;
}

}  // namespace mortise
