#include "host_system.hpp"

#include <fmt/format.h>

#include <Tpetra_CrsGraph.hpp>
#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Map.hpp>
#include <algorithm>

#include "mortise/core/over_ranks.hpp"

namespace mortise {

void HostSystem::take_pattern(const PlainMatrix& K) {
  const bool same = std::equal(K.starts.begin(), K.starts.end(), starts_.begin(), starts_.end()) &&
                    std::equal(K.columns.begin(), K.columns.end(), columns_.begin(), columns_.end());
  const Communicator& comm = *rows_->getComm();
  if (most_over_ranks(comm, same ? 0 : 1) == 0) return;
  std::vector<GlobalOrdinal> elsewhere;
  for (const std::int64_t column : K.columns)
    if (!rows_->isNodeGlobalElement(column)) elsewhere.push_back(column);
  std::sort(elsewhere.begin(), elsewhere.end());
  elsewhere.erase(std::unique(elsewhere.begin(), elsewhere.end()), elsewhere.end());
  std::vector<int> ranks(elsewhere.size(), -1);
  rows_->getRemoteIndexList(Teuchos::arrayViewFromVector(elsewhere), Teuchos::arrayViewFromVector(ranks));
  const auto unknown = std::find(ranks.begin(), ranks.end(), -1);
  std::optional<Problem> problem;
  if (unknown != ranks.end())
    problem = Problem{MORTISE_REFUSED,
                      fmt::format("\"columns\" holds {}, which is no row of any rank", elsewhere[static_cast<std::size_t>(unknown - ranks.begin())])};
  Agreement(comm).check("mortise_condense", problem);
  starts_.assign(K.starts.begin(), K.starts.end());
  columns_.assign(K.columns.begin(), K.columns.end());
  ++version_;
  matrix_ = Teuchos::null;
}

RCP<const Graph> HostSystem::graph() const {
  std::vector<std::size_t> sizes;
  for (std::size_t row = 0; row + 1 < starts_.size(); ++row) sizes.push_back(static_cast<std::size_t>(starts_[row + 1] - starts_[row]));
  const auto graph = rcp(new Graph(rows_, Teuchos::arrayViewFromVector(sizes)));
  const std::vector<GlobalOrdinal> columns(columns_.begin(), columns_.end());
  for (std::size_t row = 0; row < sizes.size(); ++row)
    graph->insertGlobalIndices(rows_->getGlobalElement(static_cast<LocalOrdinal>(row)), static_cast<LocalOrdinal>(sizes[row]),
                               columns.data() + starts_[row]);
  graph->fillComplete(rows_, rows_);
  return graph;
}

const RCP<Matrix>& HostSystem::fill(const PlainMatrix& K, const ContactSystem& contact, const ContactEvaluation& at) {
  take_pattern(K);
  const RCP<const Graph> graph = contact.graph(
      at, [this] { return this->graph(); }, version_);
  if (matrix_.is_null() || matrix_->getCrsGraph() != graph) {
    matrix_ = rcp(new Matrix(graph));
    local_columns_.clear();
    for (const std::int64_t column : columns_) local_columns_.push_back(graph->getColMap()->getLocalElement(column));
  }
  matrix_->setAllToScalar(0.0);
  for (std::size_t row = 0; row + 1 < starts_.size(); ++row)
    matrix_->sumIntoLocalValues(static_cast<LocalOrdinal>(row), static_cast<LocalOrdinal>(starts_[row + 1] - starts_[row]),
                                K.values.data() + starts_[row], local_columns_.data() + starts_[row]);
  return matrix_;
}

RCP<Matrix> HostSystem::zeros(const ContactSystem& contact, const ContactEvaluation& at) const {
  const auto none = [&] {
    const auto graph = rcp(new Graph(rows_, 0));
    graph->fillComplete(rows_, rows_);
    return RCP<const Graph>(graph);
  };
  const auto matrix = rcp(new Matrix(contact.graph(at, none, 0)));
  matrix->setAllToScalar(0.0);
  return matrix;
}

}  // namespace mortise
