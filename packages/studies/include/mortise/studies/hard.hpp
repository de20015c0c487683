#pragma once
// The ledger of hard cases: scenes that ended wrong or may end wrong, and whether they end right today.

#include <string>
#include <vector>

#include "mortise/core/log.hpp"
#include "mortise/core/types.hpp"
#include "mortise/simulation/run/output/exit_code.hpp"
#include "mortise/studies/launcher.hpp"

namespace mortise {

/// Settings for running the ledger.
struct HardOptions {
  std::string ledger = "inputs/hard/ledger.xml";  ///< file of the cases; see HardFile
  std::string directory;                          ///< where results go; empty: results/hard
  std::string only;                               ///< regular expression that names of cases have to match somewhere; empty: no choice
  std::vector<int> ranks{1};                      ///< MPI ranks; each case is run on each number of them
  bool sweeps = false;                            ///< run cases with axes as well; those that `only` chooses are always run
  bool fresh = false;                             ///< forget the results of an earlier call
  Launcher launcher;                              ///< of the runs
  Verbosity verbosity = Verbosity::normal;
  std::string version;  ///< of the program
};

/// Runs the cases, each run as a process of its own of this same program, which therefore must not have started MPI; `comm` has one rank. Leaves in
/// the directory: ledger.csv, hard-cases.md, hard-cases.html and a directory for each run. Runs that an earlier call finished with the same program,
/// scene and settings are taken as they are. Returns done, or check_missed if a line is wrong. Throws InputError with all that is wrong with the
/// ledger and with the scenes under its settings, FileError.
ExitCode run_hard(const RCP<const Communicator>& comm, const HardOptions& options);

/// A line for each case that run_hard would run with these options: name, number of runs on one number of ranks, what makes it hard.
std::string list_hard(const RCP<const Communicator>& comm, const HardOptions& options);

}  // namespace mortise
