#include "hard/hard_outcome.hpp"

#include <algorithm>
#include <limits>

namespace mortise {

void HardOutcome::name_figures(const HardRun& run, const std::string& prefix, HardNames& names) const {
  names.add(prefix + "t", time);
  names.add(prefix + "steps", steps);
  names.add(prefix + "iterations", iterations);
  names.add(prefix + "cutbacks", cutbacks);
  const auto output = record.time.find("output");
  names.add(prefix + "output_seconds", output == record.time.end() ? std::numeric_limits<double>::quiet_NaN() : output->second);
  const std::size_t count = record.quantities.size();
  for (std::size_t i = 0; i < run.point.quantities.size(); ++i) {
    // A run that was stopped by its time limit has no summary, but the steps that it accepted.
    const auto column = history.find(run.point.quantities[i]);
    const bool of_history = i >= count && column != history.end() && !column->second.empty();
    names.add(prefix + run.point.quantities[i], i < count    ? record.quantities[i]
                                                : of_history ? number_of(column->second.back())
                                                             : std::numeric_limits<double>::quiet_NaN());
  }
}

HardOutcome run_hard_line(const Communicator& comm, const HardRun& run, int ranks, const std::string& directory, const std::string& version,
                          const Launcher& launcher) {
  StudyPoint point = run.point;
  point.ranks = ranks;
  point.time_limit *= ranks;  // there may be more ranks than cores
  const StudyPointOptions options{run.scene, run.text, directory, version, 1, launcher};
  const auto earlier = earlier_record(comm, point, options);
  HardOutcome outcome;
  // One that ran into its time limit is run again: the machine may have been busy.
  outcome.record = earlier && !earlier->stopped_after ? *earlier : run_point(comm, point, options);
  outcome.history = read_table(directory + "/history.csv");
  const auto times = outcome.history.find("time");
  if (times != outcome.history.end() && !times->second.empty()) {
    outcome.steps = static_cast<int>(times->second.size());
    outcome.time = number_of(times->second.back());
  }
  TextTable newton = read_table(directory + "/newton.csv");
  const auto count = [](const std::vector<std::string>& cells, auto&& counts) {
    return static_cast<int>(std::count_if(cells.begin(), cells.end(), counts));
  };
  outcome.cutbacks = count(newton["undone"], [](const std::string& cell) { return !cell.empty(); });
  outcome.iterations = count(newton["iteration"], [](const std::string& cell) { return cell != "0"; });
  return outcome;
}

}  // namespace mortise
