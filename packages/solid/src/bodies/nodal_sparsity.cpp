#include "mortise/solid/nodal_sparsity.hpp"

#include <Tpetra_CrsGraph.hpp>
#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Map.hpp>
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

bool begins_with(const Map& columns, const Map& first) {
  if (&columns == &first) return true;
  const auto local = columns.getLocalMap(), local_first = first.getLocalMap();
  if (local.getNodeNumElements() < local_first.getNodeNumElements()) return false;
  for (LocalOrdinal c = 0; c < static_cast<LocalOrdinal>(local_first.getNodeNumElements()); ++c)
    if (local.getGlobalElement(c) != local_first.getGlobalElement(c)) return false;
  return true;
}

}  // namespace

NodalSparsity::NodalSparsity(const Mesh& mesh, const RCP<const Map>& dofs, const RCP<const Map>& local_dofs)
    : dimension_(mesh.dimension), dofs_(dofs), local_dofs_(local_dofs) {
  const LocalOrdinal owned = mesh.owned_count();
  const ElementsAroundNodes around(mesh);
  neighbour_starts_.reserve(owned + 1);
  neighbour_starts_.push_back(0);
  std::vector<LocalOrdinal> list, rotations;
  if (mesh.dimension == 3)  // moments couple the components of a rotation vector
    for (const ReferencePoint& point : mesh.reference_points) rotations.push_back(point.rotation_node);
  for (LocalOrdinal node = 0; node < owned; ++node) {
    list.clear();
    if (std::find(rotations.begin(), rotations.end(), node) != rotations.end()) list.push_back(node);
    for (std::size_t n = around.starts[node]; n < around.starts[node + 1]; ++n)
      list.insert(list.end(), around.elements[n].nodes, around.elements[n].nodes + around.elements[n].count);
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
    neighbours_.insert(neighbours_.end(), list.begin(), list.end());
    neighbour_starts_.push_back(neighbours_.size());
  }
  neighbours_.shrink_to_fit();
}

std::size_t NodalSparsity::row_size(std::size_t row) const {
  const std::size_t node = row / dimension_;
  return dimension_ * (neighbour_starts_[node + 1] - neighbour_starts_[node]);
}

LocalOrdinal* NodalSparsity::write_columns(std::size_t row, LocalOrdinal* columns) const {
  const std::size_t node = row / dimension_;
  for (std::size_t n = neighbour_starts_[node]; n < neighbour_starts_[node + 1]; ++n)
    for (int of = 0; of < dimension_; ++of) *columns++ = dimension_ * neighbours_[n] + of;
  return columns;
}

// The rows as the graph holds them, ascending: entries given one by one would each be searched for in what the row has already.
RCP<const Graph> NodalSparsity::graph() const {
  const std::size_t rows = dofs_->getNodeNumElements();
  Graph::local_graph_device_type::row_map_type::non_const_type starts("starts", rows + 1);
  for (std::size_t row = 0; row < rows; ++row) starts(row + 1) = starts(row) + row_size(row);
  Graph::local_graph_device_type::entries_type::non_const_type columns(Kokkos::view_alloc(Kokkos::WithoutInitializing, "columns"), starts(rows));
  LocalOrdinal* next = columns.data();
  for (std::size_t row = 0; row < rows; ++row) next = write_columns(row, next);
  const auto graph = rcp(new Graph(dofs_, local_dofs_, starts, columns));
  graph->expertStaticFillComplete(dofs_, dofs_);
  return graph;
}

LocalOrdinal NodalSparsity::position(LocalOrdinal row, LocalOrdinal column) const {
  if (row + 1 >= static_cast<LocalOrdinal>(neighbour_starts_.size())) return -1;
  const auto first = neighbours_.begin() + neighbour_starts_[row], last = neighbours_.begin() + neighbour_starts_[row + 1];
  const auto found = std::lower_bound(first, last, column);
  return found != last && *found == column ? static_cast<LocalOrdinal>(dimension_ * (found - first)) : -1;
}

NodalSparsity::Values NodalSparsity::open(Matrix& matrix) const {
  const auto graph = matrix.getCrsGraph();
  const std::size_t rows = dofs_->getNodeNumElements();
  if (graph->getNodeNumRows() != rows || !graph->isSorted() || !begins_with(*graph->getColMap(), *local_dofs_))
    throw std::logic_error("a matrix was handed to the bulk that does not have the bulk's rows and columns");
  const auto local = matrix.getLocalMatrixHost();
  Values values(matrix, *this);
  // Sorted rows of the same size have the same entries, as no row lacks one of the bulk's.
  std::size_t gathered = 0;
  for (std::size_t row = 0; row < rows; ++row) {
    const std::size_t size = row_size(row), entries = local.graph.row_map(row + 1) - local.graph.row_map(row);
    if (entries < size) throw std::logic_error("a matrix was handed to the bulk that lacks entries of the bulk's graph");
    if (entries == size) continue;
    values.wider_.push_back(static_cast<LocalOrdinal>(row));
    gathered += size;
  }
  values.gathered_.assign(gathered, 0.0);
  values.rows_.resize(rows);
  for (std::size_t row = 0; row < rows; ++row) values.rows_[row] = local.values.data() + local.graph.row_map(row);
  double* next = values.gathered_.data();
  for (const LocalOrdinal row : values.wider_) {
    values.rows_[row] = next;
    next += row_size(row);
  }
  return values;
}

void NodalSparsity::Values::close() const {
  std::vector<LocalOrdinal> columns;
  for (const LocalOrdinal row : wider_) {
    columns.resize(sparsity_.row_size(row));
    sparsity_.write_columns(row, columns.data());
    const auto count = static_cast<LocalOrdinal>(columns.size());
    if (matrix_.sumIntoLocalValues(row, count, rows_[row], columns.data()) != count)
      throw std::logic_error("a matrix was handed to the bulk that lacks entries of the bulk's graph");
  }
}

}  // namespace mortise
