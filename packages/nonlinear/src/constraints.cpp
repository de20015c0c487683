#include "constraints.hpp"

namespace mortise::detail {

Constraints::Match Constraints::match(const RCP<const Graph>& graph, const std::vector<LocalOrdinal>& rows) {
  const bool is_new = !elimination_ || !same_entries(*graph, *graph_);
  if (is_new) elimination_ = std::make_unique<const DirichletElimination>(*graph, rows);
  graph_ = graph;
  return {*elimination_, is_new};
}

}  // namespace mortise::detail
