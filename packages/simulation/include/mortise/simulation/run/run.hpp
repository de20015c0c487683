#pragma once
// A scene from its file to its results.

#include <optional>
#include <string>
#include <vector>

#include "mortise/core/log.hpp"
#include "mortise/core/types.hpp"
#include "mortise/simulation/run/output/exit_code.hpp"

namespace mortise {

struct Scene;

/// From where a run goes on.
struct RestartOptions {
  std::optional<int> step;  ///< that of its checkpoint; none: the newest that is whole
};

/// Settings for running a scene or a point file.
struct RunOptions {
  std::string scene;                  ///< file
  std::vector<std::string> settings;  ///< "path=value", as `--set` takes them
  std::string directory;              ///< where results go; empty: default_directory(scene)
  bool keep = false;                  ///< refuse a directory that holds results instead of replacing them
  Verbosity verbosity = Verbosity::normal;
  std::optional<RestartOptions> restart;  ///< go on with the run in the directory; none: a new run
  std::optional<double> time_limit;       ///< stop in time before so many seconds have passed
  bool supervised = false;                ///< signals stop the run or ask for a checkpoint (StopRequest); a Watchdog looks at the ranks
  std::string launcher = "mpirun";        ///< that starts it on several ranks, for the command to go on with
  std::string version;                    ///< of the program, for the summary
};

/// results/<name of the file without its ending>.
std::string default_directory(const std::string& file);

/// Collective. Runs the scene that was read from options.scene, which holds nothing of a run: it may be run again. Leaves in the directory:
/// summary.json, newton.csv, history.csv, steps.jsonl, effective.xml, log.txt, checkpoints and, if the scene names fields, fields.xdmf and fields/.
/// A scene that cannot be run leaves the directory as it was. Returns done, not_converged (also if it was stopped) or check_missed. Throws on all
/// ranks: InputError, FileError, and StepFailure of kind input if an expression of the scene has no value at a later time; results until then are
/// kept.
ExitCode run_scene(const RCP<const Communicator>& comm, const Scene& scene, const RunOptions& options);

/// Collective. Builds the scene's mesh and all else that a run needs, says on rank 0 what it found; solves nothing, writes nothing.
void inspect_scene(const RCP<const Communicator>& comm, const Scene& scene, const RunOptions& options);

}  // namespace mortise
