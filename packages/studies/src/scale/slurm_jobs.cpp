#include "scale/slurm_jobs.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <boost/algorithm/string.hpp>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>

#include "shared/run_process.hpp"

namespace mortise {
namespace {

// Predictions are of a mean machine and of counts that may change with the mesh. A job that is killed costs more than one that ends early.
constexpr double time_margin = 2.0, memory_margin = 1.5, start_seconds = 120.0;

std::string in_quotes(const std::string& word) {
  const bool plain = !word.empty() && std::all_of(word.begin(), word.end(), [](unsigned char c) {
    return std::isalnum(c) != 0 || std::string("_-./:=,+@%").find(static_cast<char>(c)) != std::string::npos;
  });
  return plain ? word : "'" + boost::algorithm::replace_all_copy(word, "'", "'\\''") + "'";
}

std::string in_shell(const std::vector<std::string>& words) {
  std::vector<std::string> quoted;
  for (const std::string& word : words) quoted.push_back(in_quotes(word));
  return fmt::format("{}", fmt::join(quoted, " "));
}

/// "1-02:03:04", as Slurm takes it.
std::string duration(double seconds) {
  const auto minutes = static_cast<long>(std::ceil(seconds / 60.0));
  return fmt::format("{}-{:02}:{:02}:00", minutes / 1440, minutes / 60 % 24, minutes % 60);
}

/// The first line of a file; none if there is no such file.
std::optional<std::string> line_of(const std::string& path) {
  std::ifstream file(path);
  std::string line;
  if (!file) return std::nullopt;
  std::getline(file, line);
  return boost::algorithm::trim_copy(line);
}

/// The number that a file holds; none if there is no such file, or no number in it.
std::optional<int> exit_code(const std::string& path) {
  const auto line = line_of(path);
  int code = 0;
  if (!line || std::from_chars(line->data(), line->data() + line->size(), code).ec != std::errc()) return std::nullopt;
  return code;
}

/// The end of what a file holds.
std::string end_of(const std::string& path) {
  constexpr std::size_t most = 2000;
  std::ifstream file(path);
  std::stringstream content;
  content << file.rdbuf();
  const std::string text = boost::algorithm::trim_copy(content.str());
  return text.size() <= most ? text : "... " + text.substr(text.size() - most);
}

/// State of a job in the queue, as squeue names it; empty if it is not there; none if there is no squeue to ask.
std::optional<std::string> in_queue(const std::string& id) {
  const ProcessEnding ending = run_process({"squeue", "--noheader", "--jobs", id, "--format", "%T"});
  if (ending.code == 126 || ending.code == 127) return std::nullopt;
  return ending.code == 0 ? ending.last_line() : "";  // squeue fails for jobs that ended long ago
}

}  // namespace

std::string JobFiles::of_repeat(const ScalePoint& point, int repeat, const std::string& what) const {
  return fmt::format("{}/{}.{}.{}", jobs(), point.name(), repeat, what);
}

std::string JobFiles::results(const ScalePoint& point, int repeat) const {
  return fmt::format("{}/runs/{}/repeat_{}", directory_, point.name(), repeat);
}

std::string job_script(const ScaleOptions& options, const ScalePoint& point, const ScalePrediction& prediction, const MachineFile& machine,
                       const JobFiles& files) {
  std::string text = fmt::format("#!/bin/bash\n# Made by `mortise scale --batch slurm`, which replaces it when it is called again.\n");
  const auto set = [&](const std::string& option) { text += "#SBATCH " + option + "\n"; };
  set("--job-name=mortise-" + point.name());
  set(fmt::format("--nodes={}", prediction.nodes));
  set(fmt::format("--ntasks={}", point.ranks));
  set(fmt::format("--ntasks-per-node={}", std::min(point.ranks, machine.cores_per_node)));
  set("--cpus-per-task=1");
  set("--exclusive");
  set(fmt::format("--mem={}M", static_cast<long>(std::ceil(std::min(memory_margin * prediction.memory_per_node, machine.memory_per_node)))));
  if (!prediction.phases.empty()) set("--time=" + duration(start_seconds + time_margin * options.repeats * prediction.seconds));
  set("--output=\"" + boost::algorithm::replace_all_copy(files.log(point), "%", "%%") + "\"");  // Slurm puts values in the place of %x
  set("--open-mode=append");
  text += "export OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1\n";
  // A scene that is edited while jobs wait would be another one in some points of a series.
  text += fmt::format("if ! cmp -s {} {}; then\n  echo {} | tee {} >&2\n  echo {} > {}\n  exit {}\nfi\n", in_quotes(options.scene),
                      in_quotes(files.scene()),
                      in_quotes(options.scene + " is another one than when the jobs were written; call mortise scale --batch again"),
                      in_quotes(files.of_repeat(point, 1, "said")), static_cast<int>(ExitCode::invalid_input),
                      in_quotes(files.of_repeat(point, 1, "exit")), static_cast<int>(ExitCode::invalid_input));
  for (int repeat = 1; repeat <= options.repeats; ++repeat) {
    const auto file = [&](const std::string& what) { return in_quotes(files.of_repeat(point, repeat, what)); };
    const std::vector<std::string> run = command_of_run(options.launcher, options.scene, point.settings, point.ranks, files.results(point, repeat));
    text += fmt::format("\ncode=$(cat {} 2>/dev/null)\nif [ \"$code\" != {} ] && [ \"$code\" != {} ]; then\n", file("exit"),
                        static_cast<int>(ExitCode::done), static_cast<int>(ExitCode::check_missed));
    text += fmt::format("  rm -f {}\n  date > {}\n", file("exit"), file("started"));
    text += fmt::format("  {} > {} 2>&1\n  code=$?\n  echo $code > {}\n", in_shell(run), file("said"), file("exit"));
    text += fmt::format("  if [ $code != {} ] && [ $code != {} ]; then exit $code; fi\nfi\n", static_cast<int>(ExitCode::done),
                        static_cast<int>(ExitCode::check_missed));
  }
  return text;
}

std::string submit_script(const ScaleOptions& options, const std::vector<ScalePoint>& points, const JobFiles& files) {
  std::string text = fmt::format(R"sh(#!/bin/bash
# Made by `mortise scale --batch slurm`: submits the runs that neither have finished nor are in the queue.
# Options of sbatch for all of them: submit.sh --account=... --partition=...
status=0
sbatch_options=("$@")

# Whether files hold exit codes of runs that came to their end.
finished() {{
  local file
  for file in "$@"; do
    case $(cat "$file" 2>/dev/null) in
      {} | {}) ;;
      *) return 1 ;;
    esac
  done
}}

# submit NAME SCRIPT FILE-OF-NUMBER EXIT-CODE...
submit() {{
  local name=$1 script=$2 number=$3 id file
  shift 3
  id=$(cat "$number" 2>/dev/null)
  if finished "$@"; then
    echo "$name: has finished"
  elif [ -n "$id" ] && [ -n "$(squeue --noheader --jobs "$id" --format %T 2>/dev/null)" ]; then
    echo "$name: in the queue as job $id"
  else
    # Nothing of an earlier job may pass for the state of this one.
    for file in "$@"; do finished "$file" || rm -f "$file" "${{file%.exit}}.started" "$number"; done
    if id=$(sbatch --parsable "${{sbatch_options[@]}}" "$script"); then
      echo "${{id%%;*}}" >"$number"
      echo "$name: job ${{id%%;*}}"
    else
      echo "$name: sbatch did not take it" >&2
      status=1
    fi
  fi
}}

)sh",
                                 static_cast<int>(ExitCode::done), static_cast<int>(ExitCode::check_missed));
  for (const ScalePoint& point : points) {
    std::vector<std::string> words{"submit", point.name(), files.script(point), files.id(point)};
    for (int repeat = 1; repeat <= options.repeats; ++repeat) words.push_back(files.of_repeat(point, repeat, "exit"));
    text += in_shell(words) + "\n";
  }
  return text + "exit $status\n";
}

void take_jobs(const ScaleOptions& options, ScalePoint& point, const JobFiles& files) {
  for (int repeat = 1; repeat <= options.repeats; ++repeat) {
    if (const auto code = exit_code(files.of_repeat(point, repeat, "exit"))) {
      std::string said = end_of(files.of_repeat(point, repeat, "said"));
      const std::string log = end_of(files.log(point));
      if (!log.empty()) said += (said.empty() ? "" : "\n") + std::string("Its log:\n") + log;  // what Slurm itself says of a job that it ended
      if (take_run(point, files.results(point, repeat), *code, said)) continue;
      // A run that ended well and left nothing has to be run again: submit.sh goes by this file.
      std::error_code ignored;
      std::filesystem::remove(files.of_repeat(point, repeat, "exit"), ignored);
      return;
    }
    point.finished = false;
    const bool started = line_of(files.of_repeat(point, repeat, "started")).has_value();
    const auto id = line_of(files.id(point));
    const auto queue = id ? in_queue(*id) : std::optional<std::string>("");
    const std::string job = id ? "job " + *id : "its job";
    if (!queue || !queue->empty()) {
      point.state = started ? "running" : "waiting";
      point.said = queue ? fmt::format("{}: {}", job, *queue)
                         : fmt::format("{} {}; there is no squeue here to ask", job, started ? "has begun" : "was submitted");
    } else if (started || id) {
      point.state = "failed";
      const std::string log = end_of(files.log(point));
      point.said = fmt::format("{} is not in the queue any more, and its run has not come to an end. A limit of time or memory may have ended it. {}",
                               job, log.empty() ? "It has no log" : "Its log:\n" + log);
    } else {
      point.state = "missing";
      point.said = "was not submitted";
    }
    return;
  }
}

}  // namespace mortise
