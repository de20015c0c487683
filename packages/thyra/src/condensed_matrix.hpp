#pragma once
// The matrix of a condensed system, made of the application's and of contact.

#include <optional>

#include "step_memory.hpp"

namespace mortise::detail {

/// Matrix on the graph of the bodies and of contact. It is another object where that graph is another one.
class CondensedMatrix {
 public:
  /// Opens the matrix on the graph of contact at an iterate, with zeros.
  /// @param bulk  on whose graph the bodies' entries are
  /// @return true if it is another matrix than before
  bool open(const ContactSystem& contact, const ContactEvaluation& at, const Matrix& bulk);
  /// Adds weight times the bodies' entries.
  void add(const Matrix& bulk, double weight);
  /// Rows of prescribed dofs: those of the bodies times `weight`, or `diagonal` on the diagonal where that is not 0.
  void replace_rows(const std::vector<LocalOrdinal>& rows, const Matrix& bulk, double weight, double diagonal);
  const RCP<Matrix>& matrix() const { return matrix_; }  ///< null before open()

 private:
  RCP<Matrix> matrix_;
  RCP<const Graph> bulk_graph_;
  std::vector<LocalOrdinal> columns_;  ///< of the columns of the bodies' graph
  long version_ = 0;                   ///< of the bodies' graph
};

}  // namespace mortise::detail
