#pragma once
// Every example of the paper that the method is taken from (Doca, Andrade Pires and César de Sá, COMPLAS XI, 2011), on one page.

#include <string>
#include <vector>

#include "mortise/core/log.hpp"
#include "mortise/core/types.hpp"
#include "mortise/simulation/run/output/exit_code.hpp"
#include "mortise/studies/launcher.hpp"

namespace mortise {

/// Settings for computing the paper's examples.
struct PaperOptions {
  std::string directory = "results/paper";  ///< where results go
  std::vector<std::string> only;            ///< names of the runs that are wanted; empty: all of them
  int ranks = 1;                            ///< MPI ranks of each run
  bool reuse = false;                       ///< take results that an earlier call left, if scene, settings, ranks and version are the same
  Launcher launcher;                        ///< of the runs
  Verbosity verbosity = Verbosity::normal;
  std::string version;  ///< of the program
};

/// Names of the runs, in the order of the paper.
std::vector<std::string> paper_run_names();

/// Runs the paper's scenes, which are part of the program. Each is a process of its own of this same program, which therefore must not have started
/// MPI; `comm` has one rank. Leaves in the directory:
///   - scenes/<scene>.xml;
///   - a directory with the results of each run;
///   - paper.json: what was run and how it ended;
///   - paper.html: one page that needs no other file.
/// A run that fails is written down with its reason, and the next one is started. Returns done; not_converged if a run failed; check_missed if all
/// came to their end but one of them missed a bound of its checks. Throws FileError: the directory cannot be written, no python3 with matplotlib and
/// h5py, the page cannot be drawn.
ExitCode run_paper(const RCP<const Communicator>& comm, const PaperOptions& options);

}  // namespace mortise
