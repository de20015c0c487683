#pragma once
// One run of a scene: what it is made of, and its course.

#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "mortise/io/output_directory.hpp"
#include "mortise/simulation/model/model.hpp"
#include "mortise/simulation/model/run_log.hpp"
#include "mortise/simulation/run/output/step_evaluation.hpp"
#include "mortise/simulation/run/run.hpp"
#include "run/output/run_output.hpp"
#include "run/output/run_record.hpp"
#include "run/restart/checkpoints.hpp"
#include "run/restart/restart.hpp"
#include "run/stepping/step_guard.hpp"
#include "run/stepping/step_preparation.hpp"
#include "run/stepping/stop_request.hpp"
#include "run/stepping/watchdog.hpp"

namespace mortise {

/// See run_scene(). Collective in all members.
class Run {
 public:
  /// Builds everything that the run solves for and with. Nothing is written but the log.
  Run(const RCP<const Communicator>& comm, const Scene& scene, const RunOptions& options);

  /// From the first state, or that of a checkpoint, to the summary. To be called once.
  ExitCode execute();

 private:
  // Set-up.
  SemiSmoothSystem make_system();
  void restore();
  void open_results();
  void report_start();
  void begin_steps();

  // The steps.
  void take_steps();
  StepperObserver observer();
  bool rest();
  bool is_interrupted();
  void write_checkpoint();
  void serialize_memory(StateArchive& archive);

  // The end.
  void write_last_state();
  void close_record();
  void report();
  void write_summary();

  RCP<const Communicator> comm_;
  const Scene& scene_;
  const RunOptions& options_;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  RunLog log_;
  Timers timers_;
  std::optional<Watchdog> watchdog_;
  OutputDirectory directory_;
  Model model_;
  StepGuards guards_;
  SemiSmoothSystem system_;
  StepEvaluation evaluation_;
  StepPreparation preparation_;
  RunRecord record_;
  std::optional<Restart> restart_;
  std::optional<RunOutput> output_;

  std::optional<SteppingState> state_;
  std::optional<SystemEvaluation> last_;  ///< of `state_`, in the step that led there; none while another step is tried
  std::optional<StepFailure> failure_;
  std::optional<StopRequest> requests_;
  std::optional<Checkpoints> checkpoints_;
  std::string fingerprint_;             ///< of the scene
  bool is_asked_to_stop_ = false;       ///< then a checkpoint is written at the end
  std::vector<std::string> unwritten_;  ///< why files of the end could not be written
};

}  // namespace mortise
