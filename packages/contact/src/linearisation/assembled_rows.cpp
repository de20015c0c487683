#include "linearisation/assembled_rows.hpp"

#include <Tpetra_CrsMatrix.hpp>
#include <stdexcept>

#include "mortise/core/over_ranks.hpp"

namespace mortise::detail {
namespace {

std::vector<double> values_of(const Matrix& system, LocalOrdinal row) {
  Matrix::local_inds_host_view_type columns;
  Matrix::values_host_view_type values;
  system.getLocalRowView(row, columns, values);
  return {values.data(), values.data() + values.extent(0)};
}

}  // namespace

void refuse_condensed(const ContactModel& model, const Matrix& system) {
  const CondensedRow& last = model.condensed_row;
  const bool is_condensed = last.system == &system && last.row >= 0 && values_of(system, last.row) == last.values;
  if (most_over_ranks(model.comm(), is_condensed ? 1 : 0) > 0)
    throw std::logic_error("contact: condense() of a matrix that was condensed already: assemble it anew, from setAllToScalar(0) on");
}

void keep_condensed_row(const ContactModel& model, const Matrix& system, LocalOrdinal row) {
  model.condensed_row = {&system, row, row < 0 ? std::vector<double>() : values_of(system, row)};
}

}  // namespace mortise::detail
