#pragma once
// Rows and columns of the system for the nodes of the interfaces, and sums into rows of other ranks.

#include <vector>

#include "mortise/core/types.hpp"
#include "pairs/pair_evaluation.hpp"

namespace mortise::detail {

struct EvaluatedContact;

/// Positions of the displacements of one pair's local nodes, [dim nodes]. -1 where a component is no unknown.
struct NodePositions {
  std::vector<LocalOrdinal> row;         ///< local row of the system, -1 if another rank owns the node
  std::vector<LocalOrdinal> remote_row;  ///< local row of the remote matrix, -1 if owned here
  std::vector<LocalOrdinal> column;      ///< local column of the system
};

/// The condensed system's graph, and the rows this rank adds to on behalf of other ranks.
class SystemScatter {
 public:
  /// Builds the graph of the condensed system from the bulk's rows. The rows of each slave node s get the columns of its own bulk rows, the same in
  /// all of them, and of the nodes it is coupled to. The same columns are in the rows of the nodes its multiplier loads, as they receive the slave's
  /// row by condensation. So are they in the rows that further fields have at these nodes, and all of them get the columns of these fields at the
  /// nodes that s is coupled to. Its columns are the bulk's, followed by further ones.
  SystemScatter(const Graph& bulk, const EvaluatedContact& contact);

  /// True if the candidates of these evaluations are those it was built for.
  bool fits(const std::vector<PairEvaluation>& pairs) const;

  const RCP<const Graph>& graph() const { return graph_; }
  const NodePositions& positions(std::size_t pair) const { return positions_[pair]; }

  /// row `component` of node `node` of a pair: += values at local columns of the system. Nothing where the component has no dof; columns of -1 are
  /// left out.
  void add(Matrix& system, const NodePositions& positions, LocalOrdinal node, int component, const std::vector<LocalOrdinal>& columns,
           const std::vector<double>& values);
  /// Adds to a right-hand side (or any vector on the dofs).
  void add(Vector& vector, const NodePositions& positions, LocalOrdinal node, int component, double value);

  /// Collective: sends what was added to rows of other ranks.
  void finish(Matrix& system);
  void finish(Vector& vector);

 private:
  RCP<const Graph> graph_;
  std::vector<std::shared_ptr<const InterfacePattern>> patterns_;  ///< [pairs]
  std::vector<NodePositions> positions_;
  RCP<Matrix> remote_matrix_;
  RCP<Vector> remote_vector_;
  RCP<const Export> export_;
  std::vector<LocalOrdinal> remote_column_of_;  ///< [columns of the system] in the remote matrix, -1: not there
  std::vector<LocalOrdinal> column_buffer_;
  std::vector<double> value_buffer_;
  int dimension_;
  bool parallel_ = false;
};

}  // namespace mortise::detail
