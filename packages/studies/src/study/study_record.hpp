#pragma once
// Results of one point of a study, as kept from one call to the next.

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "mortise/core/types.hpp"
#include "mortise/studies/launcher.hpp"
#include "mortise/studies/study_points.hpp"

namespace mortise {

/// The outcome of a point. Numbers that the runs did not give are not numbers.
struct StudyRecord {
  int exit = -1;
  std::string said;             ///< by the run that failed, or the last one
  std::string date, processor;  ///< UTC, "2026-01-31T12:00:00Z"; of the first run
  bool reused = false;
  bool by_peer = false;                        ///< a peer was to run it
  std::string absent;                          ///< the peer's program, which is not installed: nothing was run
  std::optional<double> stopped_after;         ///< the time limit that it ran into [s]
  std::string interrupted;                     ///< the signal by which somebody stopped it; empty: nobody did
  double wall = 0.0, cpu = 0.0, memory = 0.0;  ///< seconds and MiB over all ranks; medians of the repeats
  std::map<std::string, double> time;          ///< seconds by timer of the summary; medians of the repeats
  double dofs = 0.0, steps = 0.0, newton_iterations = 0.0, cutbacks = 0.0;
  std::vector<std::string> missed_checks;  ///< checks of the scene, with value and bounds
  std::vector<double> quantities;          ///< in the order of the point's

  /// True if it came to its end: errors can be measured.
  bool finished() const;
  /// True if the study is not at fault for the missing results.
  bool excused() const { return !absent.empty(); }
  /// "done", "check missed", "not converged", "stopped after 60 s: time limit of the study", "killed by signal 9", "exit code 70",
  /// "not possible by the peer", "not installed: ccx (Debian: calculix-ccx)"
  std::string status() const;
};

/// Settings for running points.
struct StudyPointOptions {
  std::string scene;      ///< file that is run
  std::string text;       ///< its content
  std::string directory;  ///< of the results
  std::string version;
  int repeats = 1;
  Launcher launcher;
};

/// Record of an earlier call in the directory, if it is of the same runs: scene, settings, ranks, repeats, version. Not that of runs that ended for a
/// reason that is none of theirs (killed, files), nor of those that have more time now than what they were stopped after.
std::optional<StudyRecord> earlier_record(const Communicator& comm, const StudyPoint& point, const StudyPointOptions& options);

/// Runs a point, each time as a process of its own, and keeps at the end, at once, what it gave as study-point.json in its directory. Throws nothing
/// on a run that fails; FileError if the record cannot be written.
StudyRecord run_point(const Communicator& comm, const StudyPoint& point, const StudyPointOptions& options);

}  // namespace mortise
