#pragma once
// Cost of accuracy: one scene under many settings, errors against times.

#include <string>
#include <vector>

#include "mortise/core/log.hpp"
#include "mortise/core/types.hpp"
#include "mortise/simulation/run/output/exit_code.hpp"
#include "mortise/studies/launcher.hpp"

namespace mortise {

/// Settings for computing a study.
struct StudyOptions {
  std::string study;                  ///< file
  std::vector<std::string> settings;  ///< "path=value" each, of the study file
  std::string directory;              ///< where results go; empty: default_directory(study)
  bool fresh = false;                 ///< forget what the directory holds; else points that are there are not run again
  Launcher launcher;                  ///< of the runs
  Verbosity verbosity = Verbosity::normal;
  std::string version;  ///< of the program
};

/// Runs the points of a study. Each is a process of its own of this same program, which therefore must not have started MPI; `comm` has one rank.
/// Leaves in the directory:
///   - scene.xml: what was run;
///   - points/<point> and finest, with the results of each;
///   - study.csv, study.json and report.html, one page that needs no other file.
/// May be killed at any time: called again, it runs what is missing.
/// A point that fails is written down with its reason, and the next one is run. Returns done, or not_converged if a point or the finest run failed.
/// Throws InputError: everything that is wrong with the study; FileError: the study cannot be read, the directory not written, the page not drawn.
ExitCode run_study(const RCP<const Communicator>& comm, const StudyOptions& options);

}  // namespace mortise
