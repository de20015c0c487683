#include "mesh_limits.hpp"

#include <fmt/format.h>
#include <mpi.h>

#include <Teuchos_CommHelpers.hpp>
#include <Teuchos_DefaultMpiComm.hpp>
#include <algorithm>
#include <limits>

#include "memory.hpp"
#include "mortise/mesh/mesh_counts.hpp"
#include "scene_bodies.hpp"

namespace mortise {
namespace {

int ranks_on_this_machine(const Communicator& comm) {
  const auto* mpi = dynamic_cast<const Teuchos::MpiComm<int>*>(&comm);
  if (mpi == nullptr) return 1;
  MPI_Comm here;
  MPI_Comm_split_type((*mpi->getRawMpiComm())(), MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &here);
  int ranks = 1;
  MPI_Comm_size(here, &ranks);
  MPI_Comm_free(&here);
  return ranks;
}

/// Of a model, at least: position, body and id of each node; nodes and id of each element; value and column of each entry of a stiffness in which a
/// node meets the nodes of one of its elements alone.
double least_bytes(const MeshCounts& mesh, int dimension, int nodes_of_element, bool is_rigid) {
  const auto elements = static_cast<double>(mesh.elements), nodes = static_cast<double>(mesh.nodes);
  const double of_mesh = nodes * (3 * sizeof(double) + sizeof(int) + sizeof(GlobalOrdinal)) +
                         elements * (sizeof(LocalOrdinal) * nodes_of_element + sizeof(GlobalOrdinal));
  const double entries = is_rigid ? 0.0 : nodes * nodes_of_element * dimension * dimension;
  return of_mesh + entries * (sizeof(double) + sizeof(LocalOrdinal));
}

}  // namespace

double memory_of_machines(const Communicator& comm) {
  const double machine = machine_memory_mib(), share = machine / ranks_on_this_machine(comm);
  double least = 0.0, sum = 0.0;
  Teuchos::reduceAll(comm, Teuchos::REDUCE_MIN, machine, Teuchos::outArg(least));
  Teuchos::reduceAll(comm, Teuchos::REDUCE_SUM, share, Teuchos::outArg(sum));
  return least > 0.0 ? sum : 0.0;
}

void refuse_too_large(const Communicator& comm, const Scene& scene) {
  const auto bodies = body_descriptions(scene);
  const auto counts = mesh_counts(bodies);
  double dofs = 0.0, bytes = 0.0;
  std::size_t largest = 0;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const int dimension = bodies[b].mesh->dimension();
    const CellTopology& cell = topology(bodies[b].shape);
    dofs += static_cast<double>(counts[b].nodes) * dimension;
    bytes += least_bytes(counts[b], dimension, cell.nodes, cell.dimension < dimension);
    if (counts[b].nodes > counts[largest].nodes) largest = b;
  }
  const std::string what =
      fmt::format("the mesh of body '{}' would have {} elements and {} nodes", bodies[largest].name, counts[largest].elements, counts[largest].nodes);
  const double most = static_cast<double>(std::numeric_limits<LocalOrdinal>::max()) * comm.getSize();
  if (dofs > most)
    throw InputError(bodies[largest].place,
                     fmt::format("{}; the model's {:.4g} dofs are more than the {:.4g} that {} rank(s) can number; please make "
                                 "it coarser",
                                 what, dofs, most, comm.getSize()));
  constexpr double gib = 1024.0 * 1024.0 * 1024.0;
  const double memory = memory_of_machines(comm) / 1024.0;
  if (memory > 0.0 && bytes / gib > memory)
    throw InputError(bodies[largest].place,
                     fmt::format("{}; the model would take more than {:.1f} GiB, and there are {:.1f} GiB here; please make it "
                                 "coarser, or run it on more machines",
                                 what, bytes / gib, memory));
}

}  // namespace mortise
