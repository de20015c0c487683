#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>

#include "hard/hard_report.hpp"
#include "mortise/core/names.hpp"
#include "mortise/io/files.hpp"
#include "mortise/io/output_directory.hpp"
#include "mortise/simulation/model/run_log.hpp"
#include "mortise/studies/hard.hpp"

namespace mortise {
namespace {

/// Results are of one build of the program: its version does not tell two builds apart.
std::string build_of(const std::string& version) {
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe");
  return fmt::format("{}, {} bytes of {}", version, std::filesystem::file_size(program),
                     std::filesystem::last_write_time(program).time_since_epoch().count());
}

/// Runs lines, and each companion once however many lines it stands beside.
class Runner {
 public:
  Runner(const RCP<const Communicator>& comm, const HardPlan& plan, const HardOptions& options, const OutputDirectory& directory)
      : comm_(comm), plan_(plan), options_(options), directory_(directory), build_(build_of(options.version)) {}

  HardRow run(const HardLine& line, int ranks) {
    const auto& one = plan_.case_of(line);
    OutputDirectory folder = directory_.subdirectory(name_for_files(one.name));
    if (!line.label.empty()) folder = folder.subdirectory(name_for_files(line.label));
    HardRow row{&line, ranks, outcome_of(line.run, ranks, folder, run_name(ranks)), {}};
    std::vector<HardOutcome> companions;
    for (std::size_t c = 0; c < line.companions.size(); ++c)
      companions.push_back(outcome_of(line.companions[c], options_.ranks.front(), folder, name_for_files(one.value.companions[c].name)));
    row.verdict = judge(one, line, row.outcome, companions);
    return row;
  }

 private:
  const HardOutcome& outcome_of(const HardRun& run, int ranks, OutputDirectory& folder, const std::string& name) {
    std::string key = fmt::format("{} on {}", run.scene, ranks);
    for (const auto& word : run.point.words()) key += "\n" + word;
    const auto known = outcomes_.find(key);
    if (known != outcomes_.end()) return known->second;
    return outcomes_[key] = run_hard_line(*comm_, run, ranks, folder.subdirectory(name).path(), build_, options_.launcher);
  }

  RCP<const Communicator> comm_;
  const HardPlan& plan_;
  const HardOptions& options_;
  OutputDirectory directory_;
  std::string build_;
  std::map<std::string, HardOutcome> outcomes_;
};

/// "; about 12 s left": the runs to come take as long as those that were made.
std::string left(double seconds, std::size_t done, std::size_t all) {
  if (done == 0 || done == all) return "";
  return fmt::format("; about {:.0f} s left", std::ceil(seconds / static_cast<double>(done) * static_cast<double>(all - done)));
}

}  // namespace

std::string list_hard(const RCP<const Communicator>& comm, const HardOptions& options) {
  const HardPlan plan = read_hard(*comm, options);
  std::string text;
  for (std::size_t number = 0; number < plan.cases.size(); ++number) {
    const auto lines = std::count_if(plan.lines.begin(), plan.lines.end(), [&](const HardLine& line) { return line.number == number; });
    text += fmt::format("{:<32} {:>3}  {}\n", plan.cases[number].name, lines, plan.cases[number].value.hard);
  }
  return text;
}

ExitCode run_hard(const RCP<const Communicator>& comm, const HardOptions& options) {
  RunLog log(comm, options.verbosity);
  const HardPlan plan = read_hard(*comm, options);
  require_launcher(options.launcher);
  OutputDirectory directory(comm, options.directory.empty() ? "results/hard" : options.directory,
                            {"hard cases", options.ledger, options.directory.empty()});
  std::vector<std::string> cases, names = hard_pages();
  for (const auto& one : plan.cases) cases.push_back(name_for_files(one.name));
  names.insert(names.end(), cases.begin(), cases.end());
  directory.open(names);
  for (const auto& old : options.fresh ? names : hard_pages()) directory.remove(old);

  Runner runner(comm, plan, options, directory);
  std::vector<HardRow> rows;
  const auto ranks_of = [&](const HardLine& line) {
    return plan.case_of(line).value.every_ranks ? options.ranks : std::vector<int>{options.ranks.front()};
  };
  std::size_t all = 0;
  for (const HardLine& line : plan.lines) all += ranks_of(line).size();
  rows.reserve(all);
  double seconds = 0.0;
  for (const HardLine& line : plan.lines) {
    const std::size_t first = rows.size();
    for (const int ranks : ranks_of(line)) {
      rows.push_back(runner.run(line, ranks));
      HardRow& row = rows.back();
      if (rows.size() - 1 > first) compare_ranks(rows[first].verdict, rows[first].ranks, row.verdict);
      if (std::isfinite(row.outcome.record.wall)) seconds += row.outcome.record.wall;
      std::string said = fmt::format("{}/{} {}{}{}: {}", rows.size(), all, plan.case_of(line).name, line.label.empty() ? "" : ", " + line.label,
                                     options.ranks.size() > 1 ? fmt::format(", {} rank(s)", ranks) : "", to_string(row.verdict.verdict));
      if (row.outcome.record.reused) said += ", run of an earlier call";
      log.info(said + fmt::format(", {:.1f} s", row.outcome.record.wall) + left(seconds, rows.size(), all));
      if (!row.verdict.why.empty()) log.info("  " + row.verdict.why);
    }
  }
  write_hard_table(comm, directory.claim("ledger.csv"), plan, rows);
  write_file(*comm, directory.claim("hard-cases.md"), [&] { return hard_markdown(plan, rows, options.version); });
  write_file(*comm, directory.claim("hard-cases.html"), [&] { return hard_html(plan, rows, options.version); });
  log.info(count_verdicts(rows) + "; the page: " + directory.file("hard-cases.html"));
  const bool wrong = std::any_of(rows.begin(), rows.end(), [](const HardRow& row) { return row.verdict.verdict == Verdict::wrong; });
  return wrong ? ExitCode::check_missed : ExitCode::done;
}

}  // namespace mortise
