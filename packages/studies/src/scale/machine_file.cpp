#include "mortise/studies/machine_file.hpp"

#include <algorithm>

#include "mortise/input/parameter_tree.hpp"
#include "mortise/input/read_parameters.hpp"
#include "mortise/input/xml.hpp"
#include "scale/scale_phases.hpp"

namespace mortise {
namespace {

struct NetworkList {
  MachineFile& machine;
  void describe(Parameters& parameters) {
    parameters.add("latency", machine.latency, Says("time until a message of another node begins to arrive").unit("s").at_least(0.0));
    parameters.add("bandwidth", machine.network_bandwidth, Says("of messages between two nodes").unit("GB/s").above(0.0));
  }
};

struct MeasuredList {
  MachineFile& machine;
  void describe(Parameters& parameters) {
    parameters.add("scene", machine.measured_scene, "scene that was measured; for people alone");
    parameters.add("newton iterations", machine.newton_iterations,
                   Says("of the whole run, over all steps; change them for a scene with other steps. 0: no times are predicted").at_least(0));
    parameters.add("linear iterations", machine.linear_iterations,
                   Says("of the iterative solver in the whole run. 0: no times are predicted").at_least(0));
  }
};

struct RatesList {
  MachineFile& machine;
  void describe(Parameters& parameters) {
    for (std::size_t p = 0; p < scale_phases().size(); ++p)
      parameters.list(scale_phases()[p].name, machine.rates[p], "for each " + scale_phases()[p].unit);
  }
};

}  // namespace

void PhaseRate::describe(Parameters& parameters) {
  parameters.add("rank", rank, Says("time for each unit of work of the rank that has most").unit("s").at_least(0.0));
  parameters.add("whole", whole, Says("time for each unit of work of all ranks, which more ranks do not make shorter").unit("s").at_least(0.0));
}

MachineFile::MachineFile() : rates(scale_phases().size()) {}

void MachineFile::describe(Parameters& parameters) {
  parameters.add("cores per node", cores_per_node, Says("cores of a node; each has one rank").at_least(1).required());
  parameters.add("memory per node", memory_per_node, Says("memory of a node that jobs may take").unit("MiB").above(0.0).required());
  parameters.add("memory of a process", memory_of_process, Says("that a rank takes for the program and its libraries").unit("MiB").at_least(0.0));
  parameters.add("bandwidth of a core", core_bandwidth,
                 Says("memory bandwidth of one process alone; left out: more ranks on a node do not slow one another down").unit("GB/s").above(0.0));
  parameters.add("bandwidth of a node", node_bandwidth,
                 Says("memory bandwidth of as many processes as a node has cores; goes with that of a core").unit("GB/s").above(0.0));
  NetworkList network{*this};
  parameters.list("network", network, "messages between nodes");
  MeasuredList measured{*this};
  parameters.list("measured", measured, "counts of the run that was measured");
  RatesList all{*this};
  parameters.list("rates", all, "times of each phase for a unit of its work, as `mortise scale` measures them");
  if (core_bandwidth.has_value() != node_bandwidth.has_value())
    parameters.error("", "\"bandwidth of a core\" and \"bandwidth of a node\" go together; please give both or none");
  else if (core_bandwidth && *node_bandwidth < *core_bandwidth)
    parameters.error("bandwidth of a node", "\"bandwidth of a node\" is less than \"bandwidth of a core\"; a node has at least that of one core");
}

bool MachineFile::has_rates() const {
  return newton_iterations > 0 && linear_iterations > 0 &&
         std::any_of(rates.begin(), rates.end(), [](const PhaseRate& rate) { return rate.rank > 0.0 || rate.whole > 0.0; });
}

MachineFile read_machine(const Communicator& comm, const std::string& file) {
  const XmlList root = parse_xml(read_text(comm, file), file);
  std::vector<Diagnostic> diagnostics;
  MachineFile machine;
  machine.name = root.name;
  read_parameters(machine, root, {}, {}, diagnostics);
  if (!diagnostics.empty()) throw InputError(diagnostics);
  return machine;
}

std::string to_machine_xml(const MachineFile& machine) {
  return to_scene_xml(collect_parameters(machine.name, machine, CollectParameters::What::values), {});
}

}  // namespace mortise
