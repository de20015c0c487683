#include "pairs/multiplier_ties.hpp"

#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_Export.hpp>
#include <Tpetra_Import.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_MultiVector.hpp>
#include <algorithm>
#include <array>
#include <boost/container/static_vector.hpp>
#include <cmath>
#include <map>
#include <set>

#include "mortise/mortar/quadratic_facet.hpp"

namespace mortise::detail {
namespace {

constexpr double least_share = 0.01;  // eta: what a neighbour without cover has, over the sum of the neighbours' covers
constexpr double full = 1e-13;        // 1 - w that is round-off

RCP<const Map> map_of(const std::vector<GlobalOrdinal>& ids, const RCP<const Communicator>& comm) {
  const auto invalid = Teuchos::OrdinalTraits<Tpetra::global_size_t>::invalid();
  return rcp(new Map(invalid, ids.data(), static_cast<LocalOrdinal>(ids.size()), 0, comm));
}

// Places of the neighbours along the edges of a facet.
boost::container::static_vector<std::size_t, 2> neighbours(std::size_t a, std::size_t count, int dimension) {
  const std::size_t corners = facet_corners(dimension, count);
  if (dimension == 2) {
    if (count == 2) return {1 - a};
    if (a == 2) return {0, 1};
    return {2};
  }
  if (count == corners) return {(a + 1) % count, (a + count - 1) % count};
  if (a < corners) return {corners + a, corners + (a + corners - 1) % corners};
  const auto ends = ends_of_edge(a, corners);
  return {ends[0], ends[1]};
}

// Value of a facet's coupling at one of its nodes, with its derivatives in the facet's columns.
struct Slope {
  double value = 0.0;
  Eigen::RowVectorXd gradient;  // empty without derivatives
};

Slope force_of(const FacetCoupling& facet, std::size_t a) {
  const auto n = static_cast<Eigen::Index>(facet.slave.size()), j = static_cast<Eigen::Index>(a);
  Slope force{facet.D.row(j).sum(), {}};
  if (facet.dD.size() > 0) force.gradient = facet.dD.middleRows(n * j, n).colwise().sum();
  return force;
}

// (c_k + eta C) / sum_k' (c_k' + eta C) of the neighbours that have multipliers. A middle of a quadratic facet may have none while others of the
// facet do: where a strip is covered, far corners get less than the middle between them. Then all others stand in for neighbours.
struct FacetShares {
  boost::container::static_vector<std::size_t, most_side_nodes> places;
  boost::container::static_vector<Slope, most_side_nodes> shares;
};

FacetShares shares_on(const FacetCoupling& facet, std::size_t a, int dimension, bool derivatives) {
  FacetShares result;
  for (const std::size_t k : neighbours(a, facet.slave.size(), dimension))
    if (force_of(facet, k).value > 0.0) result.places.push_back(k);
  for (std::size_t k = 0, none = result.places.empty(); none && k < facet.slave.size(); ++k)
    if (k != a && force_of(facet, k).value > 0.0) result.places.push_back(k);
  const std::size_t count = result.places.size();
  double sum = 0.0;
  Eigen::RowVectorXd slope = Eigen::RowVectorXd::Zero(derivatives ? facet.dcover.cols() : 0);
  for (const std::size_t k : result.places) {
    sum += facet.cover[static_cast<Eigen::Index>(k)];
    if (derivatives) slope += facet.dcover.row(static_cast<Eigen::Index>(k));
  }
  const double scale = 1.0 / (1.0 + static_cast<double>(count) * least_share);
  for (const std::size_t k : result.places) {  // scale (c_k / C + eta)
    const double cover = facet.cover[static_cast<Eigen::Index>(k)];
    Slope share{scale * (cover / sum + least_share), {}};
    if (derivatives) share.gradient = scale / (sum * sum) * (sum * facet.dcover.row(static_cast<Eigen::Index>(k)) - cover * slope);
    result.shares.push_back(std::move(share));
  }
  return result;
}

}  // namespace

MultiplierTies::MultiplierTies(const std::vector<SlaveNode>& owned, const SurfaceFacets& slave, const RCP<const Communicator>& comm) {
  std::vector<GlobalOrdinal> ids;
  for (const SlaveNode& node : owned) ids.push_back(node.id);
  owned_ = map_of(ids, comm);
  std::set<GlobalOrdinal> others;
  for (const SurfaceFacet& facet : slave)
    for (const GlobalOrdinal node : facet)
      if (!owned_->isNodeGlobalElement(node)) others.insert(node);
  ids.insert(ids.end(), others.begin(), others.end());
  nodes_ = map_of(ids, comm);
  import_ = rcp(new Import(owned_, nodes_));
}

// Of a node b all facets stand among the couplings of its owner.
void MultiplierTies::measure(const std::vector<FacetCoupling>& couplings, const std::vector<SlaveNode>& owned,
                             const std::function<bool(std::size_t)>& covered, const Map& local_nodes, double full_cover, double softness,
                             int dimension, bool derivatives) {
  ties_.clear();
  compliance_.clear();
  any_ = false;
  if (full_cover == 0.0) return;
  std::vector<double> squares(owned.size(), 0.0);
  for (const FacetCoupling& facet : couplings)
    for (std::size_t a = 0; a < facet.slave.size(); ++a) {
      const auto s = static_cast<std::size_t>(facet.slave[a]);
      if (s >= owned.size() || facet.cover.size() == 0) continue;
      squares[s] += std::pow(facet.cover[static_cast<Eigen::Index>(a)], 2);
    }
  const auto rest = [&](std::size_t s) {  // 1 - w
    const double cover = std::min(1.0, std::sqrt(squares[s]) / full_cover);
    return (1.0 - cover) * (1.0 - cover) * (1.0 + 2.0 * cover);
  };
  // Node to segment has no covered shares.
  const auto is_tied = [&](std::size_t s) { return covered(s) && squares[s] > 0.0 && rest(s) > full; };
  std::map<std::size_t, std::vector<std::pair<const FacetCoupling*, std::size_t>>> facets_of;
  for (const FacetCoupling& facet : couplings)
    for (std::size_t a = 0; a < facet.slave.size(); ++a)
      if (const auto s = static_cast<std::size_t>(facet.slave[a]); s < owned.size() && is_tied(s)) facets_of[s].emplace_back(&facet, a);

  for (const auto& [s, facets] : facets_of) {
    MultiplierTie tie;
    tie.node = s;
    tie.compliance = rest(s) * owned[s].weight * softness;
    std::vector<FacetShares> shares;
    Slope all, tying;  // sum_e d^e of the facets with receivers, and sum_e d^e a^e
    for (const auto& [facet, a] : facets) {
      shares.push_back(shares_on(*facet, a, dimension, derivatives));
      const double own = facet->D.row(static_cast<Eigen::Index>(a)).sum();
      if (!shares.back().places.empty()) {
        all.value += own;
        tying.value += own * facet->alignment;
      }
      for (const LocalOrdinal node : facet->columns) tie.columns.push_back(node);
    }
    if (!(tying.value > 0.0)) continue;
    std::sort(tie.columns.begin(), tie.columns.end());
    tie.columns.erase(std::unique(tie.columns.begin(), tie.columns.end()), tie.columns.end());
    const auto width = derivatives ? dimension * static_cast<Eigen::Index>(tie.columns.size()) : 0;
    const auto add = [&](const FacetCoupling& facet, const Eigen::RowVectorXd& gradient, double factor, auto&& to) {
      for (std::size_t c = 0; c < facet.columns.size() && width > 0; ++c) {
        const auto place = std::lower_bound(tie.columns.begin(), tie.columns.end(), facet.columns[c]) - tie.columns.begin();
        to.segment(dimension * place, dimension) += factor * gradient.segment(dimension * static_cast<Eigen::Index>(c), dimension);
      }
    };
    all.gradient.setZero(width);
    tying.gradient.setZero(width);
    tie.dcompliance.setZero(width);
    for (std::size_t f = 0; f < facets.size(); ++f) {
      const auto& [facet, a] = facets[f];
      for (const std::size_t k : shares[f].places) {
        const LocalOrdinal receiver = nodes_->getLocalElement(local_nodes.getGlobalElement(facet->slave[k]));
        if (std::find(tie.receivers.begin(), tie.receivers.end(), receiver) == tie.receivers.end()) tie.receivers.push_back(receiver);
      }
      if (!derivatives) continue;
      // dw = 6 (1 - s) / c_0^2 sum_e c^e dc^e
      const double cover = std::sqrt(squares[s]) / full_cover;
      const auto row = static_cast<Eigen::Index>(a);
      add(*facet, facet->dcover.row(row), -6.0 * (1.0 - cover) / (full_cover * full_cover) * facet->cover[row] * owned[s].weight * softness,
          tie.dcompliance);
      if (shares[f].places.empty()) continue;
      const Slope own = force_of(*facet, a);
      add(*facet, own.gradient, 1.0, all.gradient);
      add(*facet, own.gradient, facet->alignment, tying.gradient);
      if (facet->dalignment.size() > 0) add(*facet, facet->dalignment, own.value, tying.gradient);
    }
    const double share = tying.value / all.value;
    tie.dcompliance = share * tie.dcompliance + tie.compliance / all.value * (tying.gradient - share * all.gradient);
    tie.compliance *= share;
    tie.shares.assign(tie.receivers.size(), 0.0);
    tie.dshares.setZero(static_cast<Eigen::Index>(tie.receivers.size()), width);
    for (std::size_t f = 0; f < facets.size(); ++f) {
      const auto& [facet, a] = facets[f];
      if (shares[f].places.empty()) continue;
      const Slope own = force_of(*facet, a);
      for (std::size_t k = 0; k < shares[f].places.size(); ++k) {
        const LocalOrdinal receiver = nodes_->getLocalElement(local_nodes.getGlobalElement(facet->slave[shares[f].places[k]]));
        const auto r = std::find(tie.receivers.begin(), tie.receivers.end(), receiver) - tie.receivers.begin();
        const Slope& share = shares[f].shares[k];
        tie.shares[static_cast<std::size_t>(r)] += own.value / all.value * share.value;
        if (!derivatives) continue;
        add(*facet, own.gradient, share.value / all.value, tie.dshares.row(r));
        add(*facet, share.gradient, own.value / all.value, tie.dshares.row(r));
        tie.dshares.row(r) -= own.value * share.value / (all.value * all.value) * all.gradient;
      }
    }
    ties_.push_back(std::move(tie));
  }
  if (!ties_.empty()) {
    compliance_.assign(owned.size(), 0.0);
    for (const MultiplierTie& tie : ties_) compliance_[tie.node] = tie.compliance;
  }
  int mine = !ties_.empty(), all = 0;
  Teuchos::reduceAll(*owned_->getComm(), Teuchos::REDUCE_MAX, mine, Teuchos::outArg(all));
  any_ = all != 0;
}

RCP<MultiVector> MultiplierTies::on_nodes(const MultiVector& z) const {
  const auto result = rcp(new MultiVector(nodes_, z.getNumVectors()));
  result->doImport(z, *import_, Tpetra::INSERT);
  return result;
}

// An export with ADD replaces what the rank itself sends to itself: the sums are zero before it.
RCP<MultiVector> MultiplierTies::summed(const MultiVector& on_nodes) const {
  const auto result = rcp(new MultiVector(owned_, on_nodes.getNumVectors()));
  result->doExport(on_nodes, Export(nodes_, owned_), Tpetra::ADD);
  return result;
}

SpatialVector MultiplierTies::deviation(const MultiplierTie& tie, const MultiVector& z_on_nodes) {
  const auto z = z_on_nodes.getLocalViewHost(Tpetra::Access::ReadOnly);
  SpatialVector r(static_cast<Eigen::Index>(z.extent(1)));
  for (std::size_t i = 0; i < z.extent(1); ++i) {
    r[static_cast<Eigen::Index>(i)] = z(tie.node, i);
    for (std::size_t k = 0; k < tie.receivers.size(); ++k) r[static_cast<Eigen::Index>(i)] -= tie.shares[k] * z(tie.receivers[k], i);
  }
  return r;
}

RCP<MultiVector> MultiplierTies::gradient(const MultiVector& z_on_nodes, int dimension) const {
  MultiVector q(nodes_, static_cast<std::size_t>(dimension));
  {
    const auto view = q.getLocalViewHost(Tpetra::Access::ReadWrite);
    for (const MultiplierTie& tie : ties_) {
      const SpatialVector force = tie.compliance * deviation(tie, z_on_nodes);
      for (int i = 0; i < dimension; ++i) {
        view(tie.node, i) += force[i];
        for (std::size_t k = 0; k < tie.receivers.size(); ++k) view(tie.receivers[k], i) -= tie.shares[k] * force[i];
      }
    }
  }
  return summed(q);
}

std::vector<double> MultiplierTies::diagonal() const {
  MultiVector diagonal(nodes_, 1);
  {
    const auto view = diagonal.getLocalViewHost(Tpetra::Access::ReadWrite);
    for (const MultiplierTie& tie : ties_) {
      view(tie.node, 0) += tie.compliance;
      for (std::size_t k = 0; k < tie.receivers.size(); ++k) view(tie.receivers[k], 0) += tie.shares[k] * tie.shares[k] * tie.compliance;
    }
  }
  const RCP<MultiVector> sum = summed(diagonal);
  const auto view = sum->getLocalViewHost(Tpetra::Access::ReadOnly);
  std::vector<double> result(view.extent(0));
  for (std::size_t s = 0; s < result.size(); ++s) result[s] = view(s, 0);
  return result;
}

}  // namespace mortise::detail
