#include "distribution/partition.hpp"

#include <Teuchos_CommHelpers.hpp>
#include <Teuchos_OrdinalTraits.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_TieBreak.hpp>
#include <algorithm>
#include <limits>
#include <numeric>
#include <stdexcept>

#include "distribution/element_graph.hpp"
#include "mortise/core/trilinos_versions.hpp"

namespace mortise {
namespace {

bool on_contact(const BodySet& bodies, const std::vector<std::vector<bool>>& is_contact, GlobalOrdinal element) {
  const int body = bodies.body_of_element(element);
  for (const auto& side : bodies.surface_sides(element))
    if (is_contact[body][side.name + 1]) return true;
  return false;
}

/// Chooses among the ranks that hold a node by their numbers alone.
class AlternatingOwner : public Tpetra::Details::TieBreak<LocalOrdinal, GlobalOrdinal> {
 public:
  bool mayHaveSideEffects() const override { return false; }
  std::size_t selectedIndex(GlobalOrdinal, const std::vector<std::pair<int, LocalOrdinal>>& holders) const override {
    std::vector<int> ranks;
    for (const auto& holder : holders) ranks.push_back(holder.first);
    return static_cast<std::size_t>(std::find(ranks.begin(), ranks.end(), owner_among(ranks)) - ranks.begin());
  }
};

RCP<const Map> map_of(const RCP<const Communicator>& comm, const std::vector<GlobalOrdinal>& ids) {
  return rcp(new Map(Teuchos::OrdinalTraits<Tpetra::global_size_t>::invalid(), Teuchos::arrayViewFromVector(ids), 0, comm));
}

}  // namespace

std::vector<std::vector<bool>> contact_flags(const BodySet& bodies, const std::vector<BodyDescription>& descriptions,
                                             const std::vector<std::string>& contact_sides) {
  const auto is_named = [&](const std::string& side) { return std::find(contact_sides.begin(), contact_sides.end(), side) != contact_sides.end(); };
  std::vector<std::vector<bool>> flags;
  for (int b = 0; b < bodies.size(); ++b) {
    const bool whole = is_named(descriptions[b].name + "/surface");
    flags.push_back({whole});
    for (const auto& side : bodies.side_names(b)) flags.back().push_back(whole || is_named(descriptions[b].name + "/" + side));
  }
  return flags;
}

int owner_among(std::vector<int> holders) {
  std::sort(holders.begin(), holders.end());
  holders.erase(std::unique(holders.begin(), holders.end()), holders.end());
  const std::size_t sum = std::accumulate(holders.begin(), holders.end(), std::size_t{0});
  return holders[sum % holders.size()];
}

std::vector<int> ranks_of_elements(const BodySet& bodies, const std::vector<std::vector<bool>>& is_contact, int ranks) {
  if (bodies.element_count() > std::numeric_limits<idx_t>::max() / 8) throw std::runtime_error("the mesh has more elements than METIS can number");
  idx_t elements = static_cast<idx_t>(bodies.element_count());
  std::vector<idx_t> part(elements);
  if (ranks == 1) return std::vector<int>(part.size(), 0);  // METIS wants two parts
  if (elements < ranks) {
    std::iota(part.begin(), part.end(), 0);
    return {part.begin(), part.end()};
  }
  ElementGraph graph = element_graph(bodies, is_contact);
  // Two weights to be balanced: elements, and elements on contact sides.
  std::vector<idx_t> weights;
  idx_t contact_elements = 0;
  for (idx_t e = 0; e < elements; ++e) {
    const bool contact = on_contact(bodies, is_contact, e);
    weights.push_back(1);
    weights.push_back(contact ? 1 : 0);
    contact_elements += contact;
  }
  idx_t constraints = 2;
  if (contact_elements < ranks) {
    constraints = 1;
    weights.assign(elements, 1);
  }
  idx_t options[METIS_NOPTIONS], parts = ranks, cut = 0;
  METIS_SetDefaultOptions(options);
  options[METIS_OPTION_SEED] = 1;
  options[METIS_OPTION_NUMBERING] = 0;
  // Recursive bisection balances several weights better; the k-way method is faster for many ranks.
  const auto method = ranks <= 8 ? METIS_PartGraphRecursive : METIS_PartGraphKway;
  const int status = method(&elements, &constraints, graph.offsets.data(), graph.neighbours.data(), weights.data(), nullptr, graph.weights.data(),
                            &parts, nullptr, nullptr, options, &cut, part.data());
  if (status != METIS_OK) throw std::runtime_error("METIS could not partition the mesh");
  return {part.begin(), part.end()};
}

std::vector<GlobalOrdinal> share_out_elements(const Communicator& comm, const BodySet& bodies, const std::vector<std::vector<bool>>& is_contact) {
  std::vector<GlobalOrdinal> owned;
  const int ranks = comm.getSize();
  if (ranks == 1) {
    owned.resize(bodies.element_count());
    std::iota(owned.begin(), owned.end(), 0);
    return owned;
  }
  // Rank 0 sorts the elements by rank; everyone gets the count, then the ids.
  std::vector<GlobalOrdinal> sorted;
  std::vector<int> counts(ranks, 0), offsets(ranks, 0);
  std::string failure;
  if (comm.getRank() == 0) {
    try {
      const std::vector<int> part = ranks_of_elements(bodies, is_contact, ranks);
      for (const auto rank : part) ++counts[rank];
      std::partial_sum(counts.begin(), counts.end() - 1, offsets.begin() + 1);
      sorted.resize(part.size());
      auto next = offsets;
      for (std::size_t e = 0; e < part.size(); ++e) sorted[next[part[e]]++] = static_cast<GlobalOrdinal>(e);
    } catch (const std::exception& error) {
      failure = error.what();
      counts.assign(ranks, -1);
    }
  }
  Teuchos::broadcast(comm, 0, ranks, counts.data());
  const int mine = counts[comm.getRank()];
  if (mine < 0) throw std::runtime_error(failure.empty() ? "the mesh could not be partitioned; rank 0 says why" : failure);
  owned.resize(mine);
  if (comm.getRank() == 0) {
    std::copy_n(sorted.begin(), mine, owned.begin());
    for (int rank = 1; rank < ranks; ++rank)
      if (counts[rank] > 0) Teuchos::send(comm, counts[rank], sorted.data() + offsets[rank], rank);
  } else if (mine > 0) {
    Teuchos::receive(comm, 0, mine, owned.data());
  }
  return owned;
}

RCP<const Map> share_out_nodes(const RCP<const Communicator>& comm, const BodySet& bodies, const std::vector<GlobalOrdinal>& owned_elements,
                               GlobalOrdinal further_nodes) {
  std::vector<GlobalOrdinal> ids;
  if (comm->getSize() == 1) {
    ids.resize(bodies.node_count() + further_nodes);
    std::iota(ids.begin(), ids.end(), 0);
    return map_of(comm, ids);
  }
  if (comm->getRank() == 0)
    for (GlobalOrdinal node = 0; node < further_nodes; ++node) ids.push_back(bodies.node_count() + node);
  for (const auto element : owned_elements) {
    const auto nodes = bodies.element_nodes(element);
    ids.insert(ids.end(), nodes.begin(), nodes.end());
  }
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  const auto overlapping = map_of(comm, ids);
  const auto one_to_one = Tpetra::createOneToOne(overlapping, AlternatingOwner());
  const auto view = local_ids(*one_to_one);
  ids.assign(view.begin(), view.end());
  std::sort(ids.begin(), ids.end());
  return map_of(comm, ids);
}

}  // namespace mortise
