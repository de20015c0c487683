#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "mortise/core/memory.hpp"
#include "mortise/io/files.hpp"
#include "mortise/io/output_directory.hpp"
#include "mortise/simulation/model/run_log.hpp"
#include "mortise/simulation/run/run.hpp"
#include "mortise/simulation/scene/read_scene.hpp"
#include "mortise/studies/scale.hpp"
#include "scale/memory_bandwidth.hpp"
#include "scale/scale_rates.hpp"
#include "scale/scale_record.hpp"
#include "scale/scale_report.hpp"
#include "shared/draw_plot.hpp"

namespace mortise {
namespace {

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

}  // namespace

ExitCode run_scale(const RCP<const Communicator>& comm, const ScaleOptions& options) {
  RunLog log(comm, options.verbosity);
  const Scene scene = read_scene(*comm, options.scene, options.settings);
  OutputDirectory directory(comm, options.directory.empty() ? default_directory(options.scene) + "-scale" : options.directory,
                            {"scale", options.scene, options.directory.empty()});
  require_launcher(options.launcher);
  require_page_python(*comm, directory.file("report.html"));
  std::vector<ScalePoint> points = planned_points(scene, options);
  const std::vector<std::string> names{"scale.csv", "scale.json", "scale.svg", "scale_weak.svg", "report.html", "machine.xml", "plans", "runs"};
  directory.open(names);
  for (const auto& old : names) directory.remove(old);
  OutputDirectory runs = directory.subdirectory("runs");
  for (ScalePoint& point : points) point.directory = runs.subdirectory(fmt::format("{}_{}", point.series, point.ranks)).path();

  std::map<int, double> bandwidth;
  // Runs of another launcher may be on other nodes than this one.
  for (const int ranks : options.launcher.words.empty() ? rank_counts(options.ranks) : std::vector<int>()) {
    bandwidth[ranks] = triad_bandwidth(ranks);
    log.info(fmt::format("memory bandwidth of {} process(es): {:.1f} GB/s", ranks, 1e-9 * bandwidth[ranks]));
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    points[i].bandwidth = bandwidth[points[i].ranks];
    run_scale_point(comm, options, points[i]);
    log.info(progress(i, points));
    if (!points[i].finished) log.warning(points[i].said.substr(points[i].said.find_last_of('\n') + 1));
  }
  const ExitCode code = report_scale(comm, options, points, directory, log);
  MachineFile here;
  here.name = fmt::format("node of {}", options.scene);
  here.cores_per_node = options.cores;
  here.memory_per_node = std::floor(machine_memory_mib());
  if (options.launcher.words.empty() && bandwidth[1] > 0.0 && bandwidth[options.ranks] > 0.0) {
    here.core_bandwidth = 1e-9 * bandwidth[1];
    here.node_bandwidth = std::max(1e-9 * bandwidth[options.ranks], *here.core_bandwidth);
  }
  write_measured_machine(comm, options, points, here, directory, log);
  directory.strike_missing();
  return code;
}

}  // namespace mortise
