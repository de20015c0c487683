#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "mortise/core/names.hpp"
#include "mortise/simulation/scene/read_scene.hpp"
#include "scale/scale_record.hpp"

namespace mortise {
namespace {

/// The variable at so many ranks: value p^(1/dimension) to the nearest multiple, and at least one of it.
std::string grown(const WeakVariable& variable, double value, int dimension, int ranks) {
  const double exact = value * std::pow(ranks, 1.0 / dimension);
  return fmt::format("variables/{}={}", variable.name, std::max(1L, std::lround(exact / variable.multiple)) * variable.multiple);
}

double value_of(const Scene& scene, const ScaleOptions& options) {
  const auto& variables = scene.symbols.variables;
  const auto found = variables.find(options.weak->name);
  if (found == variables.end()) {
    std::vector<std::string> known;
    for (const auto& variable : variables) known.push_back(variable.first);
    const std::string hint = did_you_mean(options.weak->name, known);
    const std::string all = known.empty() ? "t has none" : "t has: " + quoted_list(known);
    throw InputError(Place{},
                     fmt::format("--weak {0}: the scene has no variable \"{0}\"{1}{2}", options.weak->name, hint.empty() ? "; i" : hint + " I", all));
  }
  return found->second;
}

}  // namespace

std::vector<int> rank_counts(int most) {
  std::vector<int> counts;
  for (int ranks = 1; ranks < most; ranks *= 2) counts.push_back(ranks);
  counts.push_back(most);
  return counts;
}

std::vector<ScalePoint> planned_points(const Scene& scene, const ScaleOptions& options) {
  std::vector<ScalePoint> points;
  const auto add = [&](const std::string& series, int ranks) {
    ScalePoint& point = points.emplace_back();
    point.series = series;
    point.ranks = ranks;
    point.settings = options.settings;
  };
  for (const int ranks : rank_counts(options.ranks)) add("strong", ranks);
  if (!options.weak) return points;
  const double value = value_of(scene, options);
  for (const int ranks : rank_counts(options.ranks)) {
    add("weak", ranks);
    points.back().settings.push_back(grown(*options.weak, value, dimension(scene.kinematics), ranks));
  }
  return points;
}

}  // namespace mortise
