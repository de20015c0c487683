#include "evaluation/crosspoints.hpp"

#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_MultiVector.hpp>
#include <algorithm>

#include "mortise/contact/enforcement.hpp"
#include "mortise/mortar/surface_nodes.hpp"

namespace mortise::detail {

std::vector<RCP<const MultiVector>> with_crosspoints(const RCP<const Map>& owned_nodes, const RCP<const MultiVector>& fixed,
                                                     const std::vector<ContactPair>& pairs) {
  std::vector<std::vector<char>> slave, master;
  for (const ContactPair& pair : pairs) {
    slave.push_back(nodes_on_surface(owned_nodes, pair.slave));
    master.push_back(nodes_on_surface(owned_nodes, pair.master));
  }
  const auto enforcement = [&](std::size_t p) { return pairs[p].options.formulation.options->enforcement(); };
  const bool keeps = std::any_of(pairs.begin(), pairs.end(),
                                 [](const ContactPair& pair) { return pair.options.formulation.options->enforcement()->keeps_multipliers(); });
  std::vector<RCP<const MultiVector>> marks;
  for (std::size_t p = 0; p < pairs.size(); ++p) {
    std::vector<LocalOrdinal> crosspoints;
    const auto meets = [&](std::size_t node) {
      for (std::size_t q = 0; q < pairs.size(); ++q) {
        if (q == p) continue;
        if (slave[q][node]) return true;
        if (master[q][node] && !keeps && (enforcement(p)->needs_diagonal_coupling() || enforcement(q)->needs_diagonal_coupling())) return true;
      }
      return false;
    };
    for (std::size_t node = 0; node < slave[p].size(); ++node)
      if (slave[p][node] && meets(node)) crosspoints.push_back(static_cast<LocalOrdinal>(node));
    int mine = crosspoints.empty() ? 0 : 1, any = 0;
    Teuchos::reduceAll(*owned_nodes->getComm(), Teuchos::REDUCE_MAX, mine, Teuchos::outArg(any));
    if (any == 0) {
      marks.push_back(fixed);
      continue;
    }
    const auto marked = rcp(new MultiVector(*fixed, Teuchos::Copy));
    const auto view = marked->getLocalViewHost(Tpetra::Access::ReadWrite);
    for (const LocalOrdinal node : crosspoints)
      for (std::size_t i = 0; i < view.extent(1); ++i) view(node, i) = crosspoint_mark;
    marks.push_back(marked);
  }
  return marks;
}

RCP<const MultiVector> without_crosspoints(const RCP<const MultiVector>& fixed) {
  const auto marks = rcp(new MultiVector(*fixed, Teuchos::Copy));
  const auto view = marks->getLocalViewHost(Tpetra::Access::ReadWrite);
  for (std::size_t node = 0; node < view.extent(0); ++node)
    for (std::size_t i = 0; i < view.extent(1); ++i)
      if (view(node, i) == crosspoint_mark) view(node, i) = 0.0;
  return marks;
}

}  // namespace mortise::detail
