// Nodes that went through the master surface, out of its reach.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_MultiVector.hpp>
#include <algorithm>
#include <cmath>

#include "evaluation/evaluated_contact.hpp"

namespace mortise::detail {
namespace {

double largest_motion(const MultiVector& from, const MultiVector& to, const std::vector<LocalOrdinal>& nodes) {
  const auto a = from.getLocalViewHost(Tpetra::Access::ReadOnly), b = to.getLocalViewHost(Tpetra::Access::ReadOnly);
  double largest = 0.0;
  for (const LocalOrdinal node : nodes) {
    double square = 0.0;
    for (std::size_t i = 0; i < a.extent(1); ++i) square += std::pow(b(node, i) - a(node, i), 2);
    largest = std::max(largest, square);
  }
  return std::sqrt(largest);
}

constexpr double far = 100.0;  ///< over the reach: nodes that slide off an edge, or around a corner, go less far beyond it

/// How far nodes have gone on beyond the master since `start`, along straight ways, past where these met it there; no value: not far.
std::vector<std::optional<double>> ways_beyond_master(const ContactModel& model, const PairEvaluation& pair, const std::vector<std::size_t>& nodes,
                                                      const MultiVector& start, const MultiVector& x) {
  const auto from = start.getLocalViewHost(Tpetra::Access::ReadOnly), to = x.getLocalViewHost(Tpetra::Access::ReadOnly);
  std::vector<SpatialVector> directions;
  std::vector<double> lengths;
  for (const std::size_t s : nodes) {
    const LocalOrdinal node = pair.slave_nodes()[s].owned_node;
    SpatialVector way(model.dimension);
    for (int i = 0; i < model.dimension; ++i) way[i] = to(node, i) - from(node, i);
    lengths.push_back(way.norm());
    directions.push_back(lengths.back() > 0.0 ? SpatialVector(way / lengths.back()) : pair.row(s).normal);
  }
  auto distances = pair.pair().interface().distances_to_master(start, nodes, directions);
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    if (distances[n] && *distances[n] >= 0.0 && lengths[n] - *distances[n] > far * pair.pair().interface().reach())
      distances[n] = lengths[n] - *distances[n];
    else
      distances[n].reset();
  }
  return distances;
}

}  // namespace

// A master facet takes part in the integrals only within the reach. A node that one Newton step carries further than that through the master has no
// contact left that could push it back. Its D_jj is zero, it counts as open, and the bodies pass through one another. So the line x + s n is
// followed beyond the reach, for each node that was closed and has nothing to act on any more. It meets the nearest master facet that faces n (the
// facets that integrals are taken over) at s:
//   s > 0: the node has opened;   none: it has run off the edge;   -s > reach: it is lost.
// A node that was open is lost with -s > reach as well if it was not yet in the accepted state. So is one whose line meets nothing, if the straight
// way from there has gone through the master: far away lines miss it, as normals that turn by little do. The surfaces have then moved by more than
// the reach relative to one another since: it is looked for only where they have. Nodes that are covered are within reach. A frozen geometry covers a
// node always or never.
std::optional<StepFailure> find_lost_contact(const EvaluatedContact& contact, const ContactStates* last, bool failed) {
  const ContactModel& model = *contact.model;
  const std::vector<PairEvaluation>& pairs = contact.pairs;
  const MultiVector& x = *contact.positions;
  const AcceptedContact& accepted = *contact.history;
  std::optional<StepFailure> failure;
  std::vector<std::vector<std::size_t>> closed(pairs.size()), open(pairs.size());
  // Of each pair: how many nodes were closed and are not covered, how far slave and master nodes have moved; whether there is a failure already.
  std::vector<double> mine(3 * pairs.size() + 1, 0.0), all(mine.size());
  for (std::size_t p = 0; p < pairs.size(); ++p) {
    std::vector<LocalOrdinal> slaves;
    for (std::size_t s = 0; s < pairs[p].slave_nodes().size(); ++s) {
      slaves.push_back(pairs[p].slave_nodes()[s].owned_node);
      if (pairs[p].covered(s)) continue;
      const auto was_closed = [&](const ContactStates& states) { return states[p].states[s] != ContactState::open; };
      ((last != nullptr && was_closed(*last)) || was_closed(accepted.states) ? closed : open)[p].push_back(s);
    }
    mine[3 * p] = static_cast<double>(closed[p].size());
    mine[3 * p + 1] = largest_motion(*accepted.positions, x, slaves);
    mine[3 * p + 2] = largest_motion(*accepted.positions, x, model.master_nodes[p]);
  }
  mine.back() = failed ? 1.0 : 0.0;  // then rows and normals may have no meaning
  Teuchos::reduceAll(model.comm(), Teuchos::REDUCE_MAX, static_cast<int>(mine.size()), mine.data(), all.data());
  if (all.back() > 0.0) return failure;

  const auto positions = x.getLocalViewHost(Tpetra::Access::ReadOnly);
  for (std::size_t p = 0; p < pairs.size(); ++p) {
    const PairEvaluation& pair = pairs[p];
    const MortarInterface& interface = pair.pair().interface();
    double deepest = interface.reach();
    const auto look_for = [&](const std::vector<std::size_t>& nodes, const char* before, const MultiVector* start) {
      std::vector<SpatialVector> normals;
      for (const std::size_t s : nodes) normals.push_back(pair.row(s).normal);
      const auto distances = interface.distances_to_master(x, nodes, normals);
      const auto at_start = start == nullptr ? distances : interface.distances_to_master(*start, nodes, normals);
      const auto on_way = start == nullptr ? distances : ways_beyond_master(model, pair, nodes, *start, x);
      for (std::size_t n = 0; n < nodes.size(); ++n) {
        if (start != nullptr && (!at_start[n] || -*at_start[n] > interface.reach())) continue;
        const double depth = distances[n] ? -*distances[n] : start == nullptr ? 0.0 : on_way[n].value_or(0.0);
        if (depth <= deepest) continue;
        deepest = depth;
        const SlaveNode& node = pair.slave_nodes()[nodes[n]];
        std::vector<double> place;
        for (int i = 0; i < model.dimension; ++i) place.push_back(positions(node.owned_node, i));
        failure = StepFailure(FailureKind::lost_contact,
                              fmt::format("contact \"{}\": node {} of the slave, which was {}, is at ({:.6g}), {:.3g} behind the master surface "
                                          "and out of its reach {:.3g}",
                                          pair.pair().definition().name, node.id, before, fmt::join(place, ", "), deepest, interface.reach()));
      }
    };
    if (all[3 * p] > 0.0) look_for(closed[p], "closed", nullptr);
    if (all[3 * p + 1] + all[3 * p + 2] > interface.reach())
      look_for(open[p], "in front of the master when the step began", accepted.positions.get());
  }
  return failure;
}

}  // namespace mortise::detail
