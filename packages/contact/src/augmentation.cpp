// Updates of augmented Lagrange: what they start from, how far the multipliers still are from their limit, and how fast they settle.

#include <Tpetra_Map.hpp>
#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <limits>
#include <optional>

#include "implementation.hpp"

namespace mortise {

namespace detail {

// Augmented Lagrange: a node moves by its force, z_n w, over a stiffness of the body. So its mean gap g / w answers to its traction by w / A_j times
// h/E, and where it is tied by sigma / w too. An update divides g / w by 1 + eps kappa h/E with kappa = w / A_j + sigma E / (h w): eps makes up for a
// small kappa.
RegularisedStart PairCoupling::start_from(std::size_t s, const SpatialVector& z) const {
  RegularisedStart start{SpatialVector::Zero(dimension_)};
  if (friction_ != nullptr) start.multiplier.tail(dimension_ - 1) = frame(s).tangents * z;
  if (regularisation_->augmentations == 0) return start;
  start.multiplier[0] = z.dot(rows_[s].normal);
  set_stiffness(s, start);
  return start;
}

void PairCoupling::set_stiffness(std::size_t s, RegularisedStart& start) const {
  if (!covered(s)) return;
  const double covered = rows_[s].covered, tie = ties_.compliance(s) * pair_.youngs_modulus / (size_ * covered);
  start.stiffening = 1.0 / std::min(1.0, covered / slave_nodes()[s].weight + tie);
}

double PairCoupling::distance_to_return_map(std::size_t s, const NodeMultiplier& multiplier, const RegularisedNode& node) const {
  const bool rubs = this->rubs(s);
  const double path = rubs ? slip_[s].start.path : 0.0;
  const auto bound = [&](double pressure) { return friction_->bound(pressure, path); };
  TangentVector slip = rubs ? this->slip(s, multiplier) : TangentVector(TangentVector::Zero(dimension_ - 1));
  if (rubs && slave_nodes()[s].partly_fixed()) slip[0] = 0.0;
  const Frame in = frame(s);
  SpatialVector distance = return_map(node, gap(s, multiplier), slip, rows_[s].covered, rubs ? &bound : nullptr);
  distance[0] -= multiplier.z.dot(in.normal);
  if (rubs)
    distance.tail(dimension_ - 1) -= in.tangents * multiplier.z;
  else
    distance.tail(dimension_ - 1).setZero();
  return distance.norm();
}

double PairCoupling::mismatch(std::size_t s, const NodeMultiplier& multiplier) const {
  if (!covered(s)) return multiplier.z.norm();
  return distance_to_return_map(s, multiplier, regularised_node(s)) * rows_[s].covered / slave_nodes()[s].weight;
}

double PairCoupling::change_of_update(std::size_t s, const NodeMultiplier& multiplier, double resolution) const {
  if (!covered(s)) return 0.0;
  RegularisedNode node = regularised_node(s);
  const Frame in = frame(s);
  node.multiplier[0] = multiplier.z.dot(in.normal);
  node.multiplier.tail(dimension_ - 1) = in.tangents * multiplier.z;
  const double change = distance_to_return_map(s, multiplier, node);
  if (change <= resolution * std::max(node.normal_stiffness, node.tangential_stiffness)) return 0.0;
  return change * rows_[s].covered / slave_nodes()[s].weight;
}

double PairCoupling::traction(std::size_t s, const NodeMultiplier& multiplier) const {
  return covered(s) ? multiplier.z.norm() * rows_[s].covered / slave_nodes()[s].weight : 0.0;
}

double PairCoupling::mismatch_of(double resolution) const {
  double largest = 0.0;
  for (std::size_t s = 0; s < rows_.size(); ++s) {
    if (!covered(s)) continue;
    const RegularisedNode node = regularised_node(s);
    largest = std::max(largest, std::max(node.normal_stiffness, node.tangential_stiffness) * rows_[s].covered / slave_nodes()[s].weight);
  }
  return largest * resolution;
}

// Bodies give way by a gap for a traction over k. An update adds eps g to the multipliers and divides gaps by 1 + eps/k = 1/q. With the change eps g
// that comes next, all that is still missing of the multipliers is
//   k g = eps g (q + q^2 + ...) = (k/eps) eps g,   k/eps = q / (1 - q).
// So slow updates have small changes and large errors. Changes that do not fall are those of nodes that change their states, or round-off: then at
// least the change itself is an error.
std::optional<double> PairCoupling::error_of_multipliers(double change, int round) const {
  if (change == 0.0) return 0.0;
  if (round > 1 && change < last_change_) return change * change / (last_change_ - change);
  if (settling_.ratio) return change * std::max(1.0, *settling_.ratio);
  return std::nullopt;
}

// Where eps/k is less than `facet`, eps times facet k/eps makes it that. A ratio of two changes may be that of nodes that change their states: no
// more than tenfold at once. The solution does not depend on eps.
void PairCoupling::settle_stiffness(double change, int round) {
  constexpr double facet = 10.0;  // the default stiffness, over that of a body that gives way by h/E for its traction
  constexpr double most = 10.0;
  double factor = 1.0;
  if (round > 1 && change < last_change_) {
    const double ratio = change / (last_change_ - change);
    factor = std::clamp(facet * ratio, 1.0, most);
    settling_.ratio = ratio / factor;
  }
  settling_.hardening *= factor;
  last_change_ = factor * change;
}

}  // namespace detail

// Pairs act on one another through their bodies: if one goes on all do.
Augmentation ContactSystem::augment(const Vector& z, int round) {
  Implementation& self = *implementation_;
  const auto values = z.getLocalViewHost(Tpetra::Access::ReadOnly);
  const double resolution = self.position_round_off();
  constexpr double known_to = 1e-9;  // of the largest multiplier of all pairs: to what Newton's method by default finds those of any pair
  std::vector<std::pair<std::size_t, double>> changes;  // of the augmented Lagrange pairs
  Augmentation result;
  double largest = 0.0;
  for (std::size_t p = 0; p < self.pairs.size(); ++p)
    for (std::size_t s = 0; s < self.pairs[p]->rows().size(); ++s) largest = std::max(largest, self.z_of(values, p, s).norm());
  largest = self.maximum(largest);
  for (std::size_t p = 0; p < self.pairs.size(); ++p) {
    const detail::PairCoupling& pair = *self.pairs[p];
    if (!pair.regularisation() || pair.regularisation()->augmentations == 0) continue;
    double change = 0.0, traction = 0.0;
    const std::vector<detail::NodeMultiplier> multipliers = self.multipliers_of(values, p);
    for (std::size_t s = 0; s < pair.rows().size(); ++s) {
      change = std::max(change, pair.change_of_update(s, multipliers[s], resolution));
      traction = std::max(traction, pair.traction(s, multipliers[s]));
    }
    change = self.maximum(change);
    traction = self.maximum(traction);
    changes.emplace_back(p, change);
    const double tolerance = pair.regularisation()->tolerance;
    const std::optional<double> error = pair.error_of_multipliers(change, round);
    if (error && *error <= std::max(tolerance * traction, known_to * largest)) continue;
    const double relative = error ? *error / traction : std::numeric_limits<double>::infinity();
    result.exhausted |= round > pair.regularisation()->augmentations;
    if (!result.more || relative > result.error) {
      result.error = relative;
      result.change = change / traction;
      result.tolerance = tolerance;
      result.pair = pair.definition().name;
    }
    result.more = true;
  }
  if (!result.more || result.exhausted) return result;
  for (const auto& [p, change] : changes) {
    detail::PairCoupling& pair = *self.pairs[p];
    pair.settle_stiffness(change, round);
    for (std::size_t s = 0; s < pair.rows().size(); ++s) pair.augment(s, self.z_of(values, p, s));
  }
  return result;
}

}  // namespace mortise
