#include "system/constraints.hpp"

#include <Teuchos_CommHelpers.hpp>

namespace mortise::detail {

Constraints::Match Constraints::match(const RCP<const Graph>& graph, const std::vector<LocalOrdinal>& rows) {
  const bool is_new = !elimination_ || !same_entries(*graph, *graph_);
  int others = is_new || rows != rows_, anywhere = others;
  Teuchos::reduceAll(*graph->getComm(), Teuchos::REDUCE_MAX, others, Teuchos::outArg(anywhere));
  if (anywhere != 0) elimination_ = std::make_unique<const DirichletElimination>(*graph, rows);
  graph_ = graph;
  rows_ = rows;
  return {*elimination_, is_new};
}

}  // namespace mortise::detail
