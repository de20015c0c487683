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

  /// Values of one matrix. Valid while the matrix lives.
  class Values {
   public:
    Values(double* values, const std::size_t* row_starts) : values_(values), row_starts_(row_starts) {}
    /// The row of an owned dof. The entries for a column node stand at its `position` and after it, one for each of its dofs.
    double* row(LocalOrdinal dof) const { return values_ + row_starts_[dof]; }

   private:
    double* values_;
    const std::size_t* row_starts_;
  };

  /// Opens a matrix made with graph() (or with a copy of it). Throws std::logic_error for any other. No communication.
  Values open(Matrix& matrix) const;

 private:
  int dimension_;
  RCP<const Graph> graph_;
  std::vector<std::size_t> row_starts_;        ///< of the matrix, [owned dofs + 1]
  std::vector<std::size_t> neighbour_starts_;  ///< [owned nodes + 1]
  std::vector<LocalOrdinal> neighbours_;       ///< ascending for each owned node, itself included
};

}  // namespace mortise
