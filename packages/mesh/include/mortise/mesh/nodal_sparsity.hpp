#pragma once
// The static sparsity of the bulk's stiffness, and direct access to the values of matrices that have it.

#include <vector>

#include "mortise/core/types.hpp"
#include "mortise/mesh/field_rows.hpp"
#include "mortise/mesh/mesh.hpp"

namespace mortise {

/// Rows: owned dofs. Columns: local dofs (owned, then ghosts), for each pair of nodes that share an element all their dofs; a node of a rotation
/// vector pairs with itself. All rows of a node are alike, and the dofs of a field at a node stand side by side: one position for each pair of nodes
/// finds all entries of a field.
class NodalSparsity {
 public:
  /// @param fields  [fields] rows of each, in the order of their numbering; what they point to has to outlive the object
  NodalSparsity(const Mesh& mesh, std::vector<FieldRows> fields, const RCP<const Map>& dofs, const RCP<const Map>& local_dofs);

  /// Fill complete; domain and range are the owned dofs. Rebuilt by each call. Its size grows with the square of the components of a node, and it is
  /// needed only until it has become a matrix, or part of a wider graph. Collective.
  RCP<const Graph> graph() const;

  /// Where, in a row of the owned node `row`, the columns of a field at the local node `column` start. -1: `row` is a ghost, the two share no
  /// element, or the field does not live at `column`.
  LocalOrdinal position(LocalOrdinal row, LocalOrdinal column, std::size_t field = 0) const;

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
    Values(Matrix& matrix, const NodalSparsity& sparsity) : matrix_(matrix), sparsity_(sparsity) {}

    Matrix& matrix_;
    const NodalSparsity& sparsity_;
    std::vector<double*> rows_;  ///< [owned dofs]
    struct WiderRow {
      LocalOrdinal row = 0, node = 0;
    };
    std::vector<WiderRow> wider_;   ///< rows that are gathered
    std::vector<double> gathered_;  ///< their values, one after the other
  };

  /// Opens a matrix whose rows hold the entries of graph() or more, and whose columns are those of graph() or those followed by more.
  /// Throws std::logic_error for any other. No communication.
  Values open(Matrix& matrix) const;

 private:
  /// Calls function(row, node) for each owned row, ascending.
  template <class Function>
  void for_each_row(const Function& function) const;
  /// Number of nodes of part of neighbours_ where a field lives.
  std::size_t living(std::size_t field, std::size_t first, std::size_t last) const;
  /// Where the ghosts among the neighbours of an owned node begin in neighbours_.
  std::size_t first_ghost(std::size_t node) const;
  /// Entries of a row of the node in graph().
  std::size_t row_size(std::size_t node) const;
  /// Writes the columns of a row of the node in graph(), ascending; returns what follows them.
  LocalOrdinal* write_columns(std::size_t node, LocalOrdinal* columns) const;

  std::vector<FieldRows> fields_;
  LocalOrdinal owned_nodes_;
  RCP<const Map> dofs_, local_dofs_;
  std::vector<std::size_t> neighbour_starts_;  ///< [owned nodes + 1]
  std::vector<LocalOrdinal> neighbours_;       ///< ascending for each owned node, itself included
};

}  // namespace mortise
