#pragma once
// Content of a run's checkpoint, and checks that a scene can go on from it.

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "mortise/io/checkpoint_file.hpp"
#include "mortise/nonlinear/load_stepper.hpp"
#include "mortise/simulation/model/model.hpp"
#include "mortise/simulation/model/run_log.hpp"
#include "mortise/simulation/run/output/step_evaluation.hpp"

namespace mortise {

/// A checkpoint that is being read.
struct Restart {
  int step = 0;
  std::string path;
  std::vector<std::string> damaged;  ///< newer ones that are not whole, and why
  std::shared_ptr<CheckpointReader> file;
};

/// Opens a checkpoint in the directory of a run. Collective. Throws FileError on all ranks.
/// @param from_step  that of the checkpoint; none: the newest that is whole
Restart restart_from(const RCP<const Communicator>& comm, const std::string& directory, std::optional<int> from_step);

/// Stores the scene, the loads and where the run stands. Collective.
/// @param fingerprint  of the scene
void store_run(StateArchive& archive, const std::string& fingerprint, const Model& model, const SemiSmoothSystem& system,
               const StepEvaluation& evaluation, const SteppingState& state);

/// Where the run stood. Collective.
/// @param file  that of the scene, for messages
/// @throws InputError on all ranks: the scene is another in what may not change, ends before the checkpoint, or has other loads or supports at its
/// time
SteppingState restore_run(const Restart& restart, const Scene& scene, const std::string& file, const Model& model, const SemiSmoothSystem& system,
                          const StepEvaluation& evaluation);

/// From where the run goes on, and what is damaged.
void report_restart(const Restart& restart, RunLog& log);

}  // namespace mortise
