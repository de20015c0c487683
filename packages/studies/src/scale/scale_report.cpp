#include "scale/scale_report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "mortise/io/files.hpp"
#include "shared/draw_plot.hpp"
#include "shared/plot_scripts.hpp"

namespace mortise {
namespace {

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

ExitCode report_scale(const RCP<const Communicator>& comm, const ScaleOptions& options, const std::vector<ScalePoint>& points,
                      OutputDirectory& directory, RunLog& log) {
  if (const std::vector<int> flat = ranks_without_growth(points); !flat.empty())
    log.warning(
        fmt::format("--weak {}: the number of unknowns did not grow with the ranks on {} ranks. This is no weak scaling; no efficiency is given",
                    options.weak->name, fmt::join(flat, ", ")));
  const std::string page = directory.file("report.html");
  write_scale_table(comm, directory.claim("scale.csv"), points);
  write_json(*comm, directory.claim("scale.json"), scale_json(options, points));
  for (const char* name : {"scale.svg", "scale_weak.svg", "report.html"}) directory.claim(name);
  draw_plot(*comm, std::string(page_needs) + scale_page, {directory.path()}, page);
  log.info("the page: " + page);
  return std::all_of(points.begin(), points.end(), [](const ScalePoint& point) { return point.finished; }) ? ExitCode::done : ExitCode::not_converged;
}

}  // namespace mortise
