#include "evaluation/system_scatter.hpp"

#include <Tpetra_CrsGraph.hpp>
#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Export.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <map>
#include <numeric>
#include <stdexcept>

#include "evaluation/evaluated_contact.hpp"
#include "mortise/core/column_map.hpp"
#include "mortise/core/trilinos_versions.hpp"

namespace mortise::detail {
namespace {

using Columns = std::vector<GlobalOrdinal>;

void sort_unique(Columns& columns) {
  std::sort(columns.begin(), columns.end());
  columns.erase(std::unique(columns.begin(), columns.end()), columns.end());
}

/// Contributions of contact to the rows of nodes: columns, by node id, and the rows themselves, as global ids.
struct NodeRows {
  std::vector<GlobalOrdinal> ids;
  Columns columns;
};
using NodeRowMap = std::map<GlobalOrdinal, NodeRows>;

// Local rows of the components of all fields at an owned node, those that there are.
std::vector<LocalOrdinal> rows_of(const ContactModel& model, LocalOrdinal node) {
  std::vector<LocalOrdinal> rows;
  for (int i = 0; i < model.dimension; ++i)
    if (const LocalOrdinal row = model.rows[static_cast<std::size_t>(model.dimension * node + i)]; row >= 0) rows.push_back(row);
  for (const NodalField& field : model.further)
    for (int i = 0; i < field.components(); ++i)
      if (const GlobalOrdinal id = field.id(node, i); id != NodalField::none) rows.push_back(model.dofs->getLocalElement(id));
  return rows;
}

// Ids of the components of all fields at a local node of a pair, those that there are.
void add_ids(const EvaluatedContact& contact, std::size_t pair, LocalOrdinal node, Columns& ids) {
  for (int i = 0; i < contact.model->dimension; ++i)
    if (const GlobalOrdinal id = contact.id(pair, node, i); id != NodalField::none) ids.push_back(id);
  for (std::size_t f = 0; f < contact.model->further.size(); ++f) {
    const int components = contact.model->further[f].components();
    for (int i = 0; i < components; ++i)
      if (const GlobalOrdinal id = contact.dofs[pair]->further[f][static_cast<std::size_t>(components * node + i)]; id != NodalField::none)
        ids.push_back(id);
  }
}

// Of the rows of all components of a node together: hosts that leave out zeros give them different columns, and condensation combines the rows.
Columns bulk_columns(const Graph& bulk, const ContactModel& model, LocalOrdinal node) {
  Columns columns;
  for (const LocalOrdinal row : rows_of(model, node)) {
    Graph::local_inds_host_view_type local;
    bulk.getLocalRowView(row, local);
    for (std::size_t k = 0; k < local.extent(0); ++k) columns.push_back(bulk.getColMap()->getGlobalElement(local(k)));
  }
  sort_unique(columns);
  return columns;
}

// Adds the columns that condensation brings to a node's rows: the same for all components of the node. The multipliers are those that are condensed
// before corners, or the others, in whose rows the former's columns `of_middles` stand by then.
void add_columns(const Graph& bulk, const EvaluatedContact& contact, bool before_corners, const NodeRowMap& of_middles, NodeRowMap& rows_of_node) {
  for (std::size_t p = 0; p < contact.pairs.size(); ++p) {
    const PairEvaluation& pair = contact.pairs[p];
    const Map& nodes = pair.local_nodes();
    for (std::size_t s = 0; s < pair.slave_nodes().size(); ++s) {
      const SlaveNode& slave = pair.slave_nodes()[s];
      if (!slave.carries_multiplier || pair.pair().before_corners(s) != before_corners) continue;
      Columns columns = bulk_columns(bulk, *contact.model, slave.owned_node);
      for (const LocalOrdinal node : pair.coupled_nodes(s)) add_ids(contact, p, node, columns);
      if (const auto found = of_middles.find(slave.id); found != of_middles.end())
        columns.insert(columns.end(), found->second.columns.begin(), found->second.columns.end());
      sort_unique(columns);
      for (const LocalOrdinal node : pair.loaded_nodes(s)) {
        NodeRows& into = rows_of_node[nodes.getGlobalElement(node)];
        into.columns.insert(into.columns.end(), columns.begin(), columns.end());
        if (into.ids.empty()) add_ids(contact, p, node, into.ids);
      }
    }
  }
  for (auto& [node, rows] : rows_of_node) sort_unique(rows.columns);
}

RCP<Graph> remote_graph(const NodeRowMap& rows_of_node, const Map& owned_nodes, const RCP<const Map>& dofs) {
  std::vector<GlobalOrdinal> ids;
  std::vector<const Columns*> columns;
  std::vector<std::size_t> sizes;
  for (const auto& [node, rows] : rows_of_node) {
    if (owned_nodes.isNodeGlobalElement(node)) continue;
    for (const GlobalOrdinal id : rows.ids) {
      ids.push_back(id);
      columns.push_back(&rows.columns);
      sizes.push_back(rows.columns.size());
    }
  }
  const auto invalid = Teuchos::OrdinalTraits<Tpetra::global_size_t>::invalid();
  const auto map = rcp(new Map(invalid, ids.data(), static_cast<LocalOrdinal>(ids.size()), 0, dofs->getComm()));
  const auto graph = rcp(new Graph(map, Teuchos::arrayViewFromVector(sizes)));
  for (std::size_t row = 0; row < ids.size(); ++row)
    graph->insertGlobalIndices(ids[row], static_cast<LocalOrdinal>(columns[row]->size()), columns[row]->data());
  graph->fillComplete(dofs, dofs);
  return graph;
}

// Rows that other ranks ask of this one, merged into `rows_of_node`.
void receive(const Graph& remote, const Export& exporter, const ContactModel& model, NodeRowMap& rows_of_node) {
  const RCP<const Map>& dofs = model.dofs;
  Graph incoming(dofs, 0);
  incoming.doExport(remote, exporter, Tpetra::INSERT);
  for (LocalOrdinal node = 0; node < static_cast<LocalOrdinal>(local_id_count(*model.owned_nodes)); ++node) {
    const std::vector<LocalOrdinal> rows = rows_of(model, node);  // all of them got the same columns
    if (rows.empty()) continue;
    const GlobalOrdinal id = dofs->getGlobalElement(rows.front());
    std::size_t count = incoming.getNumEntriesInGlobalRow(id);
    if (count == 0 || count == Teuchos::OrdinalTraits<std::size_t>::invalid()) continue;
    Graph::nonconst_global_inds_host_view_type columns("columns", count);
    incoming.getGlobalRowCopy(id, columns, count);
    Columns& into = rows_of_node[model.owned_nodes->getGlobalElement(node)].columns;
    into.insert(into.end(), columns.data(), columns.data() + count);
    sort_unique(into);
  }
}

// The bulk's columns, and after them those of `rows_of_node` that are not among them, ascending.
RCP<const Map> widened_columns(const Graph& bulk, const NodeRowMap& rows_of_node, const Map& owned_nodes) {
  Columns further;
  for (const auto& [node, more] : rows_of_node)
    if (owned_nodes.isNodeGlobalElement(node)) further.insert(further.end(), more.columns.begin(), more.columns.end());
  return with_further_columns(*bulk.getColMap(), std::move(further));
}

// The bulk's graph with `rows_of_node` in the rows of owned nodes. Rows are given whole and ascending, those of other nodes as they are.
RCP<const Graph> widened(const Graph& bulk, const NodeRowMap& rows_of_node, const ContactModel& model) {
  const RCP<const Map> dofs = bulk.getRowMap(), columns = widened_columns(bulk, rows_of_node, *model.owned_nodes);
  const auto rows = static_cast<LocalOrdinal>(local_id_count(*dofs));
  const auto narrow = bulk.getLocalGraphHost();
  std::map<LocalOrdinal, std::vector<LocalOrdinal>> wide;  // by row
  for (const auto& [node, more] : rows_of_node) {
    const LocalOrdinal owned = model.owned_nodes->getLocalElement(node);
    if (owned < 0) continue;
    for (const LocalOrdinal row : rows_of(model, owned)) {
      std::vector<LocalOrdinal>& all = wide[row];
      for (std::size_t k = narrow.row_map(row); k < narrow.row_map(row + 1); ++k) all.push_back(narrow.entries(k));
      for (const GlobalOrdinal id : more.columns) all.push_back(columns->getLocalElement(id));
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

SystemScatter::SystemScatter(const Graph& bulk, const EvaluatedContact& contact)
    : dimension_(contact.model->dimension), parallel_(contact.model->comm().getSize() > 1) {
  const ContactModel& model = *contact.model;
  NodeRowMap of_middles;
  if (model.middles_first) {
    add_columns(bulk, contact, true, {}, of_middles);
    if (parallel_) {
      const RCP<Graph> remote = remote_graph(of_middles, *model.owned_nodes, model.dofs);
      receive(*remote, Export(remote->getRowMap(), model.dofs), model, of_middles);
    }
  }
  NodeRowMap rows_of_node = of_middles;
  add_columns(bulk, contact, false, of_middles, rows_of_node);

  if (parallel_) {
    const RCP<Graph> remote = remote_graph(rows_of_node, *model.owned_nodes, model.dofs);
    export_ = rcp(new Export(remote->getRowMap(), model.dofs));
    receive(*remote, *export_, model, rows_of_node);
    remote_matrix_ = rcp(new Matrix(remote));
    remote_vector_ = rcp(new Vector(remote->getRowMap()));
  }

  graph_ = widened(bulk, rows_of_node, model);

  const RCP<const Map> columns = graph_->getColMap();
  if (parallel_) {
    remote_column_of_.resize(local_id_count(*columns));
    for (std::size_t c = 0; c < remote_column_of_.size(); ++c)
      remote_column_of_[c] = remote_matrix_->getColMap()->getLocalElement(columns->getGlobalElement(static_cast<LocalOrdinal>(c)));
  }
  for (std::size_t p = 0; p < contact.pairs.size(); ++p) {
    NodePositions positions;
    for (const GlobalOrdinal id : contact.dofs[p]->ids) {
      const bool is_unknown = id != NodalField::none;
      positions.row.push_back(is_unknown ? model.dofs->getLocalElement(id) : -1);
      positions.remote_row.push_back(is_unknown && parallel_ && positions.row.back() < 0 ? remote_matrix_->getRowMap()->getLocalElement(id) : -1);
      positions.column.push_back(is_unknown ? columns->getLocalElement(id) : -1);
    }
    positions_.push_back(std::move(positions));
    patterns_.push_back(contact.dofs[p]->pattern);
  }
}

bool SystemScatter::fits(const std::vector<PairEvaluation>& pairs) const {
  return std::equal(pairs.begin(), pairs.end(), patterns_.begin(), patterns_.end(),
                    [](const PairEvaluation& pair, const auto& pattern) { return pair.geometry()->pattern == pattern; });
}

void SystemScatter::add(Matrix& system, const NodePositions& positions, LocalOrdinal node, int component, const std::vector<LocalOrdinal>& columns,
                        const std::vector<double>& values) {
  const auto place = static_cast<std::size_t>(dimension_ * node + component);
  const LocalOrdinal row = positions.row[place], remote_row = positions.remote_row[place];
  if (row < 0 && remote_row < 0) return;
  const LocalOrdinal* at = columns.data();
  const double* add = values.data();
  auto count = static_cast<LocalOrdinal>(columns.size());
  const bool has_gaps = std::find(columns.begin(), columns.end(), -1) != columns.end();
  if (row < 0 || has_gaps) {
    column_buffer_.clear();
    value_buffer_.clear();
    for (std::size_t k = 0; k < columns.size(); ++k) {
      if (columns[k] < 0) continue;
      column_buffer_.push_back(row < 0 ? remote_column_of_[static_cast<std::size_t>(columns[k])] : columns[k]);
      value_buffer_.push_back(values[k]);
    }
    at = column_buffer_.data();
    add = value_buffer_.data();
    count = static_cast<LocalOrdinal>(column_buffer_.size());
  }
  const LocalOrdinal summed =
      row >= 0 ? system.sumIntoLocalValues(row, count, add, at) : remote_matrix_->sumIntoLocalValues(remote_row, count, add, at);
  if (summed != count)
    throw std::logic_error(
        "contact: an entry of the condensed system has no place in its matrix; make the matrix on the graph of ContactSystem::graph()");
}

void SystemScatter::add(Vector& vector, const NodePositions& positions, LocalOrdinal node, int component, double value) {
  const auto place = static_cast<std::size_t>(dimension_ * node + component);
  if (const LocalOrdinal row = positions.row[place]; row >= 0)
    vector.sumIntoLocalValue(row, value);
  else if (const LocalOrdinal remote = positions.remote_row[place]; remote >= 0)
    remote_vector_->sumIntoLocalValue(remote, value);
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
