#include "study/study_record.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <boost/algorithm/string.hpp>
#include <cmath>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>

#include "mortise/input/xml.hpp"
#include "mortise/io/files.hpp"
#include "mortise/io/output_directory.hpp"
#include "mortise/studies/convergence.hpp"
#include "shared/run_process.hpp"

namespace mortise {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* impossible = "not possible by the peer";
constexpr double none = std::numeric_limits<double>::quiet_NaN();
constexpr int done = static_cast<int>(ExitCode::done), missed = static_cast<int>(ExitCode::check_missed),
              not_converged = static_cast<int>(ExitCode::not_converged);

double number(const Json& json) { return json.is_number() ? json.get<double>() : none; }

constexpr const char* study_record_name = "study-point.json";

std::string record_of(const StudyPointOptions& options) { return options.directory + "/" + study_record_name; }

/// Data that decides on the results and times of a point.
Json identity(const StudyPoint& point, const StudyPointOptions& options) {
  Json identity{
      {"text", options.text}, {"settings", point.words()}, {"ranks", point.ranks}, {"repeats", options.repeats}, {"version", options.version}};
  if (point.peer != Peer::none) identity["peer"] = peer_title(point.peer);
  if (!point.penalty.value.empty()) identity["peer penalty"] = point.penalty.value;
  return identity;
}

/// Name of the processor, for the environment that times are of.
std::string processor() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);)
    if (boost::starts_with(line, "model name")) return boost::trim_copy(line.substr(line.find(':') + 1));
  return "unknown";
}

/// Part of a summary for the report; an empty object if there is none.
Json excerpt(const std::string& path) {
  std::ifstream file(path);
  const Json summary = Json::parse(file, nullptr, false);
  if (summary.is_discarded()) return Json::object();
  std::size_t iterations = 0, cutbacks = 0;
  for (const auto& step : summary.at("steps")) {
    iterations += step.at("newton").size() - step.value("solves", 1);  // the first entry of each solve is the state before it
    cutbacks += step.at("cutbacks").get<std::size_t>();
  }
  Json kept;
  for (const char* name : {"dofs", "quantities", "time", "memory_total_mib"}) kept[name] = summary.at(name);
  if (summary.contains("peer")) kept["peer"] = summary.at("peer");
  if (const Json stopped = summary.value("stopped", Json()); stopped.is_string()) kept["interrupted"] = stopped;
  kept["missed"] = Json::array();
  for (const auto& check : summary.at("checks"))
    if (!check.at("ok").get<bool>())
      kept["missed"].push_back(fmt::format("{}: {} = {}, bounds {} to {}", check.at("name").get<std::string>(),
                                           check.at("quantity").get<std::string>(), check.at("value").dump(), check.at("low").dump(),
                                           check.at("high").dump()));
  kept["steps"] = summary.at("steps").size();
  kept["newton_iterations"] = iterations;
  kept["cutbacks"] = cutbacks;
  return kept;
}

std::string stopped_status(double limit) { return fmt::format("stopped after {:g} s: time limit of the study", limit); }

std::vector<std::string> command_of(const StudyPoint& point, const StudyPointOptions& options) {
  if (point.peer == Peer::none) return command_of_run(options.launcher, options.scene, point.words(), point.ranks, options.directory);
  return command_of_peer(options.scene, point.words(), peer_name(point.peer), point.penalty.value, options.directory);
}

/// Time and memory of a run: those of its process, or of the peer's, without what it took to write its deck and to read its results.
Json measured(const StudyPoint& point, const ProcessEnding& ending, const Json& summary) {
  const Json time = summary.value("time", Json::object());
  if (summary.contains("peer")) {
    const Json& peer = summary["peer"];
    return {{"wall_s", peer.at("wall_s")}, {"cpu_s", peer.at("cpu_s")}, {"memory_mib", peer.at("memory_mib")}, {"time", time}};
  }
  // The largest process is all of them only if it is the only one.
  const Json memory = point.ranks == 1 ? Json(ending.memory_mib) : summary.value("memory_total_mib", Json());
  return {{"wall_s", ending.wall_seconds}, {"cpu_s", ending.cpu_seconds}, {"memory_mib", memory}, {"time", time}};
}

OutputDirectory directory_of_run(const Communicator& comm, const StudyPointOptions& options) {
  return OutputDirectory(Teuchos::rcpFromRef(comm), options.directory, {"run"});
}

Json empty_record(const StudyPoint& point, const StudyPointOptions& options) {
  return {{"identity", identity(point, options)},
          {"exit", static_cast<int>(ExitCode::files)},
          {"said", ""},
          {"date", fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)))},
          {"processor", processor()},
          {"repeats", Json::array()},
          {"summary", Json::object()}};
}

/// Runs the point in its directory, which is empty, and writes down what came of it.
void run_all(const Communicator& comm, const StudyPoint& point, const StudyPointOptions& options, Json& record) {
  record["absent"] = missing_program(point.peer);
  if (record["absent"] != "") {
    record["said"] = "not installed: " + record["absent"].get<std::string>();
    return;
  }
  for (int repeat = 0; repeat < options.repeats; ++repeat) {
    if (repeat > 0) directory_of_run(comm, options).begin_run();
    const std::vector<std::string> command = command_of(point, options);
    const ProcessEnding ending = run_process(command, point.time_limit);
    record["exit"] = ending.code;
    record["said"] = said_at_end(command, ending);
    if (ending.stopped) {
      record["stopped_after"] = point.time_limit;
      record["said"] = boost::trim_left_copy(ending.output + "\n" + stopped_status(point.time_limit) + "; with a larger one it is run again");
    }
    record["summary"] = excerpt(options.directory + "/summary.json");
    if (point.peer != Peer::none && !ending.stopped && !record["summary"].contains("peer")) break;  // it was not started
    record["repeats"].push_back(measured(point, ending, record["summary"]));
    if (ending.stopped || (ending.code != done && ending.code != missed)) break;
  }
}

StudyRecord to_record(const Json& json, const StudyPoint& point) {
  StudyRecord record;
  record.exit = json.at("exit");
  record.said = json.at("said");
  record.absent = json.value("absent", "");
  if (json.contains("stopped_after")) record.stopped_after = json.at("stopped_after");
  record.by_peer = point.peer != Peer::none;
  record.date = json.at("date");
  record.processor = json.at("processor");
  std::map<std::string, std::vector<double>> measured, times;
  for (const auto& repeat : json.at("repeats")) {
    for (const char* name : {"wall_s", "cpu_s", "memory_mib"})
      if (repeat.at(name).is_number()) measured[name].push_back(repeat.at(name));
    for (const auto& [name, seconds] : repeat.at("time").items()) times[name].push_back(seconds);
  }
  const auto middle = [&](const char* name) { return measured[name].empty() ? none : median(measured[name]); };
  record.wall = middle("wall_s"), record.cpu = middle("cpu_s"), record.memory = middle("memory_mib");
  for (const auto& [name, seconds] : times) record.time[name] = median(seconds);
  const Json& summary = json.at("summary");
  const auto value = [&](const char* name) { return summary.contains(name) ? number(summary.at(name)) : none; };
  record.dofs = value("dofs"), record.steps = value("steps"), record.newton_iterations = value("newton_iterations");
  record.cutbacks = value("cutbacks");
  record.interrupted = summary.value("interrupted", "");
  record.missed_checks = summary.value("missed", std::vector<std::string>());
  const Json quantities = summary.value("quantities", Json::object());
  for (const auto& name : point.quantities) record.quantities.push_back(quantities.contains(name) ? number(quantities.at(name)) : none);
  return record;
}

}  // namespace

bool StudyRecord::finished() const { return !stopped_after && (exit == done || exit == missed); }

std::string StudyRecord::status() const {
  if (excused()) return "not installed: " + absent;
  if (stopped_after) return stopped_status(*stopped_after);
  if (by_peer && exit == static_cast<int>(ExitCode::invalid_input)) return impossible;
  if (exit == done) return "done";
  if (exit == missed) return "check missed";
  if (exit == not_converged) return interrupted.empty() ? "not converged" : "stopped by " + interrupted;
  return exit > 128 ? fmt::format("killed by signal {}", exit - 128) : fmt::format("exit code {}", exit);
}

std::optional<StudyRecord> earlier_record(const Communicator& comm, const StudyPoint& point, const StudyPointOptions& options) {
  if (!std::filesystem::is_regular_file(record_of(options))) return {};
  const Json found = Json::parse(read_text(comm, record_of(options)), nullptr, false);
  if (found.is_discarded() || found.value("identity", Json()) != identity(point, options)) return {};
  StudyRecord record = to_record(found, point);
  record.reused = true;
  if (record.stopped_after) return *record.stopped_after >= point.time_limit ? std::optional<StudyRecord>(record) : std::nullopt;
  const bool may_be_had_again = record.finished() || (record.exit == not_converged && record.interrupted.empty());
  return may_be_had_again || record.status() == impossible ? std::optional<StudyRecord>(record) : std::nullopt;
}

StudyRecord run_point(const Communicator& comm, const StudyPoint& point, const StudyPointOptions& options) {
  Json record = empty_record(point, options);
  try {
    // Nothing of an earlier run may pass for results of one that fails.
    directory_of_run(comm, options).begin_run();
  } catch (const FileError& error) {
    record["said"] = error.what();
    return to_record(record, point);
  }
  run_all(comm, point, options, record);
  OutputDirectory directory = directory_of_run(comm, options);
  directory.continue_run();
  write_json(comm, directory.claim(study_record_name), record);
  return to_record(record, point);
}

}  // namespace mortise
