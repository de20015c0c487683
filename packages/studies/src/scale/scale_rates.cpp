#include "scale/scale_rates.hpp"

#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>

#include "mortise/io/files.hpp"
#include "scale/scale_prediction.hpp"
#include "shared/run_process.hpp"

namespace mortise {
namespace {

using Json = nlohmann::ordered_json;

/// A finished run and its plan.
struct PlannedPoint {
  const ScalePoint* point;
  Json work;  ///< by phase, of plan.json
};

double count_of(const ScalePoint& point, ScalePhase::Times times) {
  if (times == ScalePhase::Times::once) return 1.0;
  return times == ScalePhase::Times::newton_iterations ? point.newton_iterations : point.linear_iterations;
}

/// The plan of a point's scene on its ranks; discarded if there is none.
Json plan_of(const ScaleOptions& options, const ScalePoint& point, const std::string& directory) {
  std::vector<std::string> command{this_program(), "scale", options.scene, "--plan", std::to_string(point.ranks), "-o", directory, "--quiet"};
  for (const std::string& setting : point.settings) command.insert(command.end(), {"--set", setting});
  if (run_process(command).code != static_cast<int>(ExitCode::done)) return Json(nullptr);
  std::ifstream file(directory + "/plan.json");
  const Json plan = Json::parse(file, nullptr, false);
  return plan.is_discarded() ? Json(nullptr) : plan.at("work");
}

double misfit(const std::vector<MeasuredWork>& runs, const PhaseRate& rate) {
  double sum = 0.0;
  for (const MeasuredWork& run : runs) {
    const double relative = (rate.rank * run.most + rate.whole * run.whole) / run.seconds - 1.0;
    sum += relative * relative;
  }
  return sum;
}

}  // namespace

// Least squares of (a most + b whole) / seconds = 1 with a, b >= 0: the minimum is inside, or on one of the two edges.
PhaseRate fitted_rate(const std::vector<MeasuredWork>& runs) {
  double mm = 0.0, mw = 0.0, ww = 0.0, m1 = 0.0, w1 = 0.0;
  std::vector<MeasuredWork> used;
  for (const MeasuredWork& run : runs) {
    if (run.seconds <= 0.0 || run.whole <= 0.0) continue;
    used.push_back(run);
    const double m = run.most / run.seconds, w = run.whole / run.seconds;
    mm += m * m, mw += m * w, ww += w * w, m1 += m, w1 += w;
  }
  if (used.empty()) return {};
  PhaseRate best;
  best.rank = m1 / mm;
  const PhaseRate edge{0.0, w1 / ww};
  if (misfit(used, edge) < misfit(used, best)) best = edge;
  const double determinant = mm * ww - mw * mw;
  if (determinant > 1e-10 * mm * ww) {
    const PhaseRate inside{(m1 * ww - w1 * mw) / determinant, (w1 * mm - m1 * mw) / determinant};
    if (inside.rank >= 0.0 && inside.whole >= 0.0) best = inside;
  }
  return best;
}

void write_measured_machine(const RCP<const Communicator>& comm, const ScaleOptions& options, const std::vector<ScalePoint>& points,
                            MachineFile machine, OutputDirectory& directory, RunLog& log) {
  const auto none = [&](const std::string& why) { log.info("no machine.xml for plans: " + why); };
  std::vector<PlannedPoint> planned;
  OutputDirectory plans = directory.subdirectory("plans");
  bool is_direct = false;
  for (const ScalePoint& point : points) {
    if (!point.finished) continue;
    is_direct = is_direct || point.linear_iterations == 0.0;
    if (is_direct) break;
    planned.push_back({&point, plan_of(options, point, plans.subdirectory(point.name()).path())});
    if (planned.back().work.is_null()) planned.pop_back();
  }
  directory.remove("plans");
  if (is_direct) return none("a run had a direct solver, and plans are for the iterative one; --set \"linear solver/type=iterative\" measures it");
  if (planned.empty()) return none("no run has finished, or none could be planned");
  for (std::size_t p = 0; p < scale_phases().size(); ++p) {
    const ScalePhase& phase = scale_phases()[p];
    std::vector<MeasuredWork> runs;
    for (const PlannedPoint& one : planned) {
      const double count = count_of(*one.point, phase.times);
      const double slow = phase.streams ? slowdown(machine, one.point->ranks) : 1.0;
      const Json& work = one.work.at(phase.name);
      runs.push_back({count * slow * work.at("most").get<double>(), count * work.at("whole").get<double>(), one.point->phases[p]});
    }
    machine.rates[p] = fitted_rate(runs);
  }
  const ScalePoint& largest = *planned.back().point;
  machine.measured_scene = options.scene;
  for (const std::string& setting : largest.settings) machine.measured_scene += " --set " + setting;
  machine.newton_iterations = static_cast<int>(largest.newton_iterations);
  machine.linear_iterations = static_cast<int>(largest.linear_iterations);
  write_file(*comm, directory.claim("machine.xml"), [&] { return to_machine_xml(machine); });
  log.info("rates for plans: " + directory.file("machine.xml"));
}

}  // namespace mortise
