#include "pair_evaluation.hpp"

#include <Tpetra_Map.hpp>
#include <Tpetra_MultiVector.hpp>
#include <algorithm>
#include <limits>

namespace mortise::detail {

SpatialVector PairEvaluation::resultant(std::size_t s, const SpatialVector& z) const {
  const SpatialVector coupled = row(s).covered * coupled_part(s, z);
  return pair_->has_forces_of_gaps() ? SpatialVector(coupled + gap_pressure(s, z) * row(s).opening) : coupled;
}

bool PairEvaluation::closed(std::size_t s, const NodeMultiplier& multiplier) const {
  return covered(s) && pair_->enforcement().is_closed(node(s, multiplier));
}

double PairEvaluation::gap(std::size_t s, const NodeMultiplier& multiplier) const {
  return multiplier.shift.size() == 0 ? own_gap(s) : own_gap(s) + row(s).normal.dot(multiplier.shift);
}

// u_j - (T_j q - T_j^old q^old): slips are those of the step, so what a tie bears is so too. With T_j q alone, a tied node that sticks would slip
// anew in each step by what its tie bears, until that bears nothing.
TangentVector PairEvaluation::slip(std::size_t s, const NodeMultiplier& multiplier) const {
  if (history().slip == nullptr) return TangentVector::Zero(dimension() - 1);
  TangentVector slip = geometry_->slips[s].slip;
  if (multiplier.shift.size() > 0) slip -= frame(s).tangents * multiplier.shift;
  if (const TangentVector& tie = history().slip->ties[s]; tie.size() > 0) slip += tie;
  return slip;
}

// A component that is prescribed takes one tangent: there the node bears no shear traction.
Complementarity PairEvaluation::complementarity(std::size_t s, const NodeMultiplier& multiplier, std::optional<Diagnostic>* missing_bound) const {
  Complementarity law = law_of(s, multiplier, missing_bound);
  if (multiplier.tie > 0.0) law.C_z += multiplier.tie * shift_factor(law, s);
  return law;
}

bool PairEvaluation::has_friction(std::size_t s) const {
  const SlaveNode& node = slave_nodes()[s];
  const auto fixed = std::count(node.fixed.begin(), node.fixed.end(), true);
  return history().slip != nullptr && !history().slip->nodes[s].empty() && fixed < dimension() - 1;
}

ContactNode PairEvaluation::node(std::size_t s, const NodeMultiplier& multiplier, std::optional<Diagnostic>* missing_bound) const {
  const SlaveNode& slave = slave_nodes()[s];
  ContactNode node;
  node.z = multiplier.z;
  node.normal = row(s).normal;
  node.axis = history().axes[s];
  node.gap = gap(s, multiplier);
  node.weight = row(s).covered;
  node.full_weight = slave.weight;
  node.constant = pair_->complementarity_constant(s);
  node.youngs_modulus = pair_->definition().youngs_modulus;
  node.size = pair_->size();
  node.tie = ties().compliance(s);
  if (has_friction(s)) {
    node.friction = NodeFriction{pair_->friction(), history().slip->paths[s], missing_bound};
    node.holds_first_tangent = slave.partly_fixed();
    node.slip = slip(s, multiplier);
    if (node.holds_first_tangent) node.slip[0] = 0.0;
  } else {
    node.slip = TangentVector::Zero(dimension() - 1);
  }
  if (!history().starts.empty()) node.start = &history().starts[s];
  node.hardening = history().settling.hardening;
  return node;
}

Complementarity PairEvaluation::law_of(std::size_t s, const NodeMultiplier& multiplier, std::optional<Diagnostic>* missing_bound) const {
  if (!covered(s)) return open_node(multiplier.z);
  const ContactNode node = this->node(s, multiplier, missing_bound);
  Complementarity law = pair_->enforcement().law(node);
  if (node.holds_first_tangent && law.state != ContactState::open) hold_tangent(law, node.frame(), node.z, 0);
  return law;
}

SpatialMatrix PairEvaluation::shift_factor(const Complementarity& law, std::size_t s) const {
  SpatialMatrix factor = law.gap_factor * row(s).normal.transpose();
  if (law.slip_factor.size() > 0) factor.bottomRows(dimension() - 1) -= law.slip_factor * frame(s).tangents;
  return factor;
}

// At fixed q:   d(n . q) = q . dn,   d(T q)_a = (turn_a^T q) . dn.
SpatialVector PairEvaluation::constraint_gradient(const Complementarity& law, std::size_t s, std::size_t entry,
                                                  const NodeMultiplier& multiplier) const {
  const NodeRow& row = this->row(s);
  const auto column = static_cast<Eigen::Index>(entry);
  SpatialVector gradient = law.gap_factor * row.dgap[entry] + law.normal_factor * row.dnormal.col(column);
  if (law.slip_factor.size() > 0) gradient.tail(dimension() - 1) += law.slip_factor * geometry_->slips[s].dslip.col(column);
  if (!row.dcovered.empty()) gradient += (law.weight_factor + clearance(s) * law.gap_factor) * row.dcovered[entry];
  if (multiplier.shift.size() == 0) return gradient;
  gradient += law.gap_factor * multiplier.shift.dot(row.dnormal.col(column));
  if (law.slip_factor.size() == 0) return gradient;
  const Frame in = frame(s);
  TangentVector turned(dimension() - 1);
  for (Eigen::Index a = 0; a < turned.size(); ++a) turned[a] = multiplier.shift.dot(in.turn[a] * row.dnormal.col(column));
  gradient.tail(dimension() - 1) -= law.slip_factor * turned;
  return gradient;
}

// Path: |u_j| over the weight that it carries.
double PairEvaluation::slip_path(std::size_t s, ContactState state) const {
  const SlipReferences& start = *history().slip;
  if (state == ContactState::open || start.nodes[s].empty()) return start.paths[s];
  return start.paths[s] + geometry_->slips[s].slip.norm() / row(s).covered;
}

std::shared_ptr<const SlipReferences> PairEvaluation::slip_references(const std::vector<NodeMultiplier>& multipliers,
                                                                      const std::vector<ContactState>& states, std::vector<double> paths) const {
  const auto x = geometry_->positions->getLocalViewHost(Tpetra::Access::ReadOnly);
  const std::size_t count = slave_nodes().size();
  const auto references = std::make_shared<SlipReferences>();
  references->nodes.resize(count);
  references->coefficients.resize(count);
  references->positions.resize(count);
  references->ties.resize(count);
  references->paths = std::move(paths);
  for (std::size_t s = 0; s < count; ++s) {
    if (!covered(s)) continue;
    const Frame in = frame(s);
    if (states[s] != ContactState::open && multipliers[s].shift.size() > 0) references->ties[s] = in.tangents * multipliers[s].shift;
    if (pair_->uses_reference()) references->positions[s] = TangentVector::Zero(dimension() - 1);
    const std::vector<LocalOrdinal>& coupled = coupled_nodes(s);
    for (std::size_t c = 0; c < coupled.size(); ++c) {
      const double coefficient = this->coefficient(s, c);
      if (coefficient == 0.0) continue;
      references->nodes[s].push_back(local_nodes().getGlobalElement(coupled[c]));
      references->coefficients[s].push_back(coefficient);
      if (!pair_->uses_reference()) continue;
      SpatialVector position(dimension());
      for (int i = 0; i < dimension(); ++i) position[i] = x(coupled[c], i);
      references->positions[s] += coefficient * (in.tangents * position);
    }
  }
  return references;
}

// By the mean gap: phi_j sum to 1.
std::vector<SurfaceFacet> PairEvaluation::nearest_facets() const {
  std::vector<SurfaceFacet> nearest(rows().size());
  std::vector<double> least(rows().size(), std::numeric_limits<double>::max());
  for (const FacetCoupling& facet : couplings()) {
    const double distance = std::abs(facet.gap.sum() / facet.D.sum());
    for (const LocalOrdinal node : facet.slave) {
      const auto s = static_cast<std::size_t>(node);
      if (s >= rows().size() || distance >= least[s]) continue;
      least[s] = distance;
      nearest[s].clear();
      for (const LocalOrdinal one : facet.slave) nearest[s].push_back(local_nodes().getGlobalElement(one));
    }
  }
  return nearest;
}

std::vector<int> PairEvaluation::choose_axes() const {
  constexpr double nearly_parallel = 0.9;
  std::vector<int> axes = history().axes;
  for (std::size_t s = 0; s < axes.size(); ++s) {
    const SpatialVector& normal = row(s).normal;
    if (axes[s] < 0 || (!slave_nodes()[s].partly_fixed() && std::abs(normal[axes[s]]) > nearly_parallel)) axes[s] = transverse_axis(normal);
  }
  return axes;
}

}  // namespace mortise::detail
