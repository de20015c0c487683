#pragma once
// The log of a run: the terminal and log.txt.

#include <fstream>
#include <sstream>
#include <string>

#include "mortise/core/log.hpp"
#include "mortise/core/types.hpp"

namespace mortise {

/// Sinks on rank 0 only. Lines written before the output directory is open are kept for log.txt.
class RunLog {
 public:
  RunLog(const RCP<const Communicator>& comm, Verbosity verbosity);

  /// Starts log.txt, or goes on with it. Collective. Throws FileError on all ranks.
  void open(const std::string& path, bool append = false);

  void info(const std::string& line) { log_.info(line), flush(); }
  void detail(const std::string& line) { log_.detail(line), flush(); }
  void warning(const std::string& line) { log_.warning(line), flush(); }

 private:
  void flush();

  RCP<const Communicator> comm_;
  Verbosity verbosity_;
  std::ostringstream early_;
  std::ofstream file_;
  Log log_;
};

}  // namespace mortise
