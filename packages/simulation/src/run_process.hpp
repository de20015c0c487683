#pragma once
// Another program, run to its end.

#include <string>
#include <vector>

namespace mortise {

/// How a process ended and what it said.
struct ProcessEnding {
  int code = -1;       ///< exit code; 128 + number of the signal that killed it; 126 or 127 if it could not be started; -1 without a shell
  std::string output;  ///< stdout and stderr together, without white space at the end

  std::string last_line() const { return output.substr(output.find_last_of('\n') + 1); }
};

/// `words` as one line for a shell, each of them quoted where it has to be.
std::string shell_line(const std::vector<std::string>& words);

/// Runs a program with its arguments and waits for its end. Programs that were started under MPI must not start others that use MPI.
ProcessEnding run_process(const std::vector<std::string>& words);

}  // namespace mortise
