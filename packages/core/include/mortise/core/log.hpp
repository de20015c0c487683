#pragma once
// A rank-aware log that is handed in; nothing below `simulation` prints in any other way.

#include <memory>
#include <ostream>
#include <string>
#include <vector>

namespace mortise {

enum class Verbosity { quiet, normal, verbose };

/// Writes lines to its sinks on the rank that holds them (rank 0); on all other ranks it has no sink and does nothing.
class Log {
 public:
  /// Adds a sink (not owned) and its verbosity. A log without sinks is silent.
  void add_sink(std::ostream& sink, Verbosity verbosity);

  void info(const std::string& line) const;     ///< reaches sinks of verbosity normal and verbose
  void detail(const std::string& line) const;   ///< reaches sinks of verbosity verbose
  void warning(const std::string& line) const;  ///< reaches every sink, with "warning: " before it

 private:
  struct Sink {
    std::ostream* stream;
    Verbosity verbosity;
  };
  std::vector<Sink> sinks_;
};

}  // namespace mortise
