#pragma once
// Runs programs as a user would.

#include <string>
#include <vector>

/// Ending of a program and its output (stdout and stderr together).
struct Ending {
  int code = -1;
  std::string output;
};

/// Runs a command and waits for it; `seconds` later it is ended, with code 124, or 137 if it has to be killed. One rank (mpirun -n 1 ...) is run
/// without mpirun, which takes longer to start than most of these scenes to run.
Ending launch(const std::vector<std::string>& command, int seconds = 300);

std::string read_file(const std::string& path);
