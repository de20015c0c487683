#include "mortise/simulation/model/mesh_limits.hpp"

#include <fmt/format.h>
#include <mpi.h>

#include <Teuchos_CommHelpers.hpp>
#include <Teuchos_DefaultMpiComm.hpp>
#include <algorithm>
#include <limits>

#include "mortise/core/memory.hpp"
#include "mortise/mesh/mesh_counts.hpp"

namespace mortise {
namespace {

/// Of a mesh, at least: position, body and id of each node; nodes and id of each element.
double least_mesh_bytes(const MeshCounts& mesh) {
  return static_cast<double>(mesh.nodes) * (3 * sizeof(double) + sizeof(int) + sizeof(GlobalOrdinal)) +
         static_cast<double>(mesh.elements) * (sizeof(LocalOrdinal) * mesh.least_nodes_of_element + sizeof(GlobalOrdinal));
}

/// Of a stiffness, at least: value and column of each entry, if a node meets the nodes of one of its elements alone.
double least_stiffness_bytes(const MeshCounts& mesh, int dimension) {
  return static_cast<double>(mesh.nodes) * mesh.least_nodes_of_element * dimension * dimension * (sizeof(double) + sizeof(LocalOrdinal));
}

/// Of all bodies.
struct ModelSize {
  double nodes = 0.0, dofs = 0.0, mesh_bytes = 0.0, stiffness_bytes = 0.0;
  Place place;       ///< of the largest body
  std::string mesh;  ///< words for its mesh
};

ModelSize model_size(const std::vector<BodyDescription>& bodies) {
  const auto counts = mesh_counts(bodies);
  ModelSize size;
  std::size_t largest = 0;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const int dimension = bodies[b].dimension();
    size.nodes += static_cast<double>(counts[b].nodes);
    size.dofs += static_cast<double>(counts[b].nodes) * dimension;
    size.mesh_bytes += least_mesh_bytes(counts[b]);
    if (counts[b].is_solid) size.stiffness_bytes += least_stiffness_bytes(counts[b], dimension);
    if (counts[b].nodes > counts[largest].nodes) largest = b;
  }
  size.place = bodies[largest].place;
  size.mesh =
      fmt::format("the mesh of body '{}' would have {} elements and {} nodes", bodies[largest].name, counts[largest].elements, counts[largest].nodes);
  return size;
}

/// `count` dofs or nodes are shared by `ranks`.
void refuse_more_than_ids(const ModelSize& size, double count, const char* of, int ranks) {
  const double most = static_cast<double>(std::numeric_limits<LocalOrdinal>::max()) * ranks;
  if (count > most)
    throw InputError(size.place, fmt::format("{}; the model's {:.4g} {} are more than the {:.4g} that {} rank(s) can number; please make it coarser",
                                             size.mesh, count, of, most, ranks));
}

/// `what` takes at least `bytes`; `advice`: what helps beside coarser meshes.
void refuse_more_than_memory(const Communicator& comm, const ModelSize& size, double bytes, const char* what, const char* advice) {
  constexpr double gib = 1024.0 * 1024.0 * 1024.0;
  const double memory = memory_of_machines(comm) / 1024.0;
  if (memory > 0.0 && bytes / gib > memory)
    throw InputError(size.place, fmt::format("{}; {} would take more than {:.1f} GiB, and there are {:.1f} GiB here; please make it coarser, or {}",
                                             size.mesh, what, bytes / gib, memory, advice));
}

}  // namespace

double memory_of_machines(const Communicator& comm) {
  const double machine = machine_memory_mib(), share = machine / ranks_on_this_machine(comm);
  double least = 0.0, sum = 0.0;
  Teuchos::reduceAll(comm, Teuchos::REDUCE_MIN, machine, Teuchos::outArg(least));
  Teuchos::reduceAll(comm, Teuchos::REDUCE_SUM, share, Teuchos::outArg(sum));
  return least > 0.0 ? sum : 0.0;
}

void refuse_too_large(const Communicator& comm, const std::vector<BodyDescription>& bodies) {
  const ModelSize size = model_size(bodies);
  refuse_more_than_ids(size, size.dofs, "dofs", comm.getSize());
  refuse_more_than_memory(comm, size, size.mesh_bytes + size.stiffness_bytes, "the model", "run it on more machines");
}

void refuse_too_large_to_plan(const Communicator& comm, const std::vector<BodyDescription>& bodies, int ranks) {
  const ModelSize size = model_size(bodies);
  refuse_more_than_ids(size, size.dofs, "dofs", ranks);
  refuse_more_than_ids(size, size.nodes, "nodes", comm.getSize());
  refuse_more_than_memory(comm, size, size.mesh_bytes, "the mesh alone", "plan it on a machine that has more");
}

}  // namespace mortise
