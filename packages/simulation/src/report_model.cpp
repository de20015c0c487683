#include "report_model.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Tpetra_CrsGraph.hpp>
#include <cmath>

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

double estimated_memory_mib(const Model& model) {
  // The matrix, value and column index of each entry. Factors of nested dissection on N nodes of a plane mesh, with
  // George's count of entries 31/4 N log2 N for the pattern, 2 x 2 values each, L and U.
  const double entry = sizeof(double) + sizeof(LocalOrdinal);
  const double matrix = entry * static_cast<double>(model.parts().bulk_graph()->getGlobalNumEntries());
  const double nodes = 0.5 * static_cast<double>(model.dofs());
  const double factors = 7.75 * nodes * std::log2(nodes + 1.0) * 4.0 * 2.0 * sizeof(double);
  return (matrix + factors) / (1024.0 * 1024.0);
}

}  // namespace mortise
