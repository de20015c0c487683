#pragma once
// Files of a run of CalculiX.

#include <array>
#include <map>
#include <string>
#include <vector>

namespace mortise {

/// An accepted increment.
struct CalculixIncrement {
  double time = 0.0, dt = 0.0;
  int iterations = 0;
  int cutbacks = 0;  ///< tries before it
};

/// The last results of each kind, by the number of the node in the deck:
///   - "DISP": displacement;
///   - "FORC": forces on nodes without those of contact, that is of supports and loads;
///   - "CONTACT": gap, two slips, pressure, two shears.
struct CalculixResults {
  std::string version;
  std::vector<CalculixIncrement> increments;
  double time = 0.0;  ///< of the results; 0: there are none
  std::map<std::string, std::map<long, std::array<double, 6>>> nodal;

  double end_time() const { return increments.empty() ? 0.0 : increments.back().time; }
};

/// Reads peer.sta and peer.frd of a directory, as far as they are there. Throws FileError for a line that means nothing.
CalculixResults read_calculix_results(const std::string& directory);

}  // namespace mortise
