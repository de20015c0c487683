// Updates of augmented Lagrange: what they start from, how far the multipliers still are from their limit, and how fast they settle.

#include <Tpetra_Map.hpp>
#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <limits>
#include <optional>

#include "evaluated_contact.hpp"

namespace mortise {

namespace detail {

// Augmented Lagrange: a node moves by its force, z_n w, over a stiffness of the body. So its mean gap g / w answers to its traction by w / A_j times
// h/E, and where it is tied by sigma / w too. An update divides g / w by 1 + eps kappa h/E with kappa = w / A_j + sigma E / (h w): eps makes up for a
// small kappa.
RegularisedStart PairEvaluation::start_from(std::size_t s, const SpatialVector& z) const {
  RegularisedStart start{SpatialVector::Zero(dimension())};
  if (pair_->friction() != nullptr) start.multiplier.tail(dimension() - 1) = frame(s).tangents * z;
  if (pair_->regularisation()->augmentations == 0) return start;
  start.multiplier[0] = z.dot(row(s).normal);
  set_stiffness(s, start);
  return start;
}

void PairEvaluation::set_stiffness(std::size_t s, RegularisedStart& start) const {
  if (!covered(s)) return;
  const double covered = row(s).covered, tie = ties().compliance(s) * pair_->definition().youngs_modulus / (pair_->size() * covered);
  start.stiffening = 1.0 / std::min(1.0, covered / slave_nodes()[s].weight + tie);
}

double PairEvaluation::distance_to_return_map(std::size_t s, const NodeMultiplier& multiplier, const RegularisedNode& node) const {
  const bool has_friction = this->has_friction(s);
  const double path = has_friction ? history().slip->paths[s] : 0.0;
  const auto bound = [&](double pressure) { return pair_->friction()->bound(pressure, path); };
  TangentVector slip = has_friction ? this->slip(s, multiplier) : TangentVector(TangentVector::Zero(dimension() - 1));
  if (has_friction && slave_nodes()[s].partly_fixed()) slip[0] = 0.0;
  const Frame in = frame(s);
  SpatialVector distance = return_map(node, gap(s, multiplier), slip, row(s).covered, has_friction ? &bound : nullptr);
  distance[0] -= multiplier.z.dot(in.normal);
  if (has_friction)
    distance.tail(dimension() - 1) -= in.tangents * multiplier.z;
  else
    distance.tail(dimension() - 1).setZero();
  return distance.norm();
}

double PairEvaluation::mismatch(std::size_t s, const NodeMultiplier& multiplier) const {
  if (!covered(s)) return multiplier.z.norm();
  return distance_to_return_map(s, multiplier, regularised_node(s)) * row(s).covered / slave_nodes()[s].weight;
}

double PairEvaluation::change_of_update(std::size_t s, const NodeMultiplier& multiplier, double resolution) const {
  if (!covered(s)) return 0.0;
  RegularisedNode node = regularised_node(s);
  const Frame in = frame(s);
  node.multiplier[0] = multiplier.z.dot(in.normal);
  node.multiplier.tail(dimension() - 1) = in.tangents * multiplier.z;
  const double change = distance_to_return_map(s, multiplier, node);
  if (change <= resolution * std::max(node.normal_stiffness, node.tangential_stiffness)) return 0.0;
  return change * row(s).covered / slave_nodes()[s].weight;
}

double PairEvaluation::traction(std::size_t s, const NodeMultiplier& multiplier) const {
  return covered(s) ? multiplier.z.norm() * row(s).covered / slave_nodes()[s].weight : 0.0;
}

double PairEvaluation::mismatch_of(double resolution) const {
  double largest = 0.0;
  for (std::size_t s = 0; s < rows().size(); ++s) {
    if (!covered(s)) continue;
    const RegularisedNode node = regularised_node(s);
    largest = std::max(largest, std::max(node.normal_stiffness, node.tangential_stiffness) * row(s).covered / slave_nodes()[s].weight);
  }
  return largest * resolution;
}

// Bodies give way by a gap for a traction over k. An update adds eps g to the multipliers and divides gaps by 1 + eps/k = 1/q. With the change eps g
// that comes next, all that is still missing of the multipliers is
//   k g = eps g (q + q^2 + ...) = (k/eps) eps g,   k/eps = q / (1 - q).
// So slow updates have small changes and large errors. Changes that do not fall are those of nodes that change their states, or round-off: then at
// least the change itself is an error.
std::optional<double> error_of_multipliers(const Settling& settling, double change, int round) {
  if (change == 0.0) return 0.0;
  if (round > 1 && change < settling.last_change) return change * change / (settling.last_change - change);
  if (settling.ratio) return change * std::max(1.0, *settling.ratio);
  return std::nullopt;
}

// Where eps/k is less than `facet`, eps times facet k/eps makes it that. A ratio of two changes may be that of nodes that change their states: no
// more than tenfold at once. The solution does not depend on eps.
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
  const double resolution = model_->position_round_off();
  constexpr double known_to = 1e-9;  // of the largest multiplier of all pairs: to what Newton's method by default finds those of any pair
  std::vector<std::pair<std::size_t, double>> changes;  // of the augmented Lagrange pairs
  Augmentation result;
  double largest = 0.0;
  for (const auto& of_pair : at.multipliers)
    for (const detail::NodeMultiplier& multiplier : of_pair) largest = std::max(largest, multiplier.z.norm());
  largest = model_->maximum(largest);
  for (std::size_t p = 0; p < at.contact->pairs.size(); ++p) {
    const detail::PairEvaluation& pair = at.contact->pairs[p];
    if (!pair.pair().is_augmented()) continue;
    double change = 0.0, traction = 0.0;
    for (std::size_t s = 0; s < pair.rows().size(); ++s) {
      change = std::max(change, pair.change_of_update(s, at.multipliers[p][s], resolution));
      traction = std::max(traction, pair.traction(s, at.multipliers[p][s]));
    }
    change = model_->maximum(change);
    traction = model_->maximum(traction);
    changes.emplace_back(p, change);
    const Regularisation& regularisation = *pair.pair().regularisation();
    const std::optional<double> error = detail::error_of_multipliers(pair.history().settling, change, round);
    if (error && *error <= std::max(regularisation.tolerance * traction, known_to * largest)) continue;
    const double relative = error ? *error / traction : std::numeric_limits<double>::infinity();
    result.exhausted |= round > regularisation.augmentations;
    if (!result.more || relative > result.error) {
      result.error = relative;
      result.change = change / traction;
      result.tolerance = regularisation.tolerance;
      result.pair = pair.pair().definition().name;
    }
    result.more = true;
  }
  if (!result.more || result.exhausted) return result;
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
