#pragma once
// Everything that follows the steps of a run: the table of iterations, newton.csv, history.csv, steps.jsonl, profiles.csv, fields.

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "mortise/io/csv_writer.hpp"
#include "mortise/io/field_writer.hpp"
#include "mortise/io/line_file.hpp"
#include "mortise/io/output_directory.hpp"
#include "mortise/simulation/model/run_log.hpp"
#include "mortise/simulation/run/output/step_evaluation.hpp"
#include "run/output/run_record.hpp"

namespace mortise {

/// Files and log of the steps. Collective in all members.
class RunOutput {
 public:
  /// Begins the files; or goes on with those of a run from the step of a checkpoint.
  /// @param checkpoint  null: a new run
  RunOutput(const RCP<const Communicator>& comm, const Scene& scene, OutputDirectory& directory, const RCP<const Mesh>& mesh,
            StepEvaluation& evaluation, RunLog& log, RunRecord& record, const Timers& timers, StateArchive* checkpoint);

  /// Functions that the stepper calls.
  StepperObserver functions();

  /// The steps are over: a try that was interrupted is marked as stopped.
  void end_steps() { write_last_iteration("stopped"); }

  /// Writes fields and profiles of the last accepted state, if that has not been done.
  void finish(const std::function<SystemEvaluation()>& last_state);

  /// Stores how far the files go, once they are on the disk.
  void store(StateArchive& archive);

 private:
  /// Bytes that files have; 0: there is no such file.
  struct FileSizes {
    std::uintmax_t newton = 0, history = 0, steps = 0, profiles = 0;
  };

  void begin(int step, double time, double dt);
  void add(const NewtonIteration& iteration);
  void write_last_iteration(const std::string& undone);
  void undo(const StepFailure& failure);
  void accept(const StepReport& report, const SystemEvaluation& at);
  double seconds_left(double time) const;
  bool is_output_time(double time) const;
  int last_fields() const { return field_steps_.empty() ? 0 : field_steps_.back(); }
  void write_fields(const SystemEvaluation& at);
  void write_profiles(const SystemEvaluation& at);
  void restore(const RCP<const Communicator>& comm, StateArchive& archive);
  void report_missing_fields();
  void serialize_sizes(StateArchive& archive, FileSizes& sizes);

  const Scene& scene_;
  OutputDirectory& directory_;
  StepEvaluation& evaluation_;
  RunLog& log_;
  RunRecord& record_;
  Timers timers_;
  std::unique_ptr<CsvWriter> newton_, history_, profiles_;
  std::unique_ptr<LineFile> steps_;
  std::vector<CsvValue> last_iteration_;
  std::unique_ptr<FieldWriter> fields_;
  bool writes_fields_ = false, writes_profiles_ = false;
  bool has_fields_ = false;       ///< this run, or an earlier part of it, has written some
  std::vector<int> field_steps_;  ///< of which steps it has
  int step_ = 0, try_ = 0;
  double time_ = 0.0, dt_ = 0.0, begin_time_ = 0.0;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

}  // namespace mortise
