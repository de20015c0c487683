#include "mortise/simulation/scene/pattern.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace mortise {

namespace {

/// Two or three numbers: those of a plane scene get a third, 0.
void check_vector(Parameters& parameters, const std::string& name, std::vector<double>& numbers) {
  if (numbers.size() == 2) numbers.push_back(0.0);
  if (numbers.empty() || numbers.size() == 3) return;
  parameters.error(name, fmt::format("is \"{}\"; it needs numbers \"x, y\" or \"x, y, z\"", fmt::join(numbers, ", ")));
  numbers = {0.0, 0.0, 1.0};
}

}  // namespace

void PatternOptions::describe(Parameters& parameters) {
  parameters.add("copies", copies, Says("bodies in all: NAME, NAME 2, NAME 3 and so on").at_least(1).at_most(10000));
  parameters.add("begin", begin, Says("steps from the mesh to the first of them").at_least(0).at_most(10000));
  parameters.add("translation", translation, Says("from a body to the next one: \"x, y\" or \"x, y, z\"; empty: it only turns").unit("length"));
  check_vector(parameters, "translation", translation);
  parameters.add("rotation", rotation, Says("from a body to the next one, before the translation").unit("degrees"));
  parameters.add("rotation axis", axis, "direction of the axis that it turns about, \"x, y, z\"");
  if (axis.size() != 3 || std::all_of(axis.begin(), axis.end(), [](double a) { return a == 0.0; })) {
    parameters.error("rotation axis",
                     fmt::format("is \"{}\"; it needs three numbers, \"x, y, z\", of which not all are zero", fmt::join(axis, ", ")));
    axis = {0.0, 0.0, 1.0};
  }
  parameters.add("rotation point", point, Says("a point on that axis, \"x, y\" or \"x, y, z\"").unit("length"));
  check_vector(parameters, "rotation point", point);
  if (point.empty()) point = {0.0, 0.0, 0.0};
}

std::optional<Isometry> placement(Mirror mirror, const PatternOptions& pattern) {
  std::optional<Isometry> placed;
  if (mirror != Mirror::none) placed = reflection(static_cast<int>(mirror) - static_cast<int>(Mirror::x));
  if (pattern.begin == 0) return placed;
  Isometry step =
      rotation(pattern.rotation, {pattern.axis[0], pattern.axis[1], pattern.axis[2]}, {pattern.point[0], pattern.point[1], pattern.point[2]});
  if (!pattern.translation.empty())
    for (int i = 0; i < 3; ++i) step.translation[i] += pattern.translation[static_cast<std::size_t>(i)];
  Isometry all = placed.value_or(Isometry{});
  for (int i = 0; i < pattern.begin; ++i) all = after(step, all);
  return all;
}

}  // namespace mortise
