#include "mortise/simulation/quantities/exact_solution.hpp"

#include <fmt/format.h>

#include <cmath>

namespace mortise {
namespace {
constexpr double pi = 3.14159265358979323846;

/// A parameter that may change with t but not with position: solutions are functions of position already.
void add_in_time(Parameters& parameters, const std::string& name, ScalarFunction& value, Says says) {
  parameters.add(name, value, says.arguments({"t"}));
}
}  // namespace

void HertzLineContact::describe(Parameters& parameters) {
  add_in_time(parameters, "load", load, Says("force per thickness on the whole contact, both halves; an expression of t").unit("force / length"));
  parameters.add("radius", radius, Says("radius of the cylinder").unit("length").above(0.0));
  parameters.add("second radius", second_radius, Says("radius of the other body, negative if it is hollow; default: it is a plane").unit("length"));
  parameters.add("first young's modulus", first_youngs_modulus, Says("of one body").unit("stress").above(0.0));
  parameters.add("first poisson's ratio", first_poissons_ratio, Says("of one body").unit("-").above(-1.0).at_most(0.5));
  parameters.add("second young's modulus", second_youngs_modulus, Says("of the other body").unit("stress").above(0.0));
  parameters.add("second poisson's ratio", second_poissons_ratio, Says("of the other body").unit("-").above(-1.0).at_most(0.5));
  parameters.add("centre", center, Says("x of the middle of the contact zone").unit("length").formerly("center"));
  if (second_radius && !(1.0 / radius + 1.0 / *second_radius > 0.0))
    parameters.error("second radius",
                     fmt::format("is {:g}; a hollow body has to have a larger radius than the cylinder in it, {:g}", *second_radius, radius));
}

double HertzLineContact::half_width(double time) const {
  const double compliance = (1.0 - first_poissons_ratio * first_poissons_ratio) / first_youngs_modulus +
                            (1.0 - second_poissons_ratio * second_poissons_ratio) / second_youngs_modulus;
  const double curvature = 1.0 / radius + (second_radius ? 1.0 / *second_radius : 0.0);
  return std::sqrt(4.0 * std::max(0.0, load(time)) * compliance / (pi * curvature));
}

double HertzLineContact::peak(double time) const {
  const double a = half_width(time);
  return a > 0.0 ? 2.0 * load(time) / (pi * a) : 0.0;
}

std::optional<double> HertzLineContact::pressure(const Point& x, double time) const {
  const double a = half_width(time), distance = std::abs(x[0] - center);
  if (distance >= a) return 0.0;
  return peak(time) * std::sqrt((1.0 - distance / a) * (1.0 + distance / a));
}

std::optional<ContactZone> HertzLineContact::zone(double time) const { return ContactZone{center, half_width(time)}; }

void UniformState::describe(Parameters& parameters) {
  add_in_time(parameters, "contact pressure", contact_pressure, Says("an expression of t").unit("stress"));
  add_in_time(parameters, "xx", xx, Says("stress component; an expression of t").unit("stress"));
  add_in_time(parameters, "yy", yy, Says("stress component; an expression of t").unit("stress"));
  add_in_time(parameters, "zz", zz, Says("stress component; an expression of t").unit("stress"));
  add_in_time(parameters, "xy", xy, Says("stress component; an expression of t").unit("stress"));
}

std::optional<double> UniformState::pressure(const Point&, double time) const { return contact_pressure(time); }

std::optional<Eigen::Matrix3d> UniformState::stress(const Point&, double time) const {
  Eigen::Matrix3d stress;
  stress << xx(time), xy(time), 0.0, xy(time), yy(time), 0.0, 0.0, 0.0, zz(time);
  return stress;
}

void LinearDisplacement::describe(Parameters& parameters) {
  add_in_time(parameters, "x", x, Says("displacement at the origin; an expression of t").unit("length"));
  add_in_time(parameters, "y", y, Says("displacement at the origin; an expression of t").unit("length"));
  add_in_time(parameters, "xx", xx, Says("du_x/dX; an expression of t").unit("-"));
  add_in_time(parameters, "xy", xy, Says("du_x/dY; an expression of t").unit("-"));
  add_in_time(parameters, "yx", yx, Says("du_y/dX; an expression of t").unit("-"));
  add_in_time(parameters, "yy", yy, Says("du_y/dY; an expression of t").unit("-"));
}

std::optional<ExactSolution::Point> LinearDisplacement::displacement(const Point& X, double time) const {
  return Point{x(time) + xx(time) * X[0] + xy(time) * X[1], y(time) + yx(time) * X[0] + yy(time) * X[1]};
}

void LameRing::describe(Parameters& parameters) {
  parameters.add("inner radius", inner_radius, Says("of the whole ring").unit("length").above(0.0));
  parameters.add("outer radius", outer_radius, Says("of the whole ring").unit("length").above(0.0));
  parameters.add("young's modulus", youngs_modulus, Says("of the ring").unit("stress").above(0.0));
  parameters.add("poisson's ratio", poissons_ratio, Says("of the ring").unit("-").above(-1.0).at_most(0.5));
  add_in_time(parameters, "inner pressure", inner_pressure, Says("on the inner surface; an expression of t").unit("stress"));
  add_in_time(parameters, "outer pressure", outer_pressure, Says("on the outer surface; an expression of t").unit("stress"));
  parameters.add("centre x", center_x, Says("x of the centre").unit("length").formerly("center x"));
  parameters.add("centre y", center_y, Says("y of the centre").unit("length").formerly("center y"));
  if (outer_radius <= inner_radius)
    parameters.error("outer radius", fmt::format("is {:g}; it has to be larger than \"inner radius\", {:g}", outer_radius, inner_radius));
}

LameRing::Constants LameRing::constants(double time) const {
  const double a2 = inner_radius * inner_radius, b2 = outer_radius * outer_radius;
  const double inner = inner_pressure(time), outer = outer_pressure(time);
  return {(inner * a2 - outer * b2) / (b2 - a2), (inner - outer) * a2 * b2 / (b2 - a2)};
}

std::optional<double> LameRing::pressure(const Point& x, double time) const {
  const auto [A, B] = constants(time);
  const double r = std::hypot(x[0] - center_x, x[1] - center_y);
  return B / (r * r) - A;
}

std::optional<ExactSolution::Point> LameRing::displacement(const Point& x, double time) const {
  const auto [A, B] = constants(time);
  const double dx = x[0] - center_x, dy = x[1] - center_y, r2 = dx * dx + dy * dy;
  const double stretch = (1.0 + poissons_ratio) / youngs_modulus * ((1.0 - 2.0 * poissons_ratio) * A + B / r2);  // u_r / r
  return Point{stretch * dx, stretch * dy};
}

std::optional<Eigen::Matrix3d> LameRing::stress(const Point& x, double time) const {
  const auto [A, B] = constants(time);
  const double dx = x[0] - center_x, dy = x[1] - center_y, r2 = dx * dx + dy * dy;
  // In x and y: sigma = A I - B/r^2 (e_r e_r - e_theta e_theta), e_r e_r - e_theta e_theta = [cos 2 theta, sin 2 theta; sin 2 theta, -cos 2 theta]
  const double cosine = (dx * dx - dy * dy) / r2, sine = 2.0 * dx * dy / r2, shear = B / r2;
  Eigen::Matrix3d stress;
  stress << A - shear * cosine, -shear * sine, 0.0, -shear * sine, A + shear * cosine, 0.0, 0.0, 0.0, 2.0 * poissons_ratio * A;
  return stress;
}

const Registry<ExactSolution>& exact_solution_registry() {
  static const Registry<ExactSolution> registry = [] {
    Registry<ExactSolution> kinds;
    kinds.add<HertzLineContact>("hertz line contact", "pressure between two cylinders, or a cylinder and a plane, in plane strain");
    kinds.add<UniformState>("uniform", "the same stress and contact pressure everywhere");
    kinds.add<LinearDisplacement>("linear displacement", "a displacement that is linear in the reference position");
    kinds.add<LameRing>("lame ring", "thick ring under inner and outer pressure, plane strain, small strain");
    return kinds;
  }();
  return registry;
}

}  // namespace mortise
