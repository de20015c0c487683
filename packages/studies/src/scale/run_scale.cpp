#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "mortise/core/names.hpp"
#include "mortise/io/files.hpp"
#include "mortise/io/output_directory.hpp"
#include "mortise/simulation/model/run_log.hpp"
#include "mortise/simulation/run/run.hpp"
#include "mortise/simulation/scene/read_scene.hpp"
#include "mortise/studies/scale.hpp"
#include "scale/memory_bandwidth.hpp"
#include "scale/scale_record.hpp"
#include "shared/draw_plot.hpp"
#include "shared/plot_scripts.hpp"

namespace mortise {
namespace {

/// 1, 2, 4 ... and the most.
std::vector<int> rank_counts(int most) {
  std::vector<int> counts;
  for (int ranks = 1; ranks < most; ranks *= 2) counts.push_back(ranks);
  counts.push_back(most);
  return counts;
}

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

/// Points of both series, without their directories.
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

std::string progress(std::size_t number, const std::vector<ScalePoint>& points) {
  const ScalePoint& point = points[number];
  const ScalePoint& first = *std::find_if(points.begin(), points.end(), [&](const ScalePoint& one) { return one.series == point.series; });
  std::string line = fmt::format("{}/{} {} series, {} rank(s): ", number + 1, points.size(), point.series, point.ranks);
  if (!point.finished) return line + "failed";
  line += fmt::format("{:.0f} dofs, {:.2f} s", point.dofs, point.seconds);
  if (const double efficiency = point.efficiency(first, point.seconds, first.seconds); std::isfinite(efficiency))
    line += fmt::format(", efficiency {:.2f}", efficiency);
  else if (first.finished && !point.has_grown(first))
    line += ", no efficiency: no more unknowns than on one rank";
  return line;
}

/// Ranks of the weak series whose points have at most as many unknowns as its first one.
std::vector<int> ranks_without_growth(const std::vector<ScalePoint>& points) {
  std::vector<int> ranks;
  const auto first = std::find_if(points.begin(), points.end(), [](const ScalePoint& point) { return point.series == "weak"; });
  if (first == points.end() || !first->finished) return ranks;
  for (auto point = first; point != points.end(); ++point)
    if (point->finished && !point->has_grown(*first)) ranks.push_back(point->ranks);
  return ranks;
}

}  // namespace

ExitCode run_scale(const RCP<const Communicator>& comm, const ScaleOptions& options) {
  RunLog log(comm, options.verbosity);
  const Scene scene = read_scene(*comm, options.scene, options.settings);
  OutputDirectory directory(comm, options.directory.empty() ? default_directory(options.scene) + "-scale" : options.directory,
                            {"scale", options.scene, options.directory.empty()});
  const std::string page = directory.file("report.html");
  require_page_python(*comm, page);
  std::vector<ScalePoint> points = planned_points(scene, options);
  const std::vector<std::string> names{"scale.csv", "scale.json", "scale.svg", "scale_weak.svg", "report.html", "runs"};
  directory.open(names);
  for (const auto& old : names) directory.remove(old);
  OutputDirectory runs = directory.subdirectory("runs");
  for (ScalePoint& point : points) point.directory = runs.subdirectory(fmt::format("{}_{}", point.series, point.ranks)).path();

  std::map<int, double> bandwidth;
  for (const int ranks : rank_counts(options.ranks)) {
    bandwidth[ranks] = triad_bandwidth(ranks);
    log.info(fmt::format("memory bandwidth of {} process(es): {:.1f} GB/s", ranks, 1e-9 * bandwidth[ranks]));
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    points[i].bandwidth = bandwidth[points[i].ranks];
    run_scale_point(comm, options, points[i]);
    log.info(progress(i, points));
    if (!points[i].finished) log.warning(points[i].said.substr(points[i].said.find_last_of('\n') + 1));
  }
  if (const std::vector<int> flat = ranks_without_growth(points); !flat.empty())
    log.warning(
        fmt::format("--weak {}: the number of unknowns did not grow with the ranks on {} ranks. This is no weak scaling; no efficiency is given",
                    options.weak->name, fmt::join(flat, ", ")));
  write_scale_table(comm, directory.claim("scale.csv"), points);
  write_json(*comm, directory.claim("scale.json"), scale_json(options, points));
  for (const char* name : {"scale.svg", "scale_weak.svg", "report.html"}) directory.claim(name);
  draw_plot(*comm, std::string(page_needs) + scale_page, {directory.path()}, page);
  directory.strike_missing();
  log.info("the page: " + page);
  return std::all_of(points.begin(), points.end(), [](const ScalePoint& point) { return point.finished; }) ? ExitCode::done : ExitCode::not_converged;
}

}  // namespace mortise
