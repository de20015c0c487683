#include "mortise/nonlinear/affine_constraints.hpp"

#include <fmt/format.h>

#include <Teuchos_CommHelpers.hpp>
#include <TpetraExt_MatrixMatrix.hpp>
#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Import.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <stdexcept>

#include "mortise/core/trilinos_versions.hpp"

namespace mortise {
namespace {

constexpr int most_rounds = 64;  ///< a chain of lines that is longer is a circle

/// The largest over all ranks.
GlobalOrdinal largest(const Communicator& comm, GlobalOrdinal mine) {
  GlobalOrdinal all = mine;
  Teuchos::reduceAll(comm, Teuchos::REDUCE_MAX, mine, Teuchos::outArg(all));
  return all;
}

/// Rows of lines with terms, and those of the identity.
RCP<const Matrix> matrix_of(const RCP<const Map>& dofs, const std::vector<AffineConstraints::Line>& lines) {
  std::size_t most = 1;
  for (const auto& line : lines) most = std::max(most, line.terms.size());
  const auto result = rcp(new Matrix(dofs, most));
  auto line = lines.begin();
  for (LocalOrdinal row = 0; row < static_cast<LocalOrdinal>(local_id_count(*dofs)); ++row) {
    const GlobalOrdinal id = dofs->getGlobalElement(row);
    if (line == lines.end() || line->row != row) {
      const double one = 1.0;
      result->insertGlobalValues(id, 1, &one, &id);
      continue;
    }
    for (const auto& [unknown, coefficient] : line->terms) result->insertGlobalValues(id, 1, &coefficient, &unknown);
    ++line;
  }
  result->fillComplete(dofs, dofs);
  return result;
}

/// The id of a column of any rank that is marked and has an entry; -1: none is. Products have columns without entries. Collective.
GlobalOrdinal marked_column(const Matrix& T, const Vector& marks) {
  const RCP<const Map> columns = T.getColMap();
  Vector of_columns(columns);
  of_columns.doImport(marks, Import(marks.getMap(), columns), Tpetra::INSERT);
  const auto view = of_columns.getLocalViewHost(Tpetra::Access::ReadOnly);
  const auto entries = T.getLocalMatrixHost().graph.entries;
  GlobalOrdinal found = -1;
  for (std::size_t k = 0; k < entries.extent(0); ++k)
    if (view(entries(k), 0) != 0.0) found = std::max(found, columns->getGlobalElement(entries(k)));
  return largest(*columns->getComm(), found);
}

}  // namespace

AffineConstraints::AffineConstraints(RCP<const Map> dofs, std::vector<Line> lines, Values values)
    : dofs_(std::move(dofs)), values_(std::move(values)) {
  const Communicator& comm = *dofs_->getComm();
  std::sort(lines.begin(), lines.end(), [](const Line& a, const Line& b) { return a.row < b.row; });
  GlobalOrdinal repeated = -1;
  for (std::size_t n = 1; n < lines.size(); ++n)
    if (lines[n].row == lines[n - 1].row) repeated = dofs_->getGlobalElement(lines[n].row);
  if (repeated = largest(comm, repeated); repeated >= 0) throw std::invalid_argument(fmt::format("two constraints of the unknown {}", repeated));

  const auto with_terms = std::stable_partition(lines.begin(), lines.end(), [](const Line& line) { return line.terms.empty(); });
  for (auto line = lines.begin(); line != with_terms; ++line) {
    prescribed_.push_back(line->row);
    shares_of_prescribed_.push_back(std::move(line->shares));
  }
  lines.erase(lines.begin(), with_terms);
  bool has_offset = false;
  for (const Line& line : lines) {
    dependent_.push_back(line.row);
    shares_of_dependent_.push_back(line.shares);
    has_offset |= !line.shares.empty();
  }
  has_offset_ = largest(comm, has_offset ? 1 : 0) != 0;
  if (largest(comm, dependent_.empty() ? 0 : 1) == 0) return;

  Vector marks(dofs_);
  for (const LocalOrdinal row : dependent_) marks.replaceLocalValue(row, 1.0);
  T_ = lines_ = matrix_of(dofs_, lines);
  for (GlobalOrdinal id = marked_column(*T_, marks); id >= 0; id = marked_column(*T_, marks)) {
    if (++rounds_ > most_rounds) throw std::invalid_argument(fmt::format("constraints depend on one another in a circle, at the unknown {}", id));
    const auto next = rcp(new Matrix(dofs_, 0));
    Tpetra::MatrixMatrix::Multiply(*T_, false, *lines_, false, *next);
    T_ = next;
  }
}

std::vector<double> AffineConstraints::prescribed_values(double time, std::optional<StepFailure>& failure) const {
  std::vector<double> result(prescribed_.size(), 0.0);
  if (result.empty()) return result;
  const std::vector<double> values = values_ ? values_(time, failure) : std::vector<double>();
  for (std::size_t n = 0; n < result.size(); ++n)
    for (const auto& [value, factor] : shares_of_prescribed_[n]) result[n] += factor * values[value];
  return result;
}

// x = L x + b_0 put into itself: b = b_0 + L b_0 + ..., L of the lines as they were given.
RCP<Vector> AffineConstraints::offset(double time, std::optional<StepFailure>& failure) const {
  if (!has_offset_) return Teuchos::null;
  Vector last(dofs_);
  if (!dependent_.empty()) {
    const std::vector<double> values = values_(time, failure);
    const auto view = last.getLocalViewHost(Tpetra::Access::ReadWrite);
    for (std::size_t n = 0; n < dependent_.size(); ++n)
      for (const auto& [value, factor] : shares_of_dependent_[n]) view(dependent_[n], 0) += factor * values[value];
  }
  const auto sum = rcp(new Vector(last, Teuchos::Copy));
  for (int round = 1; round < rounds_; ++round) {
    const Vector before(last, Teuchos::Copy);
    lines_->apply(before, last);
    sum->update(1.0, last, 1.0);
  }
  return sum;
}

}  // namespace mortise
