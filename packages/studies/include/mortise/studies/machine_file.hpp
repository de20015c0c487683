#pragma once
// Machine files: a cluster's nodes and network, and how fast runs were there.

#include <optional>
#include <string>
#include <vector>

#include "mortise/core/parameters.hpp"
#include "mortise/core/types.hpp"

namespace mortise {

/// Seconds of a phase for each unit of its work.
struct PhaseRate {
  double rank = 0.0;   ///< of the work of the rank that has most
  double whole = 0.0;  ///< of the work of all ranks: what more ranks do not make faster
  void describe(Parameters& parameters);
};

/// A machine file's content.
struct MachineFile {
  std::string name;  ///< of the file's outermost list

  int cores_per_node = 1;
  double memory_per_node = 0.0, memory_of_process = 70.0;  ///< MiB
  std::optional<double> core_bandwidth, node_bandwidth;    ///< of memory, GB/s
  double latency = 2e-6, network_bandwidth = 10.0;         ///< between nodes; s, GB/s
  std::string measured_scene;                              ///< that rates and counts are of
  int newton_iterations = 0, linear_iterations = 0;        ///< of that run
  std::vector<PhaseRate> rates;                            ///< [scale_phases()]

  MachineFile();
  void describe(Parameters& parameters);

  /// True if times can be predicted.
  bool has_rates() const;
};

/// Collective, as read_scene. Throws FileError if the file cannot be read, InputError with everything that is wrong with it.
MachineFile read_machine(const Communicator& comm, const std::string& file);

/// The machine as a file.
std::string to_machine_xml(const MachineFile& machine);

}  // namespace mortise
