#include "mortise/mortar/tied_surfaces.hpp"

#include <fmt/format.h>

#include <Teuchos_CommHelpers.hpp>
#include <TpetraExt_MatrixMatrix.hpp>
#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_MultiVector.hpp>
#include <map>
#include <optional>

#include "mortise/core/trilinos_versions.hpp"
#include "ties/tie_checks.hpp"
#include "ties/tie_interface.hpp"

namespace mortise {
namespace {

/// One row of T: ids of dofs and coefficients.
struct TieRow {
  std::size_t tie = 0;
  std::vector<GlobalOrdinal> columns;
  std::vector<double> values;
};

using TieRowMap = std::map<LocalOrdinal, TieRow>;  // by owned dofs

/// Rows of one component: u_j = (sum_l M_jl u_l - sum_k D_jk u_k) / D_jj.
void add_rows(const TieInterface& interface, std::size_t tie, int dimension, int component, TieRowMap& rows) {
  for (const TieInterfaceRow& row : interface.rows()) {
    TieRow& of_dof = rows[dimension * row.owned_node + component];
    of_dof.tie = tie;
    for (const auto& [node, coefficient] : row.sources) {
      of_dof.columns.push_back(dimension * node + component);
      of_dof.values.push_back(coefficient);
    }
  }
}

RCP<const Matrix> matrix_of(const RCP<const Map>& dofs, const TieRowMap& rows) {
  std::vector<std::size_t> sizes(local_id_count(*dofs), 1);
  for (const auto& [dof, row] : rows) sizes[static_cast<std::size_t>(dof)] = row.columns.size();
  const auto R = rcp(new Matrix(dofs, Teuchos::arrayViewFromVector(sizes)));
  for (LocalOrdinal dof = 0; dof < static_cast<LocalOrdinal>(sizes.size()); ++dof) {
    const GlobalOrdinal id = dofs->getGlobalElement(dof);
    const double one = 1.0;
    if (const auto row = rows.find(dof); row != rows.end())
      R->insertGlobalValues(id, static_cast<LocalOrdinal>(row->second.columns.size()), row->second.values.data(), row->second.columns.data());
    else
      R->insertGlobalValues(id, 1, &one, &id);
  }
  R->fillComplete(dofs, dofs);
  // Sources of mid-side nodes are corners, which are tied as well. Sources of corners are not: R R has them put in.
  const auto T = rcp(new Matrix(dofs, 0));
  Tpetra::MatrixMatrix::Multiply(*R, false, *R, false, *T);
  return T;
}

/// True if marks differ on any rank. Collective.
bool differ(const Communicator& comm, const std::vector<char>& one, const std::vector<char>& other) {
  const int mine = one == other ? 0 : 1;
  int any = 0;
  Teuchos::reduceAll(comm, Teuchos::REDUCE_MAX, mine, Teuchos::outArg(any));
  return any != 0;
}

/// Nodes of tie t with a row, over all ranks. Collective.
GlobalOrdinal tied_nodes(const Communicator& comm, int dimension, const TieRowMap& rows, std::size_t t) {
  GlobalOrdinal mine = 0, all = 0;
  LocalOrdinal last = -1;
  for (const auto& [dof, row] : rows) {
    if (row.tie != t || dof / dimension == last) continue;
    last = dof / dimension;
    ++mine;
  }
  Teuchos::reduceAll(comm, Teuchos::REDUCE_SUM, mine, Teuchos::outArg(all));
  return all;
}

}  // namespace

TieRows tie_surfaces(const RCP<const Map>& owned_nodes, const RCP<const Map>& dofs, const RCP<const MultiVector>& reference,
                     const RCP<const MultiVector>& held, const std::vector<TiedPair>& ties, const InterfaceMeasure& measure) {
  const Communicator& comm = *owned_nodes->getComm();
  const auto dimension = static_cast<int>(reference->getNumVectors());
  const TieMarks shared(owned_nodes, ties);
  const auto is_held = held->getLocalViewHost(Tpetra::Access::ReadOnly);
  TieRows result;
  TieRowMap rows;
  for (std::size_t t = 0; t < ties.size(); ++t) {
    refuse_shared_facets(owned_nodes, *reference, shared, ties, t);
    const TieCover cover = measure_cover(owned_nodes, reference, ties[t], measure);
    std::vector<char> without(local_id_count(*owned_nodes)), last;
    std::optional<TieInterface> interface;
    for (int i = 0; i < dimension; ++i) {
      for (std::size_t node = 0; node < without.size(); ++node)
        without[node] = is_held(node, i) != 0.0 || shared.meets(t, node) || (cover.on_slave[node] != 0 && cover.share[node] < least_tied_cover);
      if (!interface || differ(comm, without, last)) interface.emplace(owned_nodes, reference, ties[t], without, measure);
      last = without;
      add_rows(*interface, t, dimension, i, rows);
    }
    result.counts.push_back({tied_nodes(comm, dimension, rows, t), cover.open});
    if (result.counts.back().tied == 0)
      throw InputError(ties[t].place,
                       fmt::format("tie \"{}\" holds nothing: all slave nodes that a master covers are prescribed, follow a rigid body or "
                                   "a reference point, or belong to other ties; please exchange slave and master",
                                   ties[t].name));
  }
  for (const auto& [dof, row] : rows) {
    result.dofs.push_back(dof);
    result.tie_of.push_back(row.tie);
  }
  result.T = matrix_of(dofs, rows);
  return result;
}

}  // namespace mortise
