#pragma once
// Scaling of a scene: runs on growing numbers of ranks, and plans for numbers that are not here.

#include <optional>
#include <string>
#include <vector>

#include "mortise/core/log.hpp"
#include "mortise/core/types.hpp"
#include "mortise/simulation/run/output/exit_code.hpp"

namespace mortise {

/// A variable of the scene that grows with the number of ranks: value p^(1/dimension), rounded to a multiple.
struct WeakVariable {
  std::string name;
  int multiple = 1;
};

/// Settings for measuring or planning scaling.
struct ScaleOptions {
  std::string scene;                  ///< file
  std::vector<std::string> settings;  ///< "path=value", as `--set` takes them
  std::string directory;              ///< where results go; empty: default_directory(scene) + "-scale"
  int ranks = 0;                      ///< most ranks of the series; 0: the cores of this machine
  int repeats = 1;                    ///< runs of each point; the fastest counts
  std::optional<WeakVariable> weak;   ///< a weak series as well
  int plan = 0;                       ///< ranks to plan for instead; 0: measure
  Verbosity verbosity = Verbosity::normal;
  std::string version;  ///< of the program
};

/// Runs the scene on 1, 2, 4 ... ranks, each run a process of its own of this same program, which therefore must not have started MPI; `comm` has one
/// rank. Between the runs measures the memory bandwidth of as many processes. Leaves in the directory: runs/<series>_<ranks> with the results of each
/// point, scale.csv, scale.json, scale.svg and report.html. A run that fails is written down with its reason; then not_converged is returned.
/// Throws InputError: a scene or variable that is not there; FileError: what cannot be read, written or drawn.
ExitCode run_scale(const RCP<const Communicator>& comm, const ScaleOptions& options);

/// Shares the scene out to options.plan ranks on this one, by the very choices that runs make, and runs nothing. Leaves plan.csv, plan.json and, with
/// matplotlib, plan.svg. Throws InputError and FileError as run_scale(), and for more than one rank here.
ExitCode plan_scale(const RCP<const Communicator>& comm, const ScaleOptions& options);

}  // namespace mortise
