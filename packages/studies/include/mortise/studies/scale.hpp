#pragma once
// Scaling of a scene: runs on growing numbers of ranks, and plans for numbers that are not here.

#include <optional>
#include <string>
#include <vector>

#include "mortise/core/log.hpp"
#include "mortise/core/types.hpp"
#include "mortise/simulation/run/output/exit_code.hpp"
#include "mortise/studies/launcher.hpp"

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
  int cores = 1;                      ///< of this machine
  std::string machine;                ///< file that a plan predicts times for, or jobs are written for; empty: none
  Launcher launcher;                  ///< of the runs
  Verbosity verbosity = Verbosity::normal;
  std::string version;  ///< of the program
};

/// Runs the scene on 1, 2, 4 ... ranks, each run a process of its own of this same program, which therefore must not have started MPI; `comm` has one
/// rank. Between the runs measures the memory bandwidth of as many processes. Leaves in the directory: runs/<series>_<ranks> with the results of each
/// point, scale.csv, scale.json, scale.svg, report.html and, of the iterative solver, machine.xml. A run that fails is written down with its reason;
/// then not_converged is returned. Throws InputError: a scene or variable that is not there; FileError: what cannot be read, written or drawn.
ExitCode run_scale(const RCP<const Communicator>& comm, const ScaleOptions& options);

/// Shares the scene out to options.plan ranks on this one, by the very choices that runs make, and runs nothing. With a machine it predicts time and
/// memory on several numbers of ranks up to that. Leaves plan.csv, plan.json and, with matplotlib, plan.svg. Throws InputError and FileError as
/// run_scale(), and for more than one rank here.
ExitCode plan_scale(const RCP<const Communicator>& comm, const ScaleOptions& options);

/// Writes job scripts of Slurm for the runs of run_scale(), with the time and memory that are predicted on options.machine, and runs nothing. Leaves
/// in the directory jobs/<series>_<ranks>.sh, submit.sh, scale-jobs.json and planned-machine.xml. Runs that finished earlier are kept. options.ranks:
/// 0 for a whole node. Throws InputError, also for a directory with jobs of another scene or version; FileError.
ExitCode write_scale_jobs(const RCP<const Communicator>& comm, const ScaleOptions& options);

/// Reads the runs of write_scale_jobs() in `directory` and reports them as run_scale() does: those that have not finished are told with their state.
/// `comm` has one rank. Returns not_converged if there are such. Throws FileError.
ExitCode harvest_scale(const RCP<const Communicator>& comm, const std::string& directory, Verbosity verbosity);

}  // namespace mortise
