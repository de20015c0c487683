// Tangents of slave nodes with prescribed components along which nothing moves.

#include <Tpetra_Map.hpp>
#include <Tpetra_MultiVector.hpp>
#include <algorithm>
#include <cmath>

#include "pairs/pair.hpp"

namespace mortise::detail {

// A weighted slip is a mean over what a node stands for. On a plane of symmetry that is half of the whole: next to the plane the surfaces slide away
// from it on either side, and on it nothing moves. So the node slips along a component that is prescribed only if the node itself moves in this step,
// or what it faces does. The master stays where all that the node is coupled to is prescribed and stays, as a rigid body. It also stays where a
// held node of it lies on the plane. All these are prescribed: they do not change with the solution, and have no derivatives.
void Pair::find_resting(PairGeometry& geometry) const {
  if (!any_held_) return;
  constexpr double not_at_all = 1e-12, on_the_plane = 1e-6;  // of a facet
  const auto x = geometry.positions->getLocalViewHost(Tpetra::Access::ReadOnly), X = start_->getLocalViewHost(Tpetra::Access::ReadOnly),
             held = held_->getLocalViewHost(Tpetra::Access::ReadOnly);
  const Map& nodes = *geometry.pattern->local_nodes;
  for (std::size_t s = 0; s < geometry.slips.size(); ++s) {
    const SlaveNode& slave = slave_nodes()[s];
    if (!slave.carries_multiplier || !slave.partly_fixed()) continue;
    const NodeRow& row = (*geometry.rows)[s];
    const std::vector<LocalOrdinal>& coupled = geometry.pattern->coupled[s];
    std::size_t tangent = 0;
    for (int i = 0; i < dimension_; ++i) {
      if (!slave.fixed[i]) continue;
      if (std::abs((*geometry.rows)[s].normal[i]) > not_at_all) {  // a surface that leans over along it may slide all the same
        ++tangent;
        continue;
      }
      const auto stays = [&](LocalOrdinal node) { return std::abs(x(node, i) - X(node, i)) <= not_at_all * size_; };
      bool all = true, on_plane = false;
      for (std::size_t c = 0; c < coupled.size(); ++c) {
        if (row.coefficients[c] == 0.0 || slave_ids_.count(nodes.getGlobalElement(coupled[c])) > 0) continue;
        const bool rests = held(coupled[c], i) != 0.0 && stays(coupled[c]);
        all = all && rests;
        on_plane = on_plane || (rests && std::abs(x(coupled[c], i) - x(slave.local_node, i)) <= on_the_plane * size_);
      }
      geometry.slips[s].rests[tangent++] = stays(slave.local_node) && (all || on_plane);
    }
  }
}

}  // namespace mortise::detail
