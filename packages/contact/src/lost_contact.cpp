// Closed nodes that went through the master surface, out of its reach.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_MultiVector.hpp>

#include "implementation.hpp"

namespace mortise {

// A master facet takes part in the integrals only within the reach. A node that one Newton step carries further than that through the master
// has no contact left that could push it back: its D_jj is zero, it counts as open, and the bodies pass through one another. So for each node
// that was closed and has nothing to act on any more the line x + s n is followed beyond the reach. With s of the nearest master facet that
// faces n (the facets that integrals are taken over):
//   s > 0: the node has opened;   none: it has run off the edge;   -s > reach: it is lost.
// Nodes that are covered are within reach, and a frozen geometry covers a node for ever or never.
void ContactSystem::Implementation::find_lost_contact(const MultiVector& x, std::optional<StepFailure>& failure) const {
  std::vector<std::vector<std::size_t>> uncovered(pairs.size());
  std::vector<double> counts(pairs.size() + 1, 0.0), all(pairs.size() + 1);
  for (std::size_t p = 0; p < pairs.size(); ++p) {
    for (std::size_t s = 0; s < marked[p].size(); ++s)
      if ((marked[p][s] != ContactState::open || accepted[p][s] != ContactState::open) && !pairs[p]->covered(s)) uncovered[p].push_back(s);
    counts[p] = static_cast<double>(uncovered[p].size());
  }
  counts.back() = failure ? 1.0 : 0.0;  // then rows and normals may have no meaning
  Teuchos::reduceAll(*dofs->getComm(), Teuchos::REDUCE_MAX, static_cast<int>(counts.size()), counts.data(), all.data());
  if (all.back() > 0.0) return;

  const auto positions = x.getLocalViewHost(Tpetra::Access::ReadOnly);
  for (std::size_t p = 0; p < pairs.size(); ++p) {
    if (all[p] == 0.0) continue;
    const detail::PairCoupling& pair = *pairs[p];
    std::vector<SpatialVector> normals;
    for (const std::size_t s : uncovered[p]) normals.push_back(pair.rows()[s].normal);
    const auto distances = pair.interface().distances_to_master(x, uncovered[p], normals);
    double deepest = pair.interface().reach();
    for (std::size_t n = 0; n < distances.size(); ++n) {
      if (!distances[n] || -*distances[n] <= deepest) continue;
      deepest = -*distances[n];
      const SlaveNode& node = pair.slave_nodes()[uncovered[p][n]];
      std::vector<double> place;
      for (int i = 0; i < dimension; ++i) place.push_back(positions(node.owned_node, i));
      failure = StepFailure(FailureKind::lost_contact,
                            fmt::format("contact \"{}\": node {} of the slave, which was closed, is at ({:.6g}), {:.3g} behind the master surface "
                                        "and out of its reach {:.3g}",
                                        pair.definition().name, node.id, fmt::join(place, ", "), deepest, pair.interface().reach()));
    }
  }
}

}  // namespace mortise
