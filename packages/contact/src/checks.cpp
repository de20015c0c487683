#include "checks.hpp"

#include <fmt/format.h>

#include <Teuchos_RCPDecl.hpp>
#include <Tpetra_Map.hpp>

#include "mortise/mortar/surface_nodes.hpp"

namespace mortise::detail {
void refuse_shared_nodes(const Map& owned_nodes, const std::vector<ContactPair>& pairs) {
  const auto nodes = Teuchos::rcpFromRef(owned_nodes);
  std::vector<std::vector<char>> slave, master;
  for (const ContactPair& pair : pairs) {
    slave.push_back(nodes_on_surface(nodes, pair.slave));
    master.push_back(nodes_on_surface(nodes, pair.master));
  }
  const auto eliminated = [&](std::size_t p) { return pairs[p].options.formulation.options->elimination() == Elimination::momentum; };
  bool kept = false;
  for (const ContactPair& pair : pairs) kept |= pair.options.formulation.options->elimination() == Elimination::none;
  std::vector<Diagnostic> diagnostics;
  const auto first_common = [&](const std::vector<char>& one, const std::vector<char>& other) -> std::optional<GlobalOrdinal> {
    for (std::size_t node = 0; node < one.size(); ++node)
      if (one[node] && other[node]) return owned_nodes.getGlobalElement(static_cast<LocalOrdinal>(node));
    return std::nullopt;
  };
  for (std::size_t p = 0; p < pairs.size(); ++p)
    for (std::size_t q = 0; q < pairs.size(); ++q) {
      if (p == q) continue;
      if (p < q)
        if (const auto node = first_common(slave[p], slave[q]))
          diagnostics.push_back(
              {pairs[q].place, fmt::format("node {} is a slave here and in pair \"{}\"; a node can be slave in one pair only: make this side "
                                           "the master of one of them, or split the surface into sets without common nodes",
                                           *node, pairs[p].name)});
      if (kept || (!eliminated(p) && !eliminated(q))) continue;
      if (const auto node = first_common(slave[p], master[q]))
        diagnostics.push_back(
            {pairs[p].place, fmt::format("node {} is a slave here and a master in pair \"{}\"; its multiplier could not be eliminated: split the "
                                         "surface into sets without common nodes, or exchange slave and master",
                                         *node, pairs[q].name)});
    }
  throw_if_any(*owned_nodes.getComm(), diagnostics);
}

}  // namespace mortise::detail
