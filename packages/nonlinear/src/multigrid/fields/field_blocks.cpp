#include "multigrid/fields/field_blocks.hpp"

#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Import.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_MultiVector.hpp>
#include <Tpetra_Vector.hpp>
#include <utility>

#include "mortise/core/trilinos_versions.hpp"

namespace mortise::detail {
namespace {

RCP<const Map> numbered_anew(std::size_t count, const Map& like) {
  const auto invalid = Teuchos::OrdinalTraits<Tpetra::global_size_t>::invalid();
  return rcp(new const Map(invalid, count, 0, like.getComm()));
}

/// Ids in a part, of the columns of A. Whole numbers below 2^53 are doubles.
Vector ids_of_columns(const Matrix& A, const FieldPart& part) {
  Vector result(A.getColMap());
  result.doImport(part.ids(), Import(part.ids().getMap(), A.getColMap()), Tpetra::INSERT);
  return result;
}

}  // namespace

FieldPart::FieldPart(const RCP<const Map>& all, std::vector<LocalOrdinal> rows, std::vector<LocalOrdinal> nodes)
    : rows_(std::move(rows)), nodes_(std::move(nodes)), map_(numbered_anew(rows_.size(), *all)), ids_(all) {
  ids_.putScalar(-1.0);
  const auto id = ids_.getLocalViewHost(Tpetra::Access::ReadWrite);
  for (std::size_t place = 0; place < rows_.size(); ++place)
    id(rows_[place], 0) = static_cast<double>(map_->getGlobalElement(static_cast<LocalOrdinal>(place)));
}

RCP<MultiVector> FieldPart::of(const MultiVector& all) const {
  const auto part = rcp(new MultiVector(map_, all.getNumVectors()));
  const auto from = all.getLocalViewHost(Tpetra::Access::ReadOnly);
  const auto to = part->getLocalViewHost(Tpetra::Access::OverwriteAll);
  for (std::size_t v = 0; v < all.getNumVectors(); ++v)
    for (std::size_t place = 0; place < rows_.size(); ++place) to(place, v) = from(rows_[place], v);
  return part;
}

void FieldPart::put(const MultiVector& part, MultiVector& all) const {
  const auto from = part.getLocalViewHost(Tpetra::Access::ReadOnly);
  const auto to = all.getLocalViewHost(Tpetra::Access::ReadWrite);
  for (std::size_t v = 0; v < all.getNumVectors(); ++v)
    for (std::size_t place = 0; place < rows_.size(); ++place) to(rows_[place], v) = from(place, v);
}

RCP<const Matrix> field_block(const Matrix& A, const FieldPart& rows, const FieldPart& columns) {
  const Vector column_ids = ids_of_columns(A, columns);
  const auto id = column_ids.getLocalViewHost(Tpetra::Access::ReadOnly);
  const auto local = A.getLocalMatrixHost();
  const auto visit = [&](std::size_t place, const auto& use) {
    const auto entries = local.rowConst(rows.rows()[place]);
    for (LocalOrdinal k = 0; k < entries.length; ++k)
      if (entries.value(k) != 0.0 && id(entries.colidx(k), 0) >= 0.0) use(entries.colidx(k), entries.value(k));
  };
  const std::size_t count = rows.rows().size();
  std::vector<char> is_met(id.extent(0), 0);
  Matrix::local_graph_device_type::row_map_type::non_const_type starts("starts", count + 1);
  for (std::size_t place = 0; place < count; ++place) {
    std::size_t size = 0;
    visit(place, [&](LocalOrdinal column, double) { ++size, is_met[static_cast<std::size_t>(column)] = 1; });
    starts(place + 1) = starts(place) + size;
  }
  // Owned columns first, all of them; those of other ranks in the order of A's, which stand rank by rank.
  std::vector<GlobalOrdinal> ids;
  for (const GlobalOrdinal own : local_ids(*columns.map())) ids.push_back(own);
  std::vector<LocalOrdinal> column_of(is_met.size(), -1);
  for (std::size_t column = 0; column < is_met.size(); ++column) {
    if (id(column, 0) < 0.0) continue;
    const auto of_part = static_cast<GlobalOrdinal>(id(column, 0));
    column_of[column] = columns.map()->getLocalElement(of_part);
    if (column_of[column] >= 0 || !is_met[column]) continue;
    column_of[column] = static_cast<LocalOrdinal>(ids.size());
    ids.push_back(of_part);
  }
  const auto invalid = Teuchos::OrdinalTraits<Tpetra::global_size_t>::invalid();
  const auto column_map = rcp(new const Map(invalid, ids.data(), static_cast<LocalOrdinal>(ids.size()), 0, A.getComm()));

  Matrix::local_graph_device_type::entries_type::non_const_type entries("entries", starts(count));
  Matrix::local_matrix_device_type::values_type values("values", starts(count));
  std::size_t next = 0;
  for (std::size_t place = 0; place < count; ++place)
    visit(place, [&](LocalOrdinal column, double value) {
      entries(next) = column_of[static_cast<std::size_t>(column)];
      values(next++) = value;
    });
  const auto result = rcp(new Matrix(rows.map(), column_map, starts, entries, values));
  result->expertStaticFillComplete(columns.map(), rows.map());
  return result;
}

std::vector<FieldPart> field_parts(const RCP<const Map>& all, const FieldsOfRows& fields) {
  std::vector<std::vector<LocalOrdinal>> rows(fields.weights.size()), nodes(rows.size());
  for (std::size_t row = 0; row < fields.field_of_row.size(); ++row) {
    rows.at(fields.field_of_row[row]).push_back(static_cast<LocalOrdinal>(row));
    nodes.at(fields.field_of_row[row]).push_back(fields.node_of_row[row]);
  }
  std::vector<FieldPart> parts;
  for (std::size_t field = 0; field < rows.size(); ++field) parts.emplace_back(all, std::move(rows[field]), std::move(nodes[field]));
  return parts;
}

NearNullSpace part_of(const NearNullSpace& of_all, const FieldPart& first) {
  NearNullSpace result;
  result.separation = of_all.separation;
  if (!of_all.rigid_body_modes.is_null()) result.rigid_body_modes = first.of(*of_all.rigid_body_modes);
  if (of_all.coordinates.is_null()) return result;
  const RCP<const Map> nodes = numbered_anew(of_all.coordinates->getLocalLength(), *first.map());
  const auto coordinates = rcp(new MultiVector(*of_all.coordinates, Teuchos::Copy));
  coordinates->replaceMap(nodes);
  result.coordinates = coordinates;
  return result;
}

Decoupling part_of(const Decoupling& of_all, const FieldPart& first) {
  const auto part = [&](const RCP<const Matrix>& of_dofs) { return field_block(*of_dofs, first, first); };
  return {part(of_all.trial), part(of_all.test), part(of_all.eliminated), of_all.dimension};
}

}  // namespace mortise::detail
