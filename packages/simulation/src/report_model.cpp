#include "report_model.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_CrsGraph.hpp>

#include "memory.hpp"
#include "memory_estimate.hpp"

namespace mortise {

void report_model(const std::string& file, const Scene& scene, const Model& model, RunLog& log) {
  log.info(fmt::format("{}: {}, {}", file, scene.name, to_string(scene.kinematics)));
  for (const auto& [effect, members] : model.effects())
    if (!members.empty()) log.info(fmt::format("  {}: {}", effect, fmt::join(members, ", ")));
  const auto& blocks = model.mesh()->blocks;
  for (std::size_t b = 0; b < blocks.size(); ++b)
    if (scene.bodies[b].value.rigid.value)
      log.info(fmt::format("  body {}: rigid, {} facets", blocks[b].name, model.size().elements_of_block[b]));
    else
      log.info(fmt::format("  body {}: {} elements {}, {}", blocks[b].name, model.size().elements_of_block[b],
                           to_string(scene.bodies[b].value.element), scene.bodies[b].value.material.value));
  log.info(fmt::format("  {} dofs, {} slave nodes, {} on {} rank(s)", model.dofs(), model.slave_nodes(), model.parts().linear_solver->name(),
                       model.mesh()->comm->getSize()));
}

MemoryEstimate estimated_memory(const Model& model) {
  constexpr double mib = 1024.0 * 1024.0;
  const Communicator& comm = *model.mesh()->comm;
  MemoryEstimate estimate;
  Teuchos::reduceAll(comm, Teuchos::REDUCE_SUM, peak_memory_mib(), Teuchos::outArg(estimate.so_far));
  const int dimension = model.mesh()->dimension;
  const double entries = static_cast<double>(model.parts().bulk_graph()->getGlobalNumEntries());
  const SystemSize size{dimension, static_cast<double>(model.dofs()) / dimension, entries / (dimension * dimension), comm.getSize() > 1};
  const bool iterative = model.parts().linear_solver->tolerances().has_value();
  estimate.linear_systems = (iterative ? multigrid_bytes(size) : factorisation_bytes(size)) / mib;
  return estimate;
}

}  // namespace mortise
