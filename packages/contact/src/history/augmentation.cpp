// Updates of multipliers: what they start from, how far the multipliers still are from their limit, and how fast they settle.

#include <Tpetra_Map.hpp>
#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <limits>
#include <optional>

#include "evaluation/arguments.hpp"
#include "evaluation/evaluated_contact.hpp"

namespace mortise {

namespace detail {

NodeStart PairEvaluation::start_from(std::size_t s, const SpatialVector& z) const {
  SpatialVector traction = SpatialVector::Zero(dimension());
  traction[0] = z.dot(row(s).normal);
  if (pair_->friction() != nullptr) traction.tail(dimension() - 1) = frame(s).tangents * z;
  NodeStart start{pair_->enforcement().start_from(traction)};
  set_stiffness(s, start);
  return start;
}

void PairEvaluation::set_stiffness(std::size_t s, NodeStart& start) const {
  if (covered(s)) start.stiffening = pair_->enforcement().stiffening(unloaded_node(s));
}

double PairEvaluation::distance_to_return_map(const ContactNode& node) const {
  SpatialVector distance = pair_->enforcement().return_map(node);
  distance[0] -= node.z.dot(node.normal);
  if (node.friction)
    distance.tail(dimension() - 1) -= node.frame().tangents * node.z;
  else
    distance.tail(dimension() - 1).setZero();
  return distance.norm();
}

double PairEvaluation::mismatch(std::size_t s, const NodeMultiplier& multiplier) const {
  if (!covered(s)) return multiplier.z.norm();
  return distance_to_return_map(node(s, multiplier)) * row(s).covered / slave_nodes()[s].weight;
}

double PairEvaluation::change_of_update(std::size_t s, const NodeMultiplier& multiplier, double resolution) const {
  if (!covered(s)) return 0.0;
  ContactNode node = this->node(s, multiplier);
  NodeStart start = history().starts[s];
  start.multiplier[0] = node.z.dot(node.normal);
  start.multiplier.tail(dimension() - 1) = node.frame().tangents * node.z;
  node.start = &start;
  const double change = distance_to_return_map(node);
  if (change <= resolution * pair_->enforcement().stiffness(node)) return 0.0;
  return change * row(s).covered / slave_nodes()[s].weight;
}

double PairEvaluation::traction(std::size_t s, const NodeMultiplier& multiplier) const {
  return covered(s) ? multiplier.z.norm() * row(s).covered / slave_nodes()[s].weight : 0.0;
}

double PairEvaluation::mismatch_of(double resolution) const {
  double largest = 0.0;
  for (std::size_t s = 0; s < rows().size(); ++s) {
    if (!covered(s)) continue;
    const ContactNode node = unloaded_node(s);
    largest = std::max(largest, pair_->enforcement().stiffness(node) * node.weight / node.full_weight);
  }
  return largest * resolution;
}

// Bodies give way by a gap for a traction over k. An update adds eps g to the multipliers and divides gaps by 1 + eps/k = 1/q. The change eps g
// comes next. All that is still missing of the multipliers is
//   k g = eps g (q + q^2 + ...) = (k/eps) eps g,   k/eps = q / (1 - q).
// So slow updates have small changes and large errors. Changes that do not fall are those of nodes that change their states, or round-off: then at
// least the change itself is an error.
std::optional<double> error_of_multipliers(const Settling& settling, double change, int round) {
  if (change == 0.0) return 0.0;
  if (round > 1 && change < settling.last_change) return change * change / (settling.last_change - change);
  if (settling.ratio) return change * std::max(1.0, *settling.ratio);
  return std::nullopt;
}

// Where eps/k is less than `facet`, eps times facet k/eps makes it that. A ratio of two changes may be that of nodes that change their states: at
// most tenfold at once. The solution does not depend on eps.
Settling settled(const Settling& settling, double change, int round) {
  Settling next = settling;
  constexpr double facet = 10.0;  // the default stiffness, over that of a body that gives way by h/E for its traction
  constexpr double most = 10.0;
  double factor = 1.0;
  if (round > 1 && change < settling.last_change) {
    const double ratio = change / (settling.last_change - change);
    factor = std::clamp(facet * ratio, 1.0, most);
    next.ratio = ratio / factor;
  }
  next.hardening *= factor;
  next.last_change = factor * change;
  return next;
}

}  // namespace detail

// Pairs act on one another through their bodies: if one goes on all do.
Augmentation ContactSystem::augment(const ContactLaws& laws, int round) const {
  const detail::EvaluatedLaws& at = detail::evaluated(laws);
  detail::require_own(*model_, *at.contact->model, "augment");
  const double resolution = model_->position_round_off();
  constexpr double known_to = 1e-9;  // of the largest multiplier of all pairs: to what Newton's method by default finds those of any pair
  std::vector<std::pair<std::size_t, double>> changes;  // of the pairs with updates
  Augmentation result;
  double largest = 0.0;
  for (const auto& of_pair : at.multipliers)
    for (const detail::NodeMultiplier& multiplier : of_pair) largest = std::max(largest, multiplier.z.norm());
  largest = model_->maximum(largest);
  for (std::size_t p = 0; p < at.contact->pairs.size(); ++p) {
    const detail::PairEvaluation& pair = at.contact->pairs[p];
    const std::optional<MultiplierUpdates> updates = pair.pair().enforcement().updates();
    if (!updates) continue;
    double change = 0.0, traction = 0.0;
    for (std::size_t s = 0; s < pair.rows().size(); ++s) {
      change = std::max(change, pair.change_of_update(s, at.multipliers[p][s], resolution));
      traction = std::max(traction, pair.traction(s, at.multipliers[p][s]));
    }
    change = model_->maximum(change);
    traction = model_->maximum(traction);
    changes.emplace_back(p, change);
    const std::optional<double> error = detail::error_of_multipliers(pair.history().settling, change, round);
    if (error && *error <= std::max(updates->tolerance * traction, known_to * largest)) continue;
    const double relative = error ? *error / traction : std::numeric_limits<double>::infinity();
    result.exhausted |= round > updates->most;
    if (!result.more || relative > result.error) {
      result.error = relative;
      result.change = change / traction;
      result.tolerance = updates->tolerance;
      result.pair = pair.pair().definition().name;
    }
    result.more = true;
  }
  result.more = result.more && !result.exhausted;
  if (!result.more) return result;
  AcceptedContact updated = *at.contact->history;
  for (const auto& [p, change] : changes) {
    updated.pairs[p].settling = detail::settled(updated.pairs[p].settling, change, round);
    for (std::size_t s = 0; s < updated.pairs[p].starts.size(); ++s)
      updated.pairs[p].starts[s] = at.contact->pairs[p].start_from(s, at.multipliers[p][s].z);
  }
  result.history.emplace(std::move(updated));
  return result;
}

}  // namespace mortise
