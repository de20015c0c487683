#pragma once
// Prescribed increments in linear systems of one pattern after the other.

#include <memory>
#include <vector>

#include "mortise/core/types.hpp"
#include "system/matrix_values.hpp"

namespace mortise::detail {

/// Keeps the elimination of prescribed rows as long as the matrices have the same entries and the rows are the same.
class Constraints {
 public:
  struct Match {
    const DirichletElimination& elimination;
    bool is_new;  ///< the entries are not those of the graph before
  };
  /// The elimination of these rows from matrices on a graph. Collective.
  Match match(const RCP<const Graph>& graph, const std::vector<LocalOrdinal>& rows);

 private:
  RCP<const Graph> graph_;
  std::vector<LocalOrdinal> rows_;
  std::unique_ptr<const DirichletElimination> elimination_;
};

}  // namespace mortise::detail
