#include "scale/scale_record.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>

#include "mortise/io/csv_writer.hpp"
#include "mortise/io/output_directory.hpp"
#include "shared/run_process.hpp"

namespace mortise {
namespace {

using Json = nlohmann::ordered_json;

Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }
CsvValue cell(double value) { return std::isfinite(value) ? CsvValue(value) : CsvValue(std::string()); }

const ScalePoint& first_of(const std::vector<ScalePoint>& points, const ScalePoint& point) {
  return *std::find_if(points.begin(), points.end(), [&](const ScalePoint& one) { return one.series == point.series; });
}

/// Takes what a summary says if the run was faster than those before.
void take(const Json& summary, ScalePoint& point) {
  const Json& time = summary.at("time");
  const double total = time.at("total");
  point.repeats.push_back(total);
  if (point.finished && total >= point.seconds) return;
  point.finished = true;
  point.seconds = total;
  point.phases.clear();
  double rest = total;
  for (const ScalePhase& phase : scale_phases()) {
    double seconds = 0.0;
    for (const std::string& timer : phase.timers) seconds += time.value(timer, 0.0);
    rest -= seconds;
    point.phases.push_back(phase.timers.empty() ? rest : seconds);
  }
  point.dofs = summary.at("dofs");
  point.memory_mib = summary.at("memory_total_mib");
  point.newton_iterations = point.linear_iterations = 0.0;
  for (const Json& step : summary.at("steps")) {
    point.newton_iterations += static_cast<double>(step.at("newton").size()) - 1.0;
    for (const Json& iteration : step.at("newton")) point.linear_iterations += iteration.at("linear_iterations").get<double>();
  }
  point.imbalance = 1.0;
  for (const auto& [pair, load] : summary.at("contact").items()) point.imbalance = std::max(point.imbalance, load.at("imbalance").get<double>());
}

}  // namespace

bool ScalePoint::has_grown(const ScalePoint& first) const { return series != "weak" || ranks == first.ranks || dofs > first.dofs; }

double ScalePoint::size_ratio(const ScalePoint& first) const { return series == "weak" ? dofs / (ranks * first.dofs) : 1.0; }

double ScalePoint::efficiency(const ScalePoint& first, double seconds_here, double seconds_first) const {
  if (!finished || !first.finished || seconds_here <= 0.0 || seconds_first <= 0.0) return std::numeric_limits<double>::quiet_NaN();
  if (!has_grown(first)) return std::numeric_limits<double>::quiet_NaN();
  return series == "weak" ? size_ratio(first) * seconds_first / seconds_here : seconds_first / (ranks * seconds_here);
}

bool take_run(ScalePoint& point, const std::string& directory, int code, const std::string& said) {
  // A check that is missed is the scene's affair: the times count.
  const bool well = code == static_cast<int>(ExitCode::done) || code == static_cast<int>(ExitCode::check_missed);
  std::ifstream file(directory + "/summary.json");
  const Json summary = Json::parse(file, nullptr, false);
  if (well && !summary.is_discarded()) {
    take(summary, point);
    point.state = "finished";
    return true;
  }
  point.finished = false;
  point.state = "failed";
  if (well)
    point.said = "it ended with code " + std::to_string(code) + ", but " + directory + "/summary.json is not there or cannot be read";
  else
    point.said = said.empty() ? "it ended with code " + std::to_string(code) : said;
  return false;
}

void run_scale_point(const RCP<const Communicator>& comm, const ScaleOptions& options, ScalePoint& point) {
  for (int repeat = 0; repeat < options.repeats; ++repeat) {
    OutputDirectory(comm, point.directory, {"run"}).begin_run();  // nothing of an earlier repeat may pass for results of one that fails
    const std::vector<std::string> command = command_of_run(options.launcher, options.scene, point.settings, point.ranks, point.directory);
    const ProcessEnding ending = run_process(command);
    if (!take_run(point, point.directory, ending.code, said_at_end(command, ending))) return;
  }
}

Json scale_json(const ScaleOptions& options, const std::vector<ScalePoint>& points) {
  Json json{{"scene", options.scene},     {"settings", options.settings},   {"version", options.version},        {"program", this_program()},
            {"repeats", options.repeats}, {"times", "mean over the ranks"}, {"launcher", options.launcher.words}};
  json["phases"] = Json::array();
  for (const ScalePhase& phase : scale_phases()) json["phases"].push_back(phase.name);
  json["points"] = Json::array();
  for (const ScalePoint& point : points) {
    const ScalePoint& first = first_of(points, point);
    Json one{{"series", point.series},     {"ranks", point.ranks}, {"settings", point.settings},
             {"finished", point.finished}, {"state", point.state}, {"said", point.said}};
    one["bandwidth_gb_s"] = point.bandwidth > 0.0 ? Json(1e-9 * point.bandwidth) : Json(nullptr);
    one["bandwidth_efficiency"] =
        first.bandwidth > 0.0 && point.bandwidth > 0.0 ? Json(point.bandwidth / (point.ranks * first.bandwidth)) : Json(nullptr);
    if (point.finished) {
      one["dofs"] = point.dofs;
      one["newton_iterations"] = point.newton_iterations;
      one["linear_iterations"] = point.linear_iterations;
      one["memory_mib"] = point.memory_mib;
      one["contact_imbalance"] = point.imbalance;
      one["seconds"] = point.seconds;
      one["repeats"] = point.repeats;
      one["efficiency"] = number(point.efficiency(first, point.seconds, first.seconds));
      one["phases"] = Json::object();
      for (std::size_t p = 0; p < scale_phases().size(); ++p)
        one["phases"][scale_phases()[p].name] = {
            {"seconds", point.phases[p]},
            {"efficiency", first.finished ? number(point.efficiency(first, point.phases[p], first.phases[p])) : Json(nullptr)}};
    }
    json["points"].push_back(std::move(one));
  }
  return json;
}

void write_scale_table(const RCP<const Communicator>& comm, const std::string& path, const std::vector<ScalePoint>& points) {
  std::vector<std::string> columns{"series",         "ranks",   "finished",  "dofs", "newton_iterations", "linear_iterations",
                                   "bandwidth_gb_s", "seconds", "efficiency"};
  for (const char* what : {"seconds_", "efficiency_"})
    for (const ScalePhase& phase : scale_phases()) {
      std::string name = what + phase.name;
      std::replace_if(
          name.begin(), name.end(), [](char one) { return one == ' ' || one == '-'; }, '_');
      columns.push_back(name);
    }
  std::vector<std::vector<CsvValue>> rows;
  for (const ScalePoint& point : points) {
    const ScalePoint& first = first_of(points, point);
    std::vector<CsvValue> row{point.series, static_cast<long long>(point.ranks), static_cast<long long>(point.finished)};
    if (point.finished) {
      for (const double value : {point.dofs, point.newton_iterations, point.linear_iterations, 1e-9 * point.bandwidth, point.seconds,
                                 point.efficiency(first, point.seconds, first.seconds)})
        row.push_back(cell(value));
      for (const double seconds : point.phases) row.push_back(cell(seconds));
      for (std::size_t p = 0; p < point.phases.size(); ++p)
        row.push_back(first.finished ? cell(point.efficiency(first, point.phases[p], first.phases[p])) : CsvValue(std::string()));
    }
    row.resize(columns.size(), CsvValue(std::string()));
    rows.push_back(std::move(row));
  }
  CsvWriter(comm, path, columns).rows(rows);
}

}  // namespace mortise
