#include "pairs/pair_evaluation.hpp"

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
  return covered(s) && may_close(s) && pair_->enforcement().is_closed(node(s, multiplier));
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

std::vector<double> PairEvaluation::mean_gaps() const {
  std::vector<double> gaps(slave_nodes().size(), 0.0);
  for (std::size_t s = 0; s < gaps.size(); ++s)
    if (covered(s)) gaps[s] = own_gap(s) / row(s).covered + gap_at_start(s);
  return gaps;
}

TangentVector PairEvaluation::slip_in_contact(std::size_t s, const NodeMultiplier& multiplier) const {
  const TangentVector whole = slip(s, multiplier);
  const double start = start_gap(s), c = constant(s);
  if (!(start > 0.0)) return whole;
  const TangentVector t = frame(s).tangents * multiplier.z;  // of a node without prescribed components
  const Landing landing(multiplier.z.dot(row(s).normal) - c * gap(s, multiplier), c * start);
  return (landing.share * (t + c * whole) - t) / c;
}

Complementarity PairEvaluation::complementarity(std::size_t s, const NodeMultiplier& multiplier, std::optional<Diagnostic>* missing_bound) const {
  Complementarity law = law_of(s, multiplier, missing_bound);
  if (multiplier.tie > 0.0) law.C_z += multiplier.tie * shift_factor(law, s);
  return law;
}

// One tangent for each component that is prescribed; the first has the axis of the first of these.
Eigen::Index PairEvaluation::held_tangents(std::size_t s) const {
  const SlaveNode& node = slave_nodes()[s];
  return std::count(node.fixed.begin(), node.fixed.end(), true);
}

FrictionPoint PairEvaluation::friction_point(std::size_t s, double pressure) const {
  FrictionPoint point{pressure, history().slip->paths[s]};
  if (!history().temperatures.empty()) point.temperature = history().temperatures[s];
  return point;
}

// Of a node that was not covered the gap at the start is that of the surfaces alone. One that was covered slips from the start of the step on. Where
// it is about to close it holds its body along the surface from the first iterate on, when it bears no pressure yet.
double PairEvaluation::start_gap(std::size_t s) const {
  const NodeSlip& slip = geometry_->slips[s];
  if (!history().slip->nodes[s].empty()) return slip.start_gap;
  if (history().slip->gaps[s] < 0.0) return 0.0;
  return std::max(
      0.0, slip.start_gap + (clearance(s) + pair_->enforcement().onset()) * row(s).covered + history().allowed_overlap * slave_nodes()[s].weight);
}

// A node that moves along what holds it sticks by a spring a hundred times as stiff as a facet.
ContactNode PairEvaluation::node(std::size_t s, const NodeMultiplier& multiplier, std::optional<Diagnostic>* missing_bound) const {
  constexpr double of_held = 0.01;
  const SlaveNode& slave = slave_nodes()[s];
  ContactNode node;
  node.z = multiplier.z;
  node.normal = row(s).normal;
  node.axis = history().axes[s];
  node.gap = gap(s, multiplier);
  node.weight = row(s).covered;
  node.full_weight = slave.weight;
  node.constant = constant(s);
  node.youngs_modulus = pair_->definition().youngs_modulus;
  node.size = pair_->size();
  node.tie = ties().compliance(s);
  if (history().slip != nullptr) {
    node.friction = NodeFriction{pair_->friction(), friction_point(s, 0.0), missing_bound};
    node.slip = slip(s, multiplier);
    node.start_gap = start_gap(s);
    node.held.count = held_tangents(s);
    if (node.held.count > 0) {
      node.held.traction = TangentVector::Zero(dimension() - 1);
      if (const TangentVector& old = history().slip->tractions[s]; old.size() > 0)
        node.held.traction.head(node.held.count) = old.head(node.held.count);
      for (Eigen::Index a = 0; a < node.held.count; ++a)
        if (geometry_->slips[s].rests[static_cast<std::size_t>(a)])
          node.slip[a] = 0.0;
        else
          node.held.compliance = of_held;
    }
  } else {
    node.slip = TangentVector::Zero(dimension() - 1);
  }
  if (!history().starts.empty()) node.start = &history().starts[s];
  node.hardening = history().settling.hardening;
  return node;
}

Complementarity PairEvaluation::law_of(std::size_t s, const NodeMultiplier& multiplier, std::optional<Diagnostic>* missing_bound) const {
  if (!covered(s) || !may_close(s)) return open_node(multiplier.z);
  const ContactNode node = this->node(s, multiplier, missing_bound);
  Complementarity law = pair_->enforcement().law(node);
  for (Eigen::Index a = 0; a < node.held.count && law.slip_factor.size() > 0; ++a)
    if (geometry_->slips[s].rests[static_cast<std::size_t>(a)]) law.slip_factor.col(a).setZero();
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
  if (!row.dcovered.empty()) gradient += (law.weight_factor + offset(s) * law.gap_factor) * row.dcovered[entry];
  if (law.start_factor.size() > 0 && !geometry_->slips[s].dstart_gap.empty()) {
    double slope = geometry_->slips[s].dstart_gap[entry];
    if (!row.dcovered.empty()) slope += (clearance(s) + pair_->enforcement().onset()) * row.dcovered[entry];
    gradient.tail(dimension() - 1) += slope * law.start_factor;
  }
  if (multiplier.shift.size() == 0) return gradient;
  gradient += law.gap_factor * multiplier.shift.dot(row.dnormal.col(column));
  if (law.slip_factor.size() == 0) return gradient;
  const Frame in = frame(s);
  TangentVector turned(dimension() - 1);
  for (Eigen::Index a = 0; a < turned.size(); ++a) turned[a] = multiplier.shift.dot(in.turn[a] * row.dnormal.col(column));
  gradient.tail(dimension() - 1) -= law.slip_factor * turned;
  return gradient;
}

// Path: |u_j| over the weight that it carries. One that came from a gap and sticks has moved before it touched.
double PairEvaluation::slip_path(std::size_t s, ContactState state) const {
  const SlipReferences& start = *history().slip;
  if (state == ContactState::open || (state == ContactState::stick && start_gap(s) > 0.0)) return start.paths[s];
  return start.paths[s] + geometry_->slips[s].slip.norm() / row(s).covered;
}

// Couplings of a node that is hardly covered are no measure of what it faces at the end of the next step. A slip would have next to no weight beside
// the error of sum_m c_jm x_m from gaps that vary along a facet.
std::shared_ptr<const SlipReferences> PairEvaluation::slip_references(const std::vector<NodeMultiplier>& multipliers,
                                                                      const std::vector<ContactState>& states, std::vector<double> paths,
                                                                      const RCP<const MultiVector>& start) const {
  const auto x = geometry_->positions->getLocalViewHost(Tpetra::Access::ReadOnly);
  const std::size_t count = slave_nodes().size();
  constexpr double hardly = 0.1;  // of its weight; where edges meet at a node a quarter is covered, or more
  const auto references = std::make_shared<SlipReferences>();
  references->nodes.resize(count);
  references->coefficients.resize(count);
  references->positions.resize(count);
  references->ties.resize(count);
  references->gaps.resize(count);
  references->tractions.resize(count);
  references->start = start;
  references->paths = std::move(paths);
  for (std::size_t s = 0; s < count; ++s) {
    if (!covered(s)) continue;
    const Frame in = frame(s);
    const bool compares = pair_->uses_reference() || row(s).covered >= hardly * slave_nodes()[s].weight;
    if (!compares) references->gaps[s] = -1.0;
    if (states[s] != ContactState::open && slave_nodes()[s].partly_fixed()) references->tractions[s] = in.tangents * multipliers[s].z;
    if (states[s] != ContactState::open && multipliers[s].shift.size() > 0) references->ties[s] = in.tangents * multipliers[s].shift;
    if (!compares) continue;
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
