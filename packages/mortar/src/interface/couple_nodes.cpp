// Slave nodes that are coupled one by one, as node to segment has it.
//
// A corner takes the master's normal as it does where facets are integrated, see settle_corners.cpp. The normal n_j has the direction
//   m_j = -sum_f int N_j <-n_f.n_m> n_m,   and weights  w_f = <n_f.n_j>,   w = sum_f w_f int N_j.
// A line along the average of a bottom's and a wall's normal would lean by 45 degrees, and the node would have the share of the wall. The integral of
// m_j is there for its smoothness: what a line along n_f meets has a normal that jumps from one facet of the master to the next.

#include <algorithm>

#include "interface/interface.hpp"
#include "slave/settled_corner.hpp"
#include "slave/slave_node.hpp"

namespace mortise {

// Normal and weights of a corner, of what its facets cover. False where they cover nothing.
template <int dim>
bool Interface<dim>::settle_node(std::size_t s, const Positions<dim>& x, bool derivatives, std::vector<NodalNormal>& normals, SettledCorner& corner) {
  std::array<FacetCoupling, 2> covered;
  SlaveFacetData data;
  for (std::size_t e = 0; e < slave.facets_of[s].size(); ++e) {
    const std::size_t f = slave.facets_of[s][e];
    data.nodes = slave.facets[f];
    data.multipliers = &slave.multipliers[f];
    data.normals.clear();
    for (const LocalOrdinal normal : slave.normals[f]) data.normals.push_back(&normals[normal]);
    data.at_corner = true;
    const auto place = std::find(data.nodes.begin(), data.nodes.end(), slave.owned[s].local_node) - data.nodes.begin();
    const bool is_covered = segments_of(data, candidates_[f], x, derivatives, covered[e]) > 0;
    const CornerSide side = {is_covered ? &covered[e] : nullptr, place, &normals[slave.normals[f][place]]};
    corner.sides.insert(place == 1 ? corner.sides.begin() : corner.sides.end(), side);
  }
  const bool moves = derivatives && options_.linearisation == Linearisation::exact;
  const bool settled = settle<dim>(corner, derivatives, moves, slave.stencils[s], normals[s]);
  for (CornerSide& side : corner.sides) side.coupling = nullptr;
  return settled;
}

template <int dim>
std::size_t Interface<dim>::couple_nodes(const Positions<dim>& x, bool derivatives, std::vector<NodalNormal>& normals,
                                         std::vector<FacetCoupling>& couplings, std::optional<StepFailure>& failure) {
  std::size_t used = 0;
  if constexpr (dim == 2) {
    const bool master_normals = options_.corner_rule(dim) == CornerRule::master_normal;
    for (std::size_t s = 0; s < slave.owned.size() && !failure; ++s) {
      if (!slave.owned[s].carries_multiplier) continue;
      SettledCorner corner;
      const bool is_corner = master_normals && kinks_.is_kink[s] != 0;
      try {
        if (is_corner && !settle_node(s, x, derivatives, normals, corner)) continue;
      } catch (const StepFailure& one) {
        failure = one;
        continue;
      }
      if (used == couplings.size()) couplings.emplace_back();
      const SlaveNodeData data = {slave.owned[s].local_node, &slave.stencils[s], &normals[s], is_corner ? &corner : nullptr};
      used += options_.coupling->couple_node(data, met_[s], reach, x, measure_, options_.share, derivatives, couplings[used]);
    }
  }
  return used;
}

template std::size_t Interface<2>::couple_nodes(const Positions<2>&, bool, std::vector<NodalNormal>&, std::vector<FacetCoupling>&,
                                                std::optional<StepFailure>&);
template std::size_t Interface<3>::couple_nodes(const Positions<3>&, bool, std::vector<NodalNormal>&, std::vector<FacetCoupling>&,
                                                std::optional<StepFailure>&);

}  // namespace mortise
