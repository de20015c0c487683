#include "system_scatter.hpp"

#include <Tpetra_CrsGraph.hpp>
#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Export.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <map>
#include <numeric>
#include <stdexcept>

#include "mortise/core/column_map.hpp"
#include "mortise/core/dof_map.hpp"

namespace mortise::detail {
namespace {

using Columns = std::vector<GlobalOrdinal>;

void sort_unique(Columns& columns) {
  std::sort(columns.begin(), columns.end());
  columns.erase(std::unique(columns.begin(), columns.end()), columns.end());
}

// Of the rows of all components of a node together: hosts that leave out zeros give them different columns, and condensation combines the rows.
Columns bulk_columns(const Graph& bulk, LocalOrdinal node, int dimension) {
  Columns columns;
  for (LocalOrdinal row = dimension * node; row < dimension * (node + 1); ++row) {
    Graph::local_inds_host_view_type local;
    bulk.getLocalRowView(row, local);
    for (std::size_t k = 0; k < local.extent(0); ++k) columns.push_back(bulk.getColMap()->getGlobalElement(local(k)));
  }
  sort_unique(columns);
  return columns;
}

// Adds the columns that condensation brings to a node's rows, by node id: the same for all components of the node. The multipliers are those that
// are condensed before corners, or the others, in whose rows the former's columns `of_middles` stand by then.
void add_columns(const Graph& bulk, const std::vector<PairEvaluation>& pairs, int dimension, bool before_corners,
                 const std::map<GlobalOrdinal, Columns>& of_middles, std::map<GlobalOrdinal, Columns>& columns_of_node) {
  for (const PairEvaluation& pair : pairs) {
    const Map& nodes = pair.local_nodes();
    for (std::size_t s = 0; s < pair.slave_nodes().size(); ++s) {
      const SlaveNode& slave = pair.slave_nodes()[s];
      if (!slave.carries_multiplier || pair.pair().before_corners(s) != before_corners) continue;
      Columns columns = bulk_columns(bulk, slave.owned_node, dimension);
      for (const LocalOrdinal node : pair.coupled_nodes(s))
        for (int i = 0; i < dimension; ++i) columns.push_back(dimension * nodes.getGlobalElement(node) + i);
      if (const auto found = of_middles.find(slave.id); found != of_middles.end())
        columns.insert(columns.end(), found->second.begin(), found->second.end());
      sort_unique(columns);
      for (const LocalOrdinal node : pair.loaded_nodes(s)) {
        Columns& into = columns_of_node[nodes.getGlobalElement(node)];
        into.insert(into.end(), columns.begin(), columns.end());
      }
    }
  }
  for (auto& [node, columns] : columns_of_node) sort_unique(columns);
}

RCP<Graph> remote_graph(const std::map<GlobalOrdinal, Columns>& columns_of_node, const Map& owned_nodes, const RCP<const Map>& dofs, int dimension) {
  std::vector<GlobalOrdinal> rows;
  std::vector<std::size_t> sizes;
  for (const auto& [node, columns] : columns_of_node) {
    if (owned_nodes.isNodeGlobalElement(node)) continue;
    for (int i = 0; i < dimension; ++i) {
      rows.push_back(dimension * node + i);
      sizes.push_back(columns.size());
    }
  }
  const auto invalid = Teuchos::OrdinalTraits<Tpetra::global_size_t>::invalid();
  const auto map = rcp(new Map(invalid, rows.data(), static_cast<LocalOrdinal>(rows.size()), 0, dofs->getComm()));
  const auto graph = rcp(new Graph(map, Teuchos::arrayViewFromVector(sizes)));
  for (const GlobalOrdinal row : rows) {
    const Columns& columns = columns_of_node.at(row / dimension);
    graph->insertGlobalIndices(row, static_cast<LocalOrdinal>(columns.size()), columns.data());
  }
  graph->fillComplete(dofs, dofs);
  return graph;
}

// Rows that other ranks ask of this one, merged into `columns_of_node`.
void receive(const Graph& remote, const Export& exporter, const RCP<const Map>& dofs, int dimension,
             std::map<GlobalOrdinal, Columns>& columns_of_node) {
  Graph incoming(dofs, 0);
  incoming.doExport(remote, exporter, Tpetra::INSERT);
  const LocalOrdinal rows = static_cast<LocalOrdinal>(dofs->getNodeNumElements());
  for (LocalOrdinal row = 0; row < rows; row += dimension) {
    const GlobalOrdinal id = dofs->getGlobalElement(row);
    std::size_t count = incoming.getNumEntriesInGlobalRow(id);
    if (count == 0 || count == Teuchos::OrdinalTraits<std::size_t>::invalid()) continue;
    Graph::nonconst_global_inds_host_view_type columns("columns", count);
    incoming.getGlobalRowCopy(id, columns, count);
    Columns& into = columns_of_node[id / dimension];
    into.insert(into.end(), columns.data(), columns.data() + count);
    sort_unique(into);
  }
}

// The bulk's columns, and after them those of `columns_of_node` that are not among them, ascending.
RCP<const Map> widened_columns(const Graph& bulk, const std::map<GlobalOrdinal, Columns>& columns_of_node, const Map& owned_nodes) {
  Columns further;
  for (const auto& [node, more] : columns_of_node)
    if (owned_nodes.isNodeGlobalElement(node)) further.insert(further.end(), more.begin(), more.end());
  return with_further_columns(*bulk.getColMap(), std::move(further));
}

// The bulk's graph with `columns_of_node` in the rows of owned nodes. Rows are given whole and ascending, those of other nodes as they are.
RCP<const Graph> widened(const Graph& bulk, const std::map<GlobalOrdinal, Columns>& columns_of_node, const Map& owned_nodes, int dimension) {
  const RCP<const Map> dofs = bulk.getRowMap(), columns = widened_columns(bulk, columns_of_node, owned_nodes);
  const auto rows = static_cast<LocalOrdinal>(dofs->getNodeNumElements());
  const auto narrow = bulk.getLocalGraphHost();
  std::map<LocalOrdinal, std::vector<LocalOrdinal>> wide;  // by row
  for (const auto& [node, more] : columns_of_node) {
    const LocalOrdinal owned = owned_nodes.getLocalElement(node);
    if (owned < 0) continue;
    for (LocalOrdinal row = dimension * owned; row < dimension * (owned + 1); ++row) {
      std::vector<LocalOrdinal>& all = wide[row];
      for (std::size_t k = narrow.row_map(row); k < narrow.row_map(row + 1); ++k) all.push_back(narrow.entries(k));
      for (const GlobalOrdinal id : more) all.push_back(columns->getLocalElement(id));
      std::sort(all.begin(), all.end());
      all.erase(std::unique(all.begin(), all.end()), all.end());
    }
  }
  Graph::local_graph_device_type::row_map_type::non_const_type starts("starts", static_cast<std::size_t>(rows) + 1);
  for (LocalOrdinal row = 0; row < rows; ++row) starts(row + 1) = narrow.row_map(row + 1) - narrow.row_map(row);
  for (const auto& [row, all] : wide) starts(row + 1) = all.size();
  std::partial_sum(starts.data(), starts.data() + starts.extent(0), starts.data());
  Graph::local_graph_device_type::entries_type::non_const_type entries(Kokkos::view_alloc(Kokkos::WithoutInitializing, "entries"), starts(rows));
  for (LocalOrdinal row = 0; row < rows; ++row) {
    const auto found = wide.find(row);
    if (found != wide.end())
      std::copy(found->second.begin(), found->second.end(), entries.data() + starts(row));
    else
      std::copy(narrow.entries.data() + narrow.row_map(row), narrow.entries.data() + narrow.row_map(row + 1), entries.data() + starts(row));
  }
  const auto graph = rcp(new Graph(dofs, columns, starts, entries));
  graph->expertStaticFillComplete(dofs, dofs);
  return graph;
}

}  // namespace

SystemScatter::SystemScatter(const RCP<const Map>& owned_nodes, const Graph& bulk, const std::vector<PairEvaluation>& pairs, bool middles_first) {
  const RCP<const Map> dofs = bulk.getRowMap();
  parallel_ = dofs->getComm()->getSize() > 1;
  const int dimension = pairs.empty() ? 1 : pairs.front().dimension();
  std::map<GlobalOrdinal, Columns> of_middles;
  if (middles_first) {
    add_columns(bulk, pairs, dimension, true, {}, of_middles);
    if (parallel_) {
      const RCP<Graph> remote = remote_graph(of_middles, *owned_nodes, dofs, dimension);
      receive(*remote, Export(remote->getRowMap(), dofs), dofs, dimension, of_middles);
    }
  }
  std::map<GlobalOrdinal, Columns> columns_of_node = of_middles;
  add_columns(bulk, pairs, dimension, false, of_middles, columns_of_node);

  if (parallel_) {
    const RCP<Graph> remote = remote_graph(columns_of_node, *owned_nodes, dofs, dimension);
    export_ = rcp(new Export(remote->getRowMap(), dofs));
    receive(*remote, *export_, dofs, dimension, columns_of_node);
    remote_matrix_ = rcp(new Matrix(remote));
    remote_vector_ = rcp(new Vector(remote->getRowMap()));
  }

  graph_ = widened(bulk, columns_of_node, *owned_nodes, dimension);

  const RCP<const Map> columns = graph_->getColMap();
  if (parallel_) {
    remote_column_of_.resize(columns->getNodeNumElements());
    for (std::size_t c = 0; c < remote_column_of_.size(); ++c)
      remote_column_of_[c] = remote_matrix_->getColMap()->getLocalElement(columns->getGlobalElement(static_cast<LocalOrdinal>(c)));
  }
  for (const PairEvaluation& pair : pairs) {
    const Map& nodes = pair.local_nodes();
    NodePositions positions;
    for (LocalOrdinal node = 0; node < static_cast<LocalOrdinal>(nodes.getNodeNumElements()); ++node) {
      const GlobalOrdinal id = nodes.getGlobalElement(node);
      const LocalOrdinal owned = owned_nodes->getLocalElement(id);
      positions.row.push_back(owned < 0 ? -1 : dimension * owned);
      positions.remote_row.push_back(owned < 0 && parallel_ ? remote_matrix_->getRowMap()->getLocalElement(dimension * id) : -1);
      for (int i = 0; i < dimension; ++i) {
        positions.column.push_back(columns->getLocalElement(dimension * id + i));
        positions.remote_column.push_back(parallel_ ? remote_matrix_->getColMap()->getLocalElement(dimension * id + i) : -1);
      }
    }
    positions_.push_back(std::move(positions));
    patterns_.push_back(pair.geometry()->pattern);
  }
}

bool SystemScatter::fits(const std::vector<PairEvaluation>& pairs) const {
  return std::equal(pairs.begin(), pairs.end(), patterns_.begin(), patterns_.end(),
                    [](const PairEvaluation& pair, const auto& pattern) { return pair.geometry()->pattern == pattern; });
}

void SystemScatter::add(Matrix& system, const NodePositions& positions, LocalOrdinal node, int component, const std::vector<LocalOrdinal>& columns,
                        const std::vector<double>& values) {
  const auto count = static_cast<LocalOrdinal>(columns.size());
  LocalOrdinal summed;
  if (positions.row[node] >= 0) {
    summed = system.sumIntoLocalValues(positions.row[node] + component, count, values.data(), columns.data());
  } else {
    column_buffer_.resize(columns.size());
    std::transform(columns.begin(), columns.end(), column_buffer_.begin(), [this](LocalOrdinal c) { return remote_column_of_[c]; });
    summed = remote_matrix_->sumIntoLocalValues(positions.remote_row[node] + component, count, values.data(), column_buffer_.data());
  }
  if (summed != count)
    throw std::logic_error(
        "contact: an entry of the condensed system has no place in its matrix; make the matrix on the graph of ContactSystem::graph()");
}

void SystemScatter::add(Vector& vector, const NodePositions& positions, LocalOrdinal node, int component, double value) {
  if (positions.row[node] >= 0)
    vector.sumIntoLocalValue(positions.row[node] + component, value);
  else
    remote_vector_->sumIntoLocalValue(positions.remote_row[node] + component, value);
}

void SystemScatter::finish(Matrix& system) {
  if (!parallel_) return;
  remote_matrix_->fillComplete(system.getDomainMap(), system.getRangeMap());
  system.doExport(*remote_matrix_, *export_, Tpetra::ADD);
  remote_matrix_->resumeFill();
  remote_matrix_->setAllToScalar(0.0);
}

void SystemScatter::finish(Vector& vector) {
  if (!parallel_) return;
  vector.doExport(*remote_vector_, *export_, Tpetra::ADD);
  remote_vector_->putScalar(0.0);
}

}  // namespace mortise::detail
