// Nodes whose facets are hardly covered hand their functions over to nodes that have more to act on.
//
// Where the master ends a small part of a facet into it, the nodes on the far side of the facet would have multipliers that act on next to nothing: a
// strip of width eps of a facet of width h gives them the weight eps^2 / 2h. A force F that holds such a node down takes the multiplier F / D, and
// its linearisation z dD / dx ~ F / eps: the edge's motion along the slave is a negative stiffness that outgrows the body's with eps < F / K. One
// condition, that the strip touches in the mean, is all that so small a cover can bear. With the far function handed over to the near node of its
// facet, whose function then is 1 on the strip, that is what is left: phi sums to 1, constant pressure and total forces stay exact.
// Of quadratic facets too: where eps of a facet is covered beside one of its corners, a middle of the corner's edges has the weight ~ eps^3, and
// leaves it to the corner. That acts on the other end of the edge, int phi_c N_k < 0, so k must not carry. A facet with two corners that carry needs
// a middle. The choice is discontinuous. So it is made between steps only, with hysteresis.

#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_Import.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <limits>
#include <utility>

#include "interface.hpp"

namespace mortise {
namespace {

/// Share of its weight below which a node hands over, and the factor above which it takes back.
constexpr double hardly_covered = 0.1, hysteresis = 2.0;
/// Cover that is round-off.
constexpr double no_cover = 1e-12;

}  // namespace

FacetVector covered_weights(int dimension, const FacetCoupling& coupling) {
  // D = S diag(int Ñ) B^-T, and the columns of S sum to 1
  const NonNegativeBasis* basis = non_negative_basis(dimension, coupling.slave.size());
  if (basis == nullptr) return coupling.D.colwise().sum();
  return (coupling.D * basis->of_shape.transpose()).colwise().sum();
}

// Values of owned slave nodes, on all nodes of the facets. Collective.
template <int dim>
std::vector<double> Interface<dim>::on_facets(const std::vector<double>& owned) const {
  Vector from(owned_nodes_), to(to_facets_->getTargetMap());
  {
    const auto view = from.getLocalViewHost(Tpetra::Access::ReadWrite);
    for (std::size_t s = 0; s < owned.size(); ++s) view(slave.owned[s].owned_node, 0) = owned[s];
  }
  to.doImport(from, *to_facets_, Tpetra::REPLACE);
  const auto values = to.getData();
  return {values.begin(), values.end()};
}

// Nodes that facets cannot do without take their functions back: those of `heirs` with the most cover. A facet that is not covered, as one of them
// without any cover tells, keeps these: they have nothing to do unless the step covers it. Collective.
template <int dim>
void Interface<dim>::keep(Heirs heirs, const std::vector<double>& covered, std::vector<double>& hands) const {
  const std::vector<double> would_hand = on_facets(hands);
  for (std::size_t s = 0; s < hands.size(); ++s) {
    if (hands[s] == 0.0 || (heirs == Heirs::middles && !slave.owned[s].middle)) continue;
    const auto keeps = [&](std::size_t f) {
      const Facet<LocalOrdinal>& facet = slave.facets[f];
      const std::size_t corners = facet_corners(dim, facet.size());
      std::size_t carrying_corners = 0, carrying_middles = 0;
      double least = std::numeric_limits<double>::max(), most = 0.0;
      for (std::size_t a = 0; a < facet.size(); ++a) {
        if (!slave.carries[facet[a]]) continue;
        if (would_hand[facet[a]] == 0.0) ++(a < corners ? carrying_corners : carrying_middles);
        if (heirs == Heirs::middles && a < corners) continue;
        least = std::min(least, covered[facet[a]]);
        most = std::max(most, covered[facet[a]]);
      }
      if (carrying_middles > 0 || (heirs == Heirs::any ? carrying_corners > 0 : carrying_corners == 1)) return false;
      return least > no_cover ? covered[s] >= 0.5 * most : covered[s] <= no_cover;
    };
    if (std::any_of(slave.facets_of[s].begin(), slave.facets_of[s].end(), keeps)) hands[s] = 0.0;
  }
}

// A node with little cover hands over if a node of its facets has enough.
template <int dim>
bool Interface<dim>::hand_over(const std::vector<double>& cover) {
  if (to_facets_.is_null()) {
    const auto invalid = Teuchos::OrdinalTraits<Tpetra::global_size_t>::invalid();
    const auto target = rcp(new Map(invalid, slave.node_ids.data(), static_cast<LocalOrdinal>(slave.nodes_with_normal), 0, owned_nodes_->getComm()));
    to_facets_ = rcp(new Import(owned_nodes_, target));
    handed_over_.assign(slave.nodes_with_normal, 0.0);
  }
  const std::vector<double> covered = on_facets(cover);
  const auto carries_enough = [&](LocalOrdinal node) {
    return slave.carries[node] && covered[node] >= (handed_over_[node] > 0.0 ? hysteresis : 1.0) * hardly_covered;
  };
  std::vector<double> hands(slave.owned.size(), 0.0);
  for (std::size_t s = 0; s < hands.size(); ++s) {
    if (!slave.carries[s] || carries_enough(static_cast<LocalOrdinal>(s))) continue;
    for (const std::size_t f : slave.facets_of[s])
      if (std::any_of(slave.facets[f].begin(), slave.facets[f].end(), carries_enough)) hands[s] = 1.0;
  }
  keep(Heirs::any, covered, hands);
  keep(Heirs::middles, covered, hands);
  const std::vector<double> before = std::exchange(handed_over_, on_facets(hands));
  int any = 0;
  Teuchos::reduceAll(*owned_nodes_->getComm(), Teuchos::REDUCE_MAX, static_cast<int>(handed_over_ != before), Teuchos::outArg(any));
  if (any == 0) return false;
  for (std::size_t f = 0; f < slave.facets.size(); ++f) {
    std::vector<char> carries;
    for (const LocalOrdinal node : slave.facets[f]) carries.push_back(slave.carries[node] && handed_over_[node] == 0.0);
    slave.multipliers[f].share = multiplier_shares(carries, facet_corners(dim, slave.facets[f].size()));
  }
  number_nodes();
  return true;
}

template bool Interface<2>::hand_over(const std::vector<double>&);
template bool Interface<3>::hand_over(const std::vector<double>&);

}  // namespace mortise
