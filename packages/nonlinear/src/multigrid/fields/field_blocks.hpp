#pragma once
// The blocks of a matrix of several fields.

#include <memory>
#include <vector>

#include "mortise/core/types.hpp"
#include "mortise/nonlinear/linear_solver.hpp"

namespace mortise::detail {

/// The rows of one field. They are numbered anew, without gaps, as multigrid wants whole nodes.
class FieldPart {
 public:
  /// Collective.
  /// @param all    rows of all fields
  /// @param rows   owned rows of the field, ascending
  /// @param nodes  [rows] their owned nodes
  FieldPart(const RCP<const Map>& all, std::vector<LocalOrdinal> rows, std::vector<LocalOrdinal> nodes);

  const RCP<const Map>& map() const { return map_; }
  /// The rows of the field in a vector of all.
  RCP<MultiVector> of(const MultiVector& all) const;
  /// Puts the rows of the field into a vector of all.
  void put(const MultiVector& part, MultiVector& all) const;
  /// Owned rows of the field, in the numbering of all.
  const std::vector<LocalOrdinal>& rows() const { return rows_; }
  /// Their nodes.
  const std::vector<LocalOrdinal>& nodes() const { return nodes_; }
  /// [rows of all] their ids in map(), -1: of another field.
  const Vector& ids() const { return ids_; }

 private:
  std::vector<LocalOrdinal> rows_, nodes_;
  RCP<const Map> map_;
  Vector ids_;
};

/// The entries of A in the rows of one field and the columns of another, without those that are 0. Rows and domain of A are those of the parts.
/// Collective.
RCP<const Matrix> field_block(const Matrix& A, const FieldPart& rows, const FieldPart& columns);

/// The parts of the fields. Collective.
std::vector<FieldPart> field_parts(const RCP<const Map>& all, const FieldsOfRows& fields);

/// What multigrid asks of the first field, from what it asks of all. Collective.
NearNullSpace part_of(const NearNullSpace& of_all, const FieldPart& first);
Decoupling part_of(const Decoupling& of_all, const FieldPart& first);

}  // namespace mortise::detail
