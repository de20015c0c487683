#pragma once
// Another program, run to its end.

#include <limits>
#include <string>
#include <vector>

#include "mortise/studies/launcher.hpp"

namespace mortise {

/// Ending of a process: exit code, output, time and memory.
struct ProcessEnding {
  int code = -1;         ///< exit code; 128 + number of the signal that killed it; 126 or 127 if it could not be started; -1 without a process
  bool stopped = false;  ///< it ran into its limit and was ended
  std::string output;    ///< stdout and stderr together, without white space at the end
  double wall_seconds = 0.0, cpu_seconds = 0.0;  ///< CPU: user and system, with the processes that it started and waited for
  double memory_mib = 0.0;                       ///< largest resident size of any of these processes

  std::string last_line() const { return output.substr(output.find_last_of('\n') + 1); }
};

/// Runs a program with its arguments and waits for its end. It is terminated should this process be killed. Programs that were started under MPI must
/// not start others that use MPI.
/// @param limit  seconds after which the program is ended with all other descendants of this process: by SIGTERM, and by SIGKILL what is left 5 s
/// later
ProcessEnding run_process(const std::vector<std::string>& words, double limit = std::numeric_limits<double>::infinity());

/// The file of this same program.
std::string this_program();

/// The words that start `mortise peer` of this same program, quietly. `penalty`: empty for that of the peer.
std::vector<std::string> command_of_peer(const std::string& scene, const std::vector<std::string>& settings, const std::string& peer,
                                         const std::string& penalty, const std::string& directory);

/// The words that start `mortise run` of this same program, quietly, on so many ranks.
/// @param settings  "path=value" each
std::vector<std::string> command_of_run(const Launcher& launcher, const std::string& scene, const std::vector<std::string>& settings, int ranks,
                                        const std::string& directory);

/// All that was said at the end of these words. A launcher that ended with a code that no run has is quoted before what it printed.
std::string said_at_end(const std::vector<std::string>& words, const ProcessEnding& ending);

}  // namespace mortise
