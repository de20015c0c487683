#include "mortise/mesh/nodal_sparsity.hpp"

#include <Tpetra_CrsGraph.hpp>
#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Map.hpp>
#include <algorithm>
#include <stdexcept>
#include <utility>

#include "mortise/core/trilinos_versions.hpp"

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
  if (local_id_count(local) < local_id_count(local_first)) return false;
  for (LocalOrdinal c = 0; c < static_cast<LocalOrdinal>(local_id_count(local_first)); ++c)
    if (local.getGlobalElement(c) != local_first.getGlobalElement(c)) return false;
  return true;
}

}  // namespace

NodalSparsity::NodalSparsity(const Mesh& mesh, std::vector<FieldRows> fields, const RCP<const Map>& dofs, const RCP<const Map>& local_dofs)
    : fields_(std::move(fields)), owned_nodes_(mesh.owned_count()), dofs_(dofs), local_dofs_(local_dofs) {
  const LocalOrdinal owned = owned_nodes_;
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

template <class Function>
void NodalSparsity::for_each_row(const Function& function) const {
  for (const FieldRows& rows : fields_)
    for (LocalOrdinal node = 0; node < owned_nodes_; ++node)
      for (int i = 0; i < rows.components && rows.lives(node); ++i) function(rows(node, i), node);
}

std::size_t NodalSparsity::living(std::size_t field, std::size_t first, std::size_t last) const {
  if (fields_[field].rows == nullptr) return last - first;
  return std::count_if(neighbours_.begin() + first, neighbours_.begin() + last, [&](LocalOrdinal node) { return fields_[field].lives(node); });
}

std::size_t NodalSparsity::first_ghost(std::size_t node) const {
  const auto first = neighbours_.begin() + neighbour_starts_[node], last = neighbours_.begin() + neighbour_starts_[node + 1];
  return std::lower_bound(first, last, owned_nodes_) - neighbours_.begin();
}

std::size_t NodalSparsity::row_size(std::size_t node) const {
  std::size_t size = 0;
  for (std::size_t field = 0; field < fields_.size(); ++field)
    size += fields_[field].components * living(field, neighbour_starts_[node], neighbour_starts_[node + 1]);
  return size;
}

// Local dofs are ascending as: owned ones field by field, then ghosts field by field.
LocalOrdinal* NodalSparsity::write_columns(std::size_t node, LocalOrdinal* columns) const {
  const auto write = [&](std::size_t first, std::size_t last) {
    for (const FieldRows& rows : fields_)
      for (std::size_t n = first; n < last; ++n)
        for (int i = 0; i < rows.components && rows.lives(neighbours_[n]); ++i) *columns++ = rows(neighbours_[n], i);
  };
  const std::size_t ghosts = first_ghost(node);
  write(neighbour_starts_[node], ghosts);
  write(ghosts, neighbour_starts_[node + 1]);
  return columns;
}

// The rows as the graph holds them, ascending: entries given one by one would each be searched for in what the row has already.
RCP<const Graph> NodalSparsity::graph() const {
  const std::size_t rows = local_id_count(*dofs_);
  Graph::local_graph_device_type::row_map_type::non_const_type starts("starts", rows + 1);
  for_each_row([&](LocalOrdinal row, LocalOrdinal node) { starts(row + 1) = starts(row) + row_size(node); });
  Graph::local_graph_device_type::entries_type::non_const_type columns(Kokkos::view_alloc(Kokkos::WithoutInitializing, "columns"), starts(rows));
  LocalOrdinal* next = columns.data();
  for_each_row([&](LocalOrdinal, LocalOrdinal node) { next = write_columns(node, next); });
  const auto graph = rcp(new Graph(dofs_, local_dofs_, starts, columns));
  graph->expertStaticFillComplete(dofs_, dofs_);
  return graph;
}

LocalOrdinal NodalSparsity::position(LocalOrdinal row, LocalOrdinal column, std::size_t field) const {
  if (row >= owned_nodes_ || !fields_[field].lives(column)) return -1;
  const std::size_t first = neighbour_starts_[row], last = neighbour_starts_[row + 1];
  const auto found = std::lower_bound(neighbours_.begin() + first, neighbours_.begin() + last, column);
  if (found == neighbours_.begin() + last || *found != column) return -1;
  const std::size_t ghosts = first_ghost(row), place = found - neighbours_.begin(), begin = column < owned_nodes_ ? first : ghosts,
                    end = column < owned_nodes_ ? ghosts : last;
  std::size_t before = fields_[field].components * living(field, begin, place);
  for (std::size_t other = 0; other < fields_.size(); ++other) {
    if (begin == ghosts) before += fields_[other].components * living(other, first, ghosts);
    if (other < field) before += fields_[other].components * living(other, begin, end);
  }
  return static_cast<LocalOrdinal>(before);
}

NodalSparsity::Values NodalSparsity::open(Matrix& matrix) const {
  const auto graph = matrix.getCrsGraph();
  const std::size_t rows = local_id_count(*dofs_);
  if (local_row_count(*graph) != rows || !graph->isSorted() || !begins_with(*graph->getColMap(), *local_dofs_))
    throw std::logic_error("a matrix was handed to the bulk that does not have the bulk's rows and columns");
  const auto local = matrix.getLocalMatrixHost();
  Values values(matrix, *this);
  // Sorted rows of the same size have the same entries, as no row lacks one of the bulk's.
  std::size_t gathered = 0;
  for_each_row([&](LocalOrdinal row, LocalOrdinal node) {
    const std::size_t size = row_size(node), entries = local.graph.row_map(row + 1) - local.graph.row_map(row);
    if (entries < size) throw std::logic_error("a matrix was handed to the bulk that lacks entries of the bulk's graph");
    if (entries == size) return;
    values.wider_.push_back({row, node});
    gathered += size;
  });
  values.gathered_.assign(gathered, 0.0);
  values.rows_.resize(rows);
  for (std::size_t row = 0; row < rows; ++row) values.rows_[row] = local.values.data() + local.graph.row_map(row);
  double* next = values.gathered_.data();
  for (const auto& wider : values.wider_) {
    values.rows_[wider.row] = next;
    next += row_size(wider.node);
  }
  return values;
}

void NodalSparsity::Values::close() const {
  std::vector<LocalOrdinal> columns;
  for (const auto& [row, node] : wider_) {
    columns.resize(sparsity_.row_size(node));
    sparsity_.write_columns(node, columns.data());
    const auto count = static_cast<LocalOrdinal>(columns.size());
    if (matrix_.sumIntoLocalValues(row, count, rows_[row], columns.data()) != count)
      throw std::logic_error("a matrix was handed to the bulk that lacks entries of the bulk's graph");
  }
}

}  // namespace mortise
