#include "linearisation/assembled_rows.hpp"

#include <fmt/format.h>

#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_MultiVector.hpp>
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

bool holds_diagonal_alone(const Matrix& system, LocalOrdinal row) {
  Matrix::local_inds_host_view_type columns;
  Matrix::values_host_view_type values;
  system.getLocalRowView(row, columns, values);
  const LocalOrdinal own = system.getColMap()->getLocalElement(system.getRowMap()->getGlobalElement(row));
  bool has_diagonal = false;
  for (std::size_t k = 0; k < values.extent(0); ++k) {
    if (values(k) == 0.0) continue;
    if (columns(k) != own) return false;
    has_diagonal = true;
  }
  return has_diagonal && values.extent(0) > 1;
}

/// A replaced row of a node of the surfaces; "" if there is none on this rank.
std::string replaced_row(const ContactModel& model, const Matrix& system) {
  const auto fixed = model.fixed->getLocalViewHost(Tpetra::Access::ReadOnly);
  const auto first_of = [&](LocalOrdinal node) {
    for (std::size_t i = 0; i < fixed.extent(1); ++i) {
      const LocalOrdinal row = model.rows[fixed.extent(1) * node + i];
      if (fixed(node, i) == 1.0 && row >= 0 && holds_diagonal_alone(system, row))
        return fmt::format(
            "contact: the row of component {} at node {}, which is prescribed, holds its diagonal alone: rows of prescribed dofs are "
            "replaced after condense(), not before",
            i, model.owned_nodes->getGlobalElement(node));
    }
    return std::string();
  };
  for (std::size_t p = 0; p < model.pairs.size(); ++p) {
    for (const SlaveNode& slave : model.pairs[p]->slave_nodes())
      if (std::string found = first_of(slave.owned_node); !found.empty()) return found;
    for (const LocalOrdinal node : model.master_nodes[p])
      if (std::string found = first_of(node); !found.empty()) return found;
  }
  return "";
}

}  // namespace

void refuse_changed_rows(const ContactModel& model, const Matrix& system) {
  const CondensedRow& last = model.condensed_row;
  std::string wrong;
  if (last.system == &system && last.row >= 0 && values_of(system, last.row) == last.values)
    wrong = "contact: condense() of a matrix that was condensed already: assemble it anew, from setAllToScalar(0) on";
  else
    wrong = replaced_row(model, system);
  if (most_over_ranks(model.comm(), wrong.empty() ? 0 : 1) == 0) return;
  throw std::logic_error(wrong.empty() ? "contact: condense() of a matrix whose rows were changed after their assembly, on another rank" : wrong);
}

void keep_condensed_row(const ContactModel& model, const Matrix& system, LocalOrdinal row) {
  model.condensed_row = {&system, row, row < 0 ? std::vector<double>() : values_of(system, row)};
}

}  // namespace mortise::detail
