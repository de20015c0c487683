// Parameters of a boundary condition.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Geometry>
#include <algorithm>

#include "constraints/component_name.hpp"
#include "mortise/solid/prescribed_motion.hpp"

namespace mortise {
namespace {

using Eigen::Vector3d;

void check_axis(Parameters& parameters, const std::string& name, std::vector<double>& axis) {
  if (axis.empty()) return;
  const bool is_direction = (axis.size() == 2 || axis.size() == 3) && std::any_of(axis.begin(), axis.end(), [](double a) { return a != 0.0; });
  if (is_direction) return;
  parameters.error(
      name, fmt::format("is \"{}\"; it needs two numbers, \"x, y\", or in 3D three, \"x, y, z\", of which not all are zero", fmt::join(axis, ", ")));
  axis.clear();
}

}  // namespace

void BoundaryConditionOptions::describe(Parameters& parameters) {
  parameters.add("set", set, Says("node or side set whose displacement is prescribed").required());
  parameters.add("x", x, Says("displacement in x (axisymmetric: r), an expression of t, x, y; left out: free").unit("length"));
  parameters.add("y", y, Says("displacement in y (axisymmetric: z), an expression of t, x, y; left out: free").unit("length"));
  parameters.add("z", z, Says("displacement in z, in three dimensions, an expression of t, x, y, z; left out: free").unit("length"));
  parameters.add("rotation", rotation,
                 Says("of a reference point of the plane, counterclockwise, an expression of t; left out: free").unit("degrees").arguments({"t"}));
  for (int i = 0; i < 3; ++i)
    parameters.add(fmt::format("rotation {}", component_name(i)), rotation_vector[i],
                   Says(fmt::format("{} component of the rotation vector of a reference point in 3D, an expression of t; left out: free. The point "
                                    "turns by the length of the vector about its direction, counterclockwise seen from its tip",
                                    component_name(i)))
                       .unit("degrees")
                       .arguments({"t"}));
  parameters.add(
      "x axis", x_axis,
      "direction of this condition's x in the axes of the model, \"x, y\" or \"x, y, z\", of any length; empty: x, y and z are those of the "
      "model. In 2D y is this direction turned by +90 degrees");
  check_axis(parameters, "x axis", x_axis);
  parameters.add("y axis", y_axis, "in 3D, direction of this condition's y, \"x, y, z\"; its part along \"x axis\" does not count; z is across both");
  check_axis(parameters, "y axis", y_axis);
  if (!y_axis.empty() && x_axis.empty()) {
    parameters.error("y axis", "stands without \"x axis\"; please give both");
    y_axis.clear();
  }
  if (x_axis.size() == 2 && !y_axis.empty()) parameters.error("y axis", "is for 3D; in 2D the direction of y follows from \"x axis\"");
  if (x_axis.size() == 3 && y_axis.empty() && (y || z))
    parameters.error("x axis", "has three numbers, as in 3D, and y or z is prescribed as well; please give \"y axis\" too, or in 2D two numbers");
  if (x_axis.size() == 3 && !y_axis.empty()) {
    y_axis.resize(3);
    Vector3d along(x_axis.data()), other(y_axis.data());
    along /= along.cwiseAbs().maxCoeff();
    other /= other.cwiseAbs().maxCoeff();
    constexpr double one_direction = 1e-6;  // sine of the angle
    if (along.cross(other).norm() <= one_direction * along.norm() * other.norm())
      parameters.error("y axis", fmt::format("is \"{}\", which is the direction of \"x axis\"", fmt::join(y_axis, ", ")));
  }
  const bool turns = rotation || std::any_of(rotation_vector.begin(), rotation_vector.end(), [](const auto& one) { return one.has_value(); });
  if (!x_axis.empty() && turns) parameters.error("x axis", "is of no use to rotations; please prescribe them in a condition of their own");
}

std::array<std::array<double, 3>, 3> axes_of(const BoundaryConditionOptions& condition) {
  if (condition.x_axis.empty()) return {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  const auto vector = [](const std::vector<double>& numbers) { return Vector3d(numbers[0], numbers[1], numbers.size() == 3 ? numbers[2] : 0.0); };
  const auto unit = [](const Vector3d& v) { return (v / v.cwiseAbs().maxCoeff()).normalized(); };  // squares of any length
  const Vector3d x = unit(vector(condition.x_axis));
  Vector3d y;
  if (condition.x_axis.size() == 2)
    y = Vector3d(-x[1], x[0], 0.0);
  else if (condition.y_axis.empty())
    y = x.unitOrthogonal();
  else
    y = unit(vector(condition.y_axis));
  y = (y - y.dot(x) * x).normalized();
  const Vector3d z = x.cross(y);
  return {{{x[0], x[1], x[2]}, {y[0], y[1], y[2]}, {z[0], z[1], z[2]}}};
}

std::array<double, 3> direction_of(const InclinedComponent& component) {
  Vector3d n = Vector3d::Unit(component.component) - Vector3d(component.of.data());
  n.normalize();
  return {n[0], n[1], n[2]};
}

}  // namespace mortise
