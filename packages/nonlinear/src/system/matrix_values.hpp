#pragma once
// Work on the values of filled matrices by precomputed offsets.

#include <cstddef>
#include <vector>

#include "mortise/core/types.hpp"

namespace mortise::detail {

/// True if two graphs have the same entries in the same order, on every rank. Collective.
bool same_entries(const Graph& a, const Graph& b);

/// Prescribed increments in a linear system, by rows and by columns, so that what was symmetric stays so.
class DirichletElimination {
 public:
  /// Collective. `rows`: owned rows that are prescribed.
  DirichletElimination(const Graph& graph, const std::vector<LocalOrdinal>& rows);

  /// rhs_i -= A_ij increment_j and A_ij = 0 for free i and prescribed j; rows of prescribed i become diagonal * identity, their rhs 0.
  /// So the solution vanishes on prescribed rows, and that on free ones belongs to `increment`. The matrix is open for changes. Collective.
  void impose(Matrix& matrix, const Vector& increment, double diagonal, Vector& rhs) const;

 private:
  struct Entry {
    std::size_t offset;
    LocalOrdinal row, column;
  };
  std::vector<LocalOrdinal> rows_;
  std::vector<std::size_t> row_begin_, row_end_, diagonal_;  ///< [rows_] offsets
  std::vector<Entry> entries_;                               ///< free row, prescribed column
};

}  // namespace mortise::detail
