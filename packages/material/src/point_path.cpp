#include "mortise/material/point_path.hpp"

#include <fmt/format.h>

#include <Eigen/LU>

namespace mortise {
namespace {

/// Reads a function of time: a point has no position.
template <class Value>
void add_of_time(Parameters& parameters, const std::string& name, Value& value, Says says) {
  parameters.add(name, value, says.arguments({"t"}));
}

}  // namespace

void PointPath::describe(Parameters& parameters) {
  parameters.add("steps", steps, Says("number of equal steps").at_least(1));
  parameters.add("end time", end_time, Says("pseudo-time t at the end").unit("time").above(0.0));
}

void StretchPath::describe(Parameters& parameters) {
  PointPath::describe(parameters);
  add_of_time(parameters, "stretch", stretch, Says("F11 as a function of t, larger than 0; this or \"final stretch\"").unit("-"));
  parameters.add("final stretch", final_stretch, Says("F11 at the end, reached linearly from 1").unit("-").above(0.0));
  if (stretch && final_stretch) parameters.error("final stretch", "\"stretch\" is given too; please give one of them");
  if (!stretch && !final_stretch) parameters.error("stretch", "\"stretch\" is missing; please add it, or \"final stretch\"");
}

double StretchPath::stretch_at(double time) const {
  if (!stretch) return 1.0 + (final_stretch.value_or(1.0) - 1.0) * time / end_time;
  const double value = (*stretch)(time);
  if (!(value > 0.0))
    throw InputError(stretch->place(), fmt::format("the stretch \"{}\" is {} at t = {}; it has to be larger than 0", stretch->source(), value, time));
  return value;
}

PathPoint UniaxialPath::at(double time) const { return {time, Eigen::Vector3d(stretch_at(time), 1.0, 1.0).asDiagonal(), {1, 2}}; }

PathPoint PlaneStrainPath::at(double time) const { return {time, Eigen::Vector3d(stretch_at(time), 1.0, 1.0).asDiagonal(), {1}}; }

void SimpleShearPath::describe(Parameters& parameters) {
  PointPath::describe(parameters);
  add_of_time(parameters, "shear", shear, Says("F12 as a function of t").unit("-").required());
}

PathPoint SimpleShearPath::at(double time) const {
  PathPoint point{time, Matrix3::Identity(), {}};
  point.F(0, 1) = shear(time);
  return point;
}

DeformationGradientPath::DeformationGradientPath() {
  for (const int diagonal : {0, 4, 8}) components[diagonal] = ScalarFunction(1.0);
}

void DeformationGradientPath::describe(Parameters& parameters) {
  PointPath::describe(parameters);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      add_of_time(parameters, fmt::format("F{}{}", i + 1, j + 1), components[3 * i + j], Says("this component of F as a function of t").unit("-"));
  const std::vector<std::pair<std::string, std::array<int, 2>>> choices{{"11", {0, 0}}, {"22", {1, 1}}, {"33", {2, 2}},
                                                                        {"12", {0, 1}}, {"23", {1, 2}}, {"13", {0, 2}}};
  parameters.add("component", shown, choices, "component of stress and strain that is drawn");
}

PathPoint DeformationGradientPath::at(double time) const {
  PathPoint point{time, Matrix3::Identity(), {}};
  for (int c = 0; c < 9; ++c) point.F(c / 3, c % 3) = components[c](time);
  if (const double determinant = point.F.determinant(); !(determinant > 0.0))
    throw InputError(components[0].place(), fmt::format("det F is {} at t = {}; it has to be larger than 0", determinant, time));
  return point;
}

const Registry<PointPath>& point_path_registry() {
  static const Registry<PointPath> registry = Registry<PointPath>()
                                                  .add<UniaxialPath>("uniaxial", "a stretch along 1; no stress along 2 and 3")
                                                  .add<PlaneStrainPath>("plane strain", "a stretch along 1; no stress along 2, no stretch along 3")
                                                  .add<SimpleShearPath>("simple shear", "planes normal to 2 slide along 1: F = I with F12 given")
                                                  .add<DeformationGradientPath>("deformation gradient", "all nine components of F as functions of t");
  return registry;
}

std::vector<PathPoint> points_of(const PointPath& path) {
  std::vector<PathPoint> points;
  for (int n = 0; n <= path.steps; ++n) points.push_back(path.at(path.end_time * n / path.steps));
  return points;
}

}  // namespace mortise
