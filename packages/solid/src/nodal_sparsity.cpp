#include "mortise/solid/nodal_sparsity.hpp"

#include <Tpetra_CrsGraph.hpp>
#include <Tpetra_CrsMatrix.hpp>
#include <algorithm>
#include <stdexcept>

namespace mortise {

namespace {

/// Elements around each owned node, as the starts of their node lists. Those of rigid bodies are left out: no stiffness couples their nodes.
struct ElementsAroundNodes {
  struct Element {
    const LocalOrdinal* nodes;
    int count;
  };
  std::vector<std::size_t> starts;  ///< [owned nodes + 1]
  std::vector<Element> elements;

  explicit ElementsAroundNodes(const Mesh& mesh) : starts(mesh.owned_count() + 1, 0) {
    for_each_owned(mesh, [&](LocalOrdinal node, const Element&) { ++starts[node + 1]; });
    for (std::size_t n = 1; n < starts.size(); ++n) starts[n] += starts[n - 1];
    elements.resize(starts.back());
    std::vector<std::size_t> next(starts.begin(), starts.end() - 1);
    for_each_owned(mesh, [&](LocalOrdinal node, const Element& element) { elements[next[node]++] = element; });
  }

 private:
  template <class Function>
  static void for_each_owned(const Mesh& mesh, const Function& function) {
    for (const Block& block : mesh.blocks) {
      if (topology(block.shape).dimension < mesh.dimension) continue;
      for (LocalOrdinal e = 0; e < block.size(); ++e) {
        const Element element{block.nodes(e), block.nodes_per_element};
        for (int a = 0; a < element.count; ++a)
          if (element.nodes[a] < mesh.owned_count()) function(element.nodes[a], element);
      }
    }
  }
};

}  // namespace

NodalSparsity::NodalSparsity(const Mesh& mesh, const RCP<const Map>& dofs, const RCP<const Map>& local_dofs) : dimension_(mesh.dimension) {
  const LocalOrdinal owned = mesh.owned_count();
  const ElementsAroundNodes around(mesh);
  neighbour_starts_.assign(1, 0);
  row_starts_.assign(1, 0);
  std::vector<LocalOrdinal> list;
  for (LocalOrdinal node = 0; node < owned; ++node) {
    list.clear();
    for (std::size_t n = around.starts[node]; n < around.starts[node + 1]; ++n)
      list.insert(list.end(), around.elements[n].nodes, around.elements[n].nodes + around.elements[n].count);
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
    neighbours_.insert(neighbours_.end(), list.begin(), list.end());
    neighbour_starts_.push_back(neighbours_.size());
    for (int component = 0; component < dimension_; ++component) row_starts_.push_back(row_starts_.back() + dimension_ * list.size());
  }

  // The rows as the graph will hold them, ascending: handing them over one by one would search each for what it has already.
  Teuchos::ArrayRCP<std::size_t> starts(row_starts_.size());
  std::copy(row_starts_.begin(), row_starts_.end(), starts.begin());
  Teuchos::ArrayRCP<LocalOrdinal> columns(row_starts_.back());
  auto column = columns.begin();
  for (LocalOrdinal node = 0; node < owned; ++node)
    for (int component = 0; component < dimension_; ++component)
      for (std::size_t n = neighbour_starts_[node]; n < neighbour_starts_[node + 1]; ++n)
        for (int of = 0; of < dimension_; ++of) *column++ = dimension_ * neighbours_[n] + of;
  auto graph = rcp(new Graph(dofs, local_dofs, starts, columns));
  graph->expertStaticFillComplete(dofs, dofs);
  graph_ = graph;
}

LocalOrdinal NodalSparsity::position(LocalOrdinal row, LocalOrdinal column) const {
  if (row + 1 >= static_cast<LocalOrdinal>(neighbour_starts_.size())) return -1;
  const auto first = neighbours_.begin() + neighbour_starts_[row], last = neighbours_.begin() + neighbour_starts_[row + 1];
  const auto found = std::lower_bound(first, last, column);
  return found != last && *found == column ? static_cast<LocalOrdinal>(dimension_ * (found - first)) : -1;
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
