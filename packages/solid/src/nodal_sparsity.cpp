#include "mortise/solid/nodal_sparsity.hpp"

#include <Tpetra_CrsGraph.hpp>
#include <Tpetra_CrsMatrix.hpp>
#include <algorithm>
#include <stdexcept>

namespace mortise {

NodalSparsity::NodalSparsity(const Mesh& mesh, const RCP<const Map>& dofs, const RCP<const Map>& local_dofs) {
  const LocalOrdinal owned = mesh.owned_count();
  std::vector<std::vector<LocalOrdinal>> neighbours(owned);
  for (const Block& block : mesh.blocks) {
    if (block.shape == CellShape::line2) continue;  // of rigid bodies: no stiffness couples their nodes
    for (LocalOrdinal element = 0; element < block.size(); ++element) {
      const LocalOrdinal* nodes = block.nodes(element);
      for (int a = 0; a < block.nodes_per_element; ++a)
        if (nodes[a] < owned) neighbours[nodes[a]].insert(neighbours[nodes[a]].end(), nodes, nodes + block.nodes_per_element);
    }
  }

  Teuchos::Array<std::size_t> row_sizes(2 * owned);
  neighbour_starts_.assign(1, 0);
  row_starts_.assign(1, 0);
  for (LocalOrdinal node = 0; node < owned; ++node) {
    auto& list = neighbours[node];
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
    neighbours_.insert(neighbours_.end(), list.begin(), list.end());
    neighbour_starts_.push_back(neighbours_.size());
    for (int component = 0; component < 2; ++component) {
      row_sizes[2 * node + component] = 2 * list.size();
      row_starts_.push_back(row_starts_.back() + 2 * list.size());
    }
    list = {};
  }

  auto graph = rcp(new Graph(dofs, local_dofs, row_sizes()));
  std::vector<LocalOrdinal> columns;
  for (LocalOrdinal node = 0; node < owned; ++node) {
    columns.clear();
    for (std::size_t n = neighbour_starts_[node]; n < neighbour_starts_[node + 1]; ++n)
      for (int component = 0; component < 2; ++component) columns.push_back(2 * neighbours_[n] + component);
    for (int component = 0; component < 2; ++component)
      graph->insertLocalIndices(2 * node + component, Teuchos::arrayView(columns.data(), columns.size()));
  }
  graph->fillComplete(dofs, dofs);
  graph_ = graph;
}

LocalOrdinal NodalSparsity::position(LocalOrdinal row, LocalOrdinal column) const {
  if (row + 1 >= static_cast<LocalOrdinal>(neighbour_starts_.size())) return -1;
  const auto first = neighbours_.begin() + neighbour_starts_[row], last = neighbours_.begin() + neighbour_starts_[row + 1];
  const auto found = std::lower_bound(first, last, column);
  return found != last && *found == column ? static_cast<LocalOrdinal>(2 * (found - first)) : -1;
}

NodalSparsity::Values NodalSparsity::open(Matrix& matrix) const {
  // Same sizes and sorted, merged rows mean the same layout: all graphs of a system hold the bulk's pattern or more.
  const auto graph = matrix.getCrsGraph();
  if (graph.get() != graph_.get() &&
      (graph->getNodeNumRows() != graph_->getNodeNumRows() || graph->getNodeNumEntries() != row_starts_.back() || !graph->isSorted()))
    throw std::logic_error("a matrix was handed to the bulk that does not have the bulk's graph");
  const auto local = matrix.getLocalMatrixHost();
  return {local.values.data(), row_starts_.data()};
}

}  // namespace mortise
