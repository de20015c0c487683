#include "mortise/contact/pressure_law.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace mortise {

void LinearPressure::describe(Parameters& parameters) {
  parameters.add("stiffness", stiffness, Says("pressure per overclosure").unit("stress / length").above(0.0).required());
}

std::optional<std::string> LinearPressure::fault() const {
  if (stiffness > 0.0) return std::nullopt;
  return fmt::format("the stiffness of a linear pressure is {:g}; give one above 0", stiffness);
}

// p = K h and p + c h = s:  p = s K / (K + c).
PressurePoint LinearPressure::on_line(double sum, double c) const {
  if (!(sum > 0.0)) return {sum / c, 0.0, 0.0};
  return {sum / (stiffness + c), stiffness * sum / (stiffness + c), stiffness};
}

void ExponentialPressure::describe(Parameters& parameters) {
  parameters.add("clearance", clearance, Says("distance of the surfaces from which on they act on one another").unit("length").above(0.0).required());
  parameters.add("pressure", pressure, Says("where they just touch").unit("stress").above(0.0).required());
  parameters.add("curve", curve, {{"from zero", Curve::from_zero}, {"from a hundredth", Curve::from_hundredth}},
                 "pressure at the clearance: from zero, as in Abaqus; from a hundredth of `pressure`, as in CalculiX, and below that down to zero "
                 "along the tangent");
}

std::optional<std::string> ExponentialPressure::fault() const {
  if (clearance > 0.0 && pressure > 0.0) return std::nullopt;
  return fmt::format("the clearance of an exponential pressure is {:g}, its pressure {:g}; give both above 0", clearance, pressure);
}

namespace {
const double growth_from_hundredth = std::log(100.0);  // beta c_0
const double of_e = std::expm1(1.0);                   // e - 1
}  // namespace

double ExponentialPressure::onset() const { return curve == Curve::from_zero ? -clearance : -clearance * (1.0 + 1.0 / growth_from_hundredth); }

// Pressure p of s = h / c_0 + 1, the share of the clearance that is used up. The two curves:
//   From zero:         p = p_0 s (e^s - 1) / (e - 1)    for s > 0: slope 0 at the clearance
//   From a hundredth:  p = p_0 e^(beta h)               for s > 0;   p = p_0 / 100 (1 + beta c_0 s) below, as far as it is positive
PressurePoint ExponentialPressure::at(double overclosure) const {
  const double s = overclosure / clearance + 1.0;
  if (curve == Curve::from_zero) {
    if (!(s > 0.0)) return {overclosure, 0.0, 0.0};
    const double scale = pressure / of_e;
    return {overclosure, scale * s * std::expm1(s), scale / clearance * (std::expm1(s) + s * std::exp(s))};
  }
  const double beta = growth_from_hundredth / clearance, least = pressure / 100.0;
  if (s > 0.0) {
    const double value = least * std::exp(growth_from_hundredth * s);
    return {overclosure, value, beta * value};
  }
  const double value = least * (1.0 + growth_from_hundredth * s);
  return value > 0.0 ? PressurePoint{overclosure, value, beta * least} : PressurePoint{overclosure, 0.0, 0.0};
}

// Overclosure h >= 0 at which the pressure is at least a given one >= p_0. From zero, s (e^s - 1) >= e^s - 1 where s >= 1.
double ExponentialPressure::most_at(double value) const {
  return curve == Curve::from_zero ? clearance * (std::log1p(value / pressure * of_e) - 1.0)
                                   : clearance / growth_from_hundredth * std::log(value / pressure);
}

// f(h) = p(h) + c h - s is convex and grows. From above its root Newton's method falls to it, until round-off stops it. As p >= 0 and c h >= 0 for
// touching surfaces, the root is bounded and nothing overflows.
PressurePoint ExponentialPressure::on_line(double sum, double c) const {
  if (!(sum > c * onset())) return {sum / c, 0.0, 0.0};
  PressurePoint point = at(std::min(sum / c, sum < pressure ? 0.0 : most_at(sum)));
  for (;;) {
    const double next = point.overclosure - (point.pressure + c * point.overclosure - sum) / (point.slope + c);
    if (!(next < point.overclosure)) return point;
    point = at(next);
  }
}

void TabulatedPressure::describe(Parameters& parameters) {
  parameters.add("overclosures", overclosures, Says("of the points, ascending; below 0 the surfaces are apart").unit("length").required());
  parameters.add("pressures", pressures,
                 Says("at the points: 0 at first, nowhere falling, above 0 at last; beyond, the last slope goes on").unit("stress").required());
  if (const auto wrong = fault()) parameters.error("pressures", *wrong);
}

std::optional<std::string> TabulatedPressure::fault() const {
  const std::size_t count = overclosures.size();
  if (count < 2 || pressures.size() != count)
    return fmt::format("\"overclosures\" has {} values and \"pressures\" {}; give as many of both, 2 or more", count, pressures.size());
  for (std::size_t i = 1; i < count; ++i) {
    if (!(overclosures[i] > overclosures[i - 1]))
      return fmt::format("\"overclosures\" has {:g} after {:g}; each value has to be above the one before", overclosures[i], overclosures[i - 1]);
    if (!(pressures[i] >= pressures[i - 1]))
      return fmt::format("\"pressures\" has {:g} after {:g}; a pressure that falls makes contact unstable: no value may be below the one before",
                         pressures[i], pressures[i - 1]);
  }
  if (pressures.front() != 0.0)
    return fmt::format("\"pressures\" begins with {:g}, to which it would jump; begin with 0 at the overclosure from which on surfaces act",
                       pressures.front());
  if (!(pressures.back() > 0.0)) return std::string("\"pressures\" is 0 at all points, so that nothing would act; end with a value above 0");
  return std::nullopt;
}

double TabulatedPressure::slope(std::size_t piece) const {
  return (pressures[piece + 1] - pressures[piece]) / (overclosures[piece + 1] - overclosures[piece]);
}

// Points are passed in the order of p + c h, which grows along the curve. On a piece of the slope k from (h_i, p_i) on:
//   h - h_i = (s - p_i - c h_i) / (k + c).
PressurePoint TabulatedPressure::on_line(double sum, double c) const {
  const auto beyond = [&](std::size_t i) { return sum - pressures[i] - c * overclosures[i]; };
  if (!(beyond(0) > 0.0)) return {sum / c, 0.0, 0.0};
  std::size_t piece = 0;
  while (piece + 2 < overclosures.size() && beyond(piece + 1) >= 0.0) ++piece;
  const double k = slope(piece), along = beyond(piece) / (k + c);
  return {overclosures[piece] + along, pressures[piece] + k * along, k};
}

double TabulatedPressure::onset() const {
  std::size_t last = 0;
  while (last + 2 < pressures.size() && pressures[last + 1] == 0.0) ++last;
  return overclosures[last];
}

double TabulatedPressure::typical_slope() const {
  double steepest = 0.0;
  for (std::size_t piece = 0; piece + 1 < overclosures.size(); ++piece) steepest = std::max(steepest, slope(piece));
  return steepest;
}

const Registry<PressureLaw>& pressure_law_registry() {
  static const Registry<PressureLaw> registry = [] {
    Registry<PressureLaw> laws;
    laws.add<LinearPressure>("linear", "in proportion to the overclosure");
    laws.add<ExponentialPressure>("exponential", "grows exponentially from a clearance on");
    laws.add<TabulatedPressure>("table", "straight lines between given points");
    return laws;
  }();
  return registry;
}

}  // namespace mortise
