#pragma once
// Sizes of the fields of a system: residuals and increments of different units are compared field by field.

#include <vector>

#include "mortise/core/types.hpp"
#include "mortise/nonlinear/semi_smooth_system.hpp"

namespace mortise::detail {

/// The field of a row, and the size that its values are compared with.
class FieldSizes {
 public:
  /// @throws std::invalid_argument for rows that belong to no field
  explicit FieldSizes(const SystemParts& parts);

  std::size_t fields() const { return sizes_.size(); }
  /// Of an owned row of the dofs.
  std::size_t field(LocalOrdinal row) const { return field_of_row_.empty() ? 0 : field_of_row_[static_cast<std::size_t>(row)]; }
  /// Local index of the node of an owned row, in a system of several fields.
  LocalOrdinal node(LocalOrdinal row) const { return node_of_row_[static_cast<std::size_t>(row)]; }
  double size(std::size_t field) const { return sizes_[field]; }

  /// |v| of each field. Collective.
  std::vector<double> norms(const Vector& v) const;
  /// The mean of |v| over the unknowns of each field. Collective.
  std::vector<double> means(const Vector& v) const;
  /// The largest |v_i|, of other fields as if their size were that of the first. Collective.
  double largest(const Vector& v) const;

 private:
  std::vector<double> sizes_;
  std::vector<std::size_t> field_of_row_;  ///< [owned dofs]; empty: there is one field
  std::vector<LocalOrdinal> node_of_row_;  ///< likewise
};

}  // namespace mortise::detail
