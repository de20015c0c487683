#include "model/edges/widened_graph.hpp"

#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_CrsGraph.hpp>
#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Map.hpp>
#include <algorithm>
#include <map>
#include <numeric>
#include <vector>

#include "mortise/core/column_map.hpp"
#include "mortise/core/trilinos_versions.hpp"

namespace mortise {

RCP<const Graph> widened(const Graph& bulk, const FieldSpace& space, const std::set<std::pair<GlobalOrdinal, GlobalOrdinal>>& coupled) {
  std::map<LocalOrdinal, std::vector<GlobalOrdinal>> of_row;
  std::vector<GlobalOrdinal> further;
  for (const auto& [one, other] : coupled) {
    const LocalOrdinal node = space.mesh()->owned_nodes->getLocalElement(one);
    if (node < 0) continue;
    const int components = space.rows(0).components;
    for (int j = 0; j < components; ++j) {
      further.push_back(space.id(0, other, j));
      for (int i = 0; i < components; ++i) of_row[space.row(node, i)].push_back(further.back());
    }
  }
  const RCP<const Map> rows = bulk.getRowMap(), columns = with_further_columns(*bulk.getColMap(), further);
  const auto narrow = bulk.getLocalGraphHost();
  const auto count = static_cast<LocalOrdinal>(local_id_count(*rows));
  std::map<LocalOrdinal, std::vector<LocalOrdinal>> wide;
  for (const auto& [row, ids] : of_row) {
    std::vector<LocalOrdinal>& all = wide[row];
    for (std::size_t k = narrow.row_map(row); k < narrow.row_map(row + 1); ++k) all.push_back(narrow.entries(k));
    for (const GlobalOrdinal id : ids) all.push_back(columns->getLocalElement(id));
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
  }
  Graph::local_graph_device_type::row_map_type::non_const_type starts("starts", static_cast<std::size_t>(count) + 1);
  for (LocalOrdinal row = 0; row < count; ++row) starts(row + 1) = narrow.row_map(row + 1) - narrow.row_map(row);
  for (const auto& [row, all] : wide) starts(row + 1) = all.size();
  std::partial_sum(starts.data(), starts.data() + starts.extent(0), starts.data());
  Graph::local_graph_device_type::entries_type::non_const_type entries(Kokkos::view_alloc(Kokkos::WithoutInitializing, "entries"), starts(count));
  for (LocalOrdinal row = 0; row < count; ++row) {
    const auto found = wide.find(row);
    if (found != wide.end())
      std::copy(found->second.begin(), found->second.end(), entries.data() + starts(row));
    else
      std::copy(narrow.entries.data() + narrow.row_map(row), narrow.entries.data() + narrow.row_map(row + 1), entries.data() + starts(row));
  }
  const auto graph = rcp(new Graph(rows, columns, starts, entries));
  graph->expertStaticFillComplete(rows, rows);
  return graph;
}

namespace {

/// The graph itself if no rank lacks pairs. Collective.
RCP<const Graph> with_missing(const RCP<const Graph>& bulk, const FieldSpace& space,
                              const std::set<std::pair<GlobalOrdinal, GlobalOrdinal>>& missing) {
  const int mine = missing.empty() ? 0 : 1;
  int anywhere = 0;
  Teuchos::reduceAll(*bulk->getComm(), Teuchos::REDUCE_MAX, mine, Teuchos::outArg(anywhere));
  return anywhere == 0 ? bulk : widened(*bulk, space, missing);
}

}  // namespace

RCP<const Graph> with_couplings(const RCP<const Graph>& bulk, const FieldSpace& space,
                                const std::set<std::pair<GlobalOrdinal, GlobalOrdinal>>& coupled) {
  std::set<std::pair<GlobalOrdinal, GlobalOrdinal>> missing;
  const auto graph = bulk->getLocalGraphHost();
  for (const auto& [one, other] : coupled) {
    const LocalOrdinal node = space.mesh()->owned_nodes->getLocalElement(one), column = bulk->getColMap()->getLocalElement(space.id(0, other, 0));
    if (node < 0) continue;
    const LocalOrdinal row = space.row(node, 0);
    const auto *first = graph.entries.data() + graph.row_map(row), *last = graph.entries.data() + graph.row_map(row + 1);
    if (column < 0 || std::find(first, last, column) == last) missing.emplace(one, other);
  }
  return with_missing(bulk, space, missing);
}

RCP<const Graph> with_entries_of(const RCP<const Graph>& bulk, const Matrix& of_nodes, const FieldSpace& space) {
  std::set<std::pair<GlobalOrdinal, GlobalOrdinal>> coupled;
  const auto mass = of_nodes.getLocalMatrixHost();
  const auto graph = bulk->getLocalGraphHost();
  for (LocalOrdinal node = 0; node < static_cast<LocalOrdinal>(local_row_count(of_nodes)); ++node) {
    const LocalOrdinal row = space.row(node, 0);
    const auto *first = graph.entries.data() + graph.row_map(row), *last = graph.entries.data() + graph.row_map(row + 1);
    for (std::size_t k = mass.graph.row_map(node); k < mass.graph.row_map(node + 1); ++k) {
      const GlobalOrdinal other = of_nodes.getColMap()->getGlobalElement(mass.graph.entries(k));
      const LocalOrdinal column = bulk->getColMap()->getLocalElement(space.id(0, other, 0));
      if (mass.values(k) != 0.0 && (column < 0 || !std::binary_search(first, last, column)))
        coupled.emplace(of_nodes.getRowMap()->getGlobalElement(node), other);
    }
  }
  return with_missing(bulk, space, coupled);
}

}  // namespace mortise
