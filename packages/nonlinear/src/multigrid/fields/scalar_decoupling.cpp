#include "multigrid/fields/scalar_decoupling.hpp"

#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Import.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_Vector.hpp>
#include <algorithm>

#include "mortise/core/trilinos_versions.hpp"

namespace mortise::detail {
namespace {

/// Of the diagonal: a coupling across contact that is stronger joins the bodies.
constexpr double joining = 0.5;

/// A slave node that is joined: its row, and the entries of S.
struct JoinedNode {
  LocalOrdinal row;
  std::vector<GlobalOrdinal> masters;
  std::vector<double> shares;
};

/// Ids in `field` at the rows of `first` with the same node, -1: the field does not live there.
Vector ids_at(const FieldPart& field, const FieldPart& first) {
  std::vector<double> id_of_node;
  for (std::size_t place = 0; place < field.nodes().size(); ++place) {
    const auto node = static_cast<std::size_t>(field.nodes()[place]);
    if (node >= id_of_node.size()) id_of_node.resize(node + 1, -1.0);
    id_of_node[node] = static_cast<double>(field.map()->getGlobalElement(static_cast<LocalOrdinal>(place)));
  }
  Vector ids(first.map());
  const auto id = ids.getLocalViewHost(Tpetra::Access::OverwriteAll);
  for (std::size_t place = 0; place < first.nodes().size(); ++place) {
    const auto node = static_cast<std::size_t>(first.nodes()[place]);
    id(place, 0) = node < id_of_node.size() ? id_of_node[node] : -1.0;
  }
  return ids;
}

/// The node of a row of A as it is coupled to those of the master, `masters`, ascending; without any if it is not joined.
JoinedNode joined_node(const Matrix& A, LocalOrdinal row, const std::vector<GlobalOrdinal>& masters) {
  JoinedNode node{row, {}, {}};
  const GlobalOrdinal own = A.getRowMap()->getGlobalElement(row);
  const auto local = A.getLocalMatrixHost();
  const auto entries = local.rowConst(row);
  double diagonal = 0.0, beta = 0.0;
  for (LocalOrdinal k = 0; k < entries.length; ++k) {
    const GlobalOrdinal column = A.getColMap()->getGlobalElement(entries.colidx(k));
    if (column == own) diagonal = entries.value(k);
    if (column == own || entries.value(k) == 0.0 || !std::binary_search(masters.begin(), masters.end(), column)) continue;
    node.masters.push_back(column);
    node.shares.push_back(-entries.value(k));
    beta -= entries.value(k);
  }
  if (!(beta > joining * diagonal)) return {row, {}, {}};
  for (double& share : node.shares) share /= beta;
  return node;
}

std::vector<JoinedNode> joined_nodes(const Matrix& A, const FieldPart& field, const FieldPart& first, const Decoupling& of_first) {
  const Vector ids = ids_at(field, first);
  Vector column_ids(of_first.trial->getColMap());
  column_ids.doImport(ids, Import(first.map(), of_first.trial->getColMap()), Tpetra::INSERT);
  const auto own = ids.getLocalViewHost(Tpetra::Access::ReadOnly), id = column_ids.getLocalViewHost(Tpetra::Access::ReadOnly);
  const auto trial = of_first.trial->getLocalMatrixHost();
  std::vector<JoinedNode> result;
  std::vector<GlobalOrdinal> masters;
  for (LocalOrdinal row = 0; row < trial.numRows(); row += of_first.dimension) {
    if (own(row, 0) < 0.0) continue;
    masters.clear();
    for (LocalOrdinal i = row; i < row + of_first.dimension; ++i)
      for (LocalOrdinal k = 0; k < trial.rowConst(i).length; ++k)
        if (const double column = id(trial.rowConst(i).colidx(k), 0); column >= 0.0) masters.push_back(static_cast<GlobalOrdinal>(column));
    std::sort(masters.begin(), masters.end());
    const LocalOrdinal of_field = field.map()->getLocalElement(static_cast<GlobalOrdinal>(own(row, 0)));
    if (JoinedNode node = joined_node(A, of_field, masters); !node.masters.empty()) result.push_back(std::move(node));
  }
  return result;
}

}  // namespace

Decoupling scalar_decoupling(const Matrix& A, const FieldPart& field, const FieldPart& first, const Decoupling& of_first) {
  const std::vector<JoinedNode> joined = joined_nodes(A, field, first, of_first);
  const RCP<const Map> map = field.map();
  std::vector<std::size_t> sizes(local_id_count(*map), 0), ones(sizes);
  for (const JoinedNode& node : joined) {
    sizes[static_cast<std::size_t>(node.row)] = 1 + node.masters.size();
    ones[static_cast<std::size_t>(node.row)] = 1;
  }
  const auto trial = rcp(new Matrix(map, Teuchos::arrayViewFromVector(sizes))), eliminated = rcp(new Matrix(map, Teuchos::arrayViewFromVector(ones)));
  for (const JoinedNode& node : joined) {
    const GlobalOrdinal own = map->getGlobalElement(node.row);
    const double one = 1.0, minus = -1.0;
    trial->insertGlobalValues(own, 1, &minus, &own);
    trial->insertGlobalValues(own, static_cast<LocalOrdinal>(node.masters.size()), node.shares.data(), node.masters.data());
    eliminated->insertGlobalValues(own, 1, &one, &own);
  }
  trial->fillComplete(map, map);
  eliminated->fillComplete(map, map);
  return {trial, trial, eliminated, 1};
}

}  // namespace mortise::detail
