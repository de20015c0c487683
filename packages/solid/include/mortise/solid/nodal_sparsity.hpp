#pragma once
// The static sparsity of the bulk's stiffness, and direct access to the values of matrices that have it.

#include <vector>

#include "mortise/core/types.hpp"
#include "mortise/mesh/mesh.hpp"

namespace mortise {

/// Rows: owned dofs. Columns: local dofs (owned, then ghosts), for each pair of nodes that share an element all their dofs. The rows of a node are
/// alike, and the dofs of a neighbour stand side by side, so one position for each pair of nodes finds all entries of the two.
class NodalSparsity {
 public:
  /// As many dofs a node as the mesh has dimensions.
  NodalSparsity(const Mesh& mesh, const RCP<const Map>& dofs, const RCP<const Map>& local_dofs);

  /// Fill complete; domain and range are the owned dofs.
  const RCP<const Graph>& graph() const { return graph_; }

  /// Where, in a row of the owned node `row`, the columns of the local node `column` start. -1: `row` is a ghost, or the two share no element.
  LocalOrdinal position(LocalOrdinal row, LocalOrdinal column) const;

  /// Values of one matrix that is being summed into. Rows that have the entries of graph() are written in place; those of the few nodes that others,
  /// in contact, made wider are gathered beside the matrix until close(). Valid while the matrix lives.
  class Values {
   public:
    Values(const Values&) = delete;
    Values(Values&&) = default;
    /// The row of an owned dof. The entries for a column node stand at its `position` and after it, one for each of its dofs.
    double* row(LocalOrdinal dof) const { return rows_[dof]; }
    /// Adds what was gathered; nothing is written afterwards.
    void close() const;

   private:
    friend class NodalSparsity;
    Values(Matrix& matrix, const Graph& narrow) : matrix_(matrix), narrow_(narrow) {}

    Matrix& matrix_;
    const Graph& narrow_;
    std::vector<double*> rows_;        ///< [owned dofs]
    std::vector<LocalOrdinal> wider_;  ///< rows that are gathered
    std::vector<double> gathered_;     ///< their values, one after the other
  };

  /// Opens a matrix whose rows hold the entries of graph() or more, and whose columns are those of graph() or those followed by more.
  /// Throws std::logic_error for any other. No communication.
  Values open(Matrix& matrix) const;

 private:
  int dimension_;
  RCP<const Graph> graph_;
  std::vector<std::size_t> row_starts_;        ///< of the matrix, [owned dofs + 1]
  std::vector<std::size_t> neighbour_starts_;  ///< [owned nodes + 1]
  std::vector<LocalOrdinal> neighbours_;       ///< ascending for each owned node, itself included
};

}  // namespace mortise
