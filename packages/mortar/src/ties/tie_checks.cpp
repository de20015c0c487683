#include "ties/tie_checks.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Tpetra_Import.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_MultiVector.hpp>
#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <set>

#include "exchange/exchange.hpp"
#include "mortise/core/trilinos_versions.hpp"
#include "mortise/mortar/surface_nodes.hpp"

namespace mortise {
namespace {

std::string written_place(GlobalOrdinal id, const MultiVector& reference, LocalOrdinal node) {
  const auto x = reference.getLocalViewHost(Tpetra::Access::ReadOnly);
  std::vector<std::string> numbers;
  for (std::size_t i = 0; i < x.extent(1); ++i) numbers.push_back(fmt::format("{:.6g}", x(node, i)));
  return fmt::format("{} at ({})", id, fmt::join(numbers, ", "));
}

}  // namespace

NodeMarks::NodeMarks(const RCP<const Map>& owned_nodes, const SurfaceFacets& facets, const std::vector<char>& marks) {
  std::set<GlobalOrdinal> nodes;
  for (const SurfaceFacet& facet : facets) nodes.insert(facet.begin(), facet.end());
  const std::vector<GlobalOrdinal> ids(nodes.begin(), nodes.end());
  const auto invalid = Teuchos::OrdinalTraits<Tpetra::global_size_t>::invalid();
  const auto map = rcp(new Map(invalid, ids.data(), static_cast<LocalOrdinal>(ids.size()), 0, owned_nodes->getComm()));
  Vector owned(owned_nodes), local(map);
  {
    const auto view = owned.getLocalViewHost(Tpetra::Access::OverwriteAll);
    for (std::size_t node = 0; node < marks.size(); ++node) view(node, 0) = marks[node];
  }
  local.doImport(owned, Import(owned_nodes, map), Tpetra::INSERT);
  const auto view = local.getLocalViewHost(Tpetra::Access::ReadOnly);
  for (std::size_t n = 0; n < ids.size(); ++n) marks_[ids[n]] = view(n, 0) != 0.0;
}

TieMarks::TieMarks(const RCP<const Map>& owned_nodes, const std::vector<TiedPair>& ties) {
  for (const TiedPair& tie : ties) {
    slave_.push_back(nodes_on_surface(owned_nodes, tie.slave));
    master_.push_back(nodes_on_surface(owned_nodes, tie.master));
  }
}

int TieMarks::other(std::size_t t, std::size_t node) const {
  for (std::size_t q = 0; q < slave_.size() && slave_[t][node] != 0; ++q)
    if (q != t && (slave_[q][node] != 0 || master_[q][node] != 0)) return static_cast<int>(q);
  return -1;
}

void refuse_shared_facets(const RCP<const Map>& owned_nodes, const MultiVector& reference, const TieMarks& marks, const std::vector<TiedPair>& ties,
                          std::size_t t) {
  std::vector<char> shared(local_id_count(*owned_nodes));
  for (std::size_t node = 0; node < shared.size(); ++node) shared[node] = marks.meets(t, node);
  const NodeMarks of_facets(owned_nodes, ties[t].slave, shared);
  std::vector<std::string> texts;
  for (const SurfaceFacet& facet : ties[t].slave) {
    const LocalOrdinal first = owned_nodes->getLocalElement(facet.front());
    if (first < 0 || !std::all_of(facet.begin(), facet.end(), [&](GlobalOrdinal node) { return of_facets[node] != 0; })) continue;
    texts.push_back(fmt::format(
        "tie \"{}\": all nodes of a slave facet, {}, belong to other ties too, as node {} to \"{}\"; a node follows one surface: please take this "
        "part out of one of the ties, or give one tie all of the masters in one set",
        ties[t].name, fmt::join(facet, ", "), written_place(facet.front(), reference, first),
        ties[static_cast<std::size_t>(marks.other(t, static_cast<std::size_t>(first)))].name));
    break;
  }
  const std::string text = first_text(*owned_nodes->getComm(), texts);
  if (!text.empty()) throw InputError(ties[t].place, text);
}

std::string place_of_node(const SlaveNode& node, const MultiVector& reference) { return written_place(node.id, reference, node.owned_node); }

std::string first_text(const Communicator& comm, const std::vector<std::string>& texts) {
  std::vector<char> mine;
  if (!texts.empty()) mine.assign(texts.front().begin(), texts.front().end());
  for (const auto& part : all_to_all(comm, std::vector(static_cast<std::size_t>(comm.getSize()), mine)))
    if (!part.empty()) return {part.begin(), part.end()};
  return {};
}

}  // namespace mortise
