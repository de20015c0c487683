#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>

#include "mortise/input/xml.hpp"
#include "mortise/io/files.hpp"
#include "mortise/io/output_directory.hpp"
#include "mortise/simulation/model/run_log.hpp"
#include "mortise/studies/paper.hpp"
#include "paper/paper_runs.hpp"
#include "shared/draw_plot.hpp"
#include "shared/plot_scripts.hpp"
#include "shared/run_process.hpp"

namespace mortise {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* record_name = "paper-run.json";

/// Data that decides on the results of a run, and so whether those of an earlier one can be taken.
Json identity(const PaperRun& run, const PaperOptions& options) {
  return {{"name", run.name},       {"scene", run.scene},       {"text", scene_of(run).text},
          {"ranks", options.ranks}, {"settings", run.settings}, {"version", options.version}};
}

/// Record of an earlier call at the end of the run, if it was this same run and came to its end.
std::optional<Json> earlier(const Communicator& comm, const std::string& record, const Json& wanted) {
  if (!std::filesystem::exists(record)) return {};
  Json found = Json::parse(read_text(comm, record), nullptr, false);
  if (found.is_discarded() || found.value("identity", Json()) != wanted) return {};
  const int exit = found.value("exit", -1);
  if (exit != static_cast<int>(ExitCode::done) && exit != static_cast<int>(ExitCode::check_missed)) return {};
  found["reused"] = true;
  return found;
}

/// Runs one scene as a user would. `directory` holds scenes/ and the results.
Json run_one(const RCP<const Communicator>& comm, const PaperRun& run, const PaperOptions& options, const std::string& directory) {
  const std::string results = directory + "/" + run.name, scene = directory + "/scenes/" + run.scene + ".xml";
  const Json wanted = identity(run, options);
  const std::string record = results + "/" + record_name;
  if (options.reuse)
    if (auto found = earlier(*comm, record, wanted)) return *found;

  Json json{{"identity", wanted}, {"exit", static_cast<int>(ExitCode::files)}, {"reused", false}, {"seconds", 0.0}, {"said", ""}};
  const Origin origin{"run"};
  try {
    OutputDirectory(comm, results, origin).begin_run();
  } catch (const FileError& error) {
    json["said"] = error.what();
    return json;
  }
  const std::vector<std::string> command = command_of_run(options.launcher, scene, run.settings, options.ranks, results);
  const ProcessEnding ending = run_process(command);
  json["exit"] = ending.code;
  json["seconds"] = ending.wall_seconds;
  json["said"] = said_at_end(command, ending);
  OutputDirectory left(comm, results, origin);
  left.continue_run();
  write_json(*comm, left.claim(record_name), json);
  return json;
}

std::string how_it_ended(const Json& run) {
  const int exit = run.at("exit");
  const std::string misses = run.at("misses");
  std::string text = exit == static_cast<int>(ExitCode::done) ? "done" : fmt::format("exit code {}", exit);
  if (exit == static_cast<int>(ExitCode::check_missed)) text += ", a check missed" + (misses.empty() ? "" : " as expected: " + misses);
  return text + (run.at("reused").get<bool>() ? ", results of an earlier call" : fmt::format(", {:.1f} s", run.at("seconds").get<double>()));
}

/// The worst that happened to the runs of the method itself: what its rival makes of the examples is a result, whatever it is.
ExitCode exit_of(const Json& runs) {
  ExitCode worst = ExitCode::done;
  for (const auto& run : runs) {
    const int exit = run.at("exit");
    if (exit == static_cast<int>(ExitCode::done) || run.at("rival").get<bool>()) continue;
    if (exit != static_cast<int>(ExitCode::check_missed)) return ExitCode::not_converged;
    worst = ExitCode::check_missed;
  }
  return worst;
}

}  // namespace

ExitCode run_paper(const RCP<const Communicator>& comm, const PaperOptions& options) {
  RunLog log(comm, options.verbosity);
  require_launcher(options.launcher);
  OutputDirectory directory(comm, options.directory, {"paper"});
  const std::string page = directory.file("paper.html");
  require_page_python(*comm, page);
  std::vector<PaperRun> wanted;
  for (const auto& run : paper_runs())
    if (options.only.empty() || std::find(options.only.begin(), options.only.end(), run.name) != options.only.end()) wanted.push_back(run);
  std::vector<std::string> names{"paper.html", "paper.json", "scenes"};
  for (const auto& run : wanted) names.push_back(run.name);
  directory.open(names);
  for (const char* old : {"paper.html", "paper.json"}) directory.remove(old);
  OutputDirectory scenes = directory.subdirectory("scenes");
  for (const auto& run : wanted) directory.subdirectory(run.name);

  Json record{{"version", options.version},
              {"program", this_program()},
              {"ranks", options.ranks},
              {"launcher", options.launcher.words},
              {"runs", Json::array()}};
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    const PaperRun& run = wanted[i];
    write_file(*comm, scenes.claim(run.scene + ".xml"), [&] { return scene_of(run).text; });
    log.info(fmt::format("{}/{} {} ...", i + 1, wanted.size(), run.name));
    Json result = run_one(comm, run, options, directory.path());
    result["rival"] = run.is_rival;
    result["misses"] = run.misses;
    log.info(fmt::format("{}/{} {}: {}", i + 1, wanted.size(), run.name, how_it_ended(result)));
    const std::string said = result.at("said");
    if (result.at("exit") != 0 && !run.is_rival) log.warning(run.name + ": " + (said.empty() ? "the page says why" : said));
    record["runs"].push_back(std::move(result));
  }
  write_json(*comm, directory.claim("paper.json"), record);
  directory.claim("paper.html");
  draw_plot(*comm, std::string(page_needs) + paper_page, {directory.path()}, page);
  log.info("the page: " + page);
  return exit_of(record["runs"]);
}

}  // namespace mortise
