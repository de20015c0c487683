#include "pair_coupling.hpp"

#include <fmt/format.h>

#include <Tpetra_Import.hpp>
#include <Tpetra_MultiVector.hpp>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace mortise::detail {

PairCoupling::PairCoupling(RCP<const Map> owned_nodes, RCP<const MultiVector> reference, RCP<const MultiVector> fixed,
                           const InterfaceMeasure& measure, ContactPair pair)
    : pair_(std::move(pair)),
      owned_nodes_(std::move(owned_nodes)),
      reference_(std::move(reference)),
      dimension_(static_cast<int>(reference_->getNumVectors())) {
  interface_ = std::make_unique<MortarInterface>(owned_nodes_, reference_, std::move(fixed), pair_.slave, pair_.master, measure, pair_.options.mortar,
                                                 pair_.place);
  ties_ = MultiplierTies(slave_nodes(), pair_.slave, owned_nodes_->getComm());
  size_ = interface_->shortest_facet();
  refuse_constant_out_of_range();
  if (corner_rule() == CornerRule::master_normal) interface_->split_kinks(*reference_, {});
  rows_.resize(slave_nodes().size());
  if (variational()) openings_.resize(rows_.size());
  for (NodeRow& row : rows_) row.slip = TangentVector::Zero(dimension_ - 1);
  for (const SlaveNode& node : slave_nodes()) {
    const auto first_fixed = std::find(node.fixed.begin(), node.fixed.end(), true);
    axes_.push_back(node.partly_fixed() ? static_cast<int>(first_fixed - node.fixed.begin()) : -1);
  }
  regularisation_ = formulation().regularisation();
  if (regularisation_) {
    accepted_start_.assign(rows_.size(), {SpatialVector::Zero(dimension_)});
    start_ = accepted_start_;
  }
  if (!pair_.options.friction.options->acts()) return;
  friction_ = pair_.options.friction.options.get();
  slip_.resize(rows_.size());
}

// Newton's method finds gaps to about 1e-8 h and pressures to about 1e-8 E on its way, and pressures of 1e-4 E and gaps of 1e-4 h are to be told from
// 0. With c_n A_j = a E / h an error of the gap weighs 1e-8 a E beside such a pressure: a <= 1e4. An error of the pressure weighs 1e-8 E beside
// 1e-4 a E of such a gap: a >= 1e-4. Beyond, errors of the iteration would choose the active set.
void PairCoupling::refuse_constant_out_of_range() const {
  const auto& constant = pair_.options.complementarity_constant;
  if (!constant) return;
  constexpr double most = 1e4;
  const double facet = pair_.youngs_modulus / size_, least = facet / most, largest = most * facet;
  if (*constant >= least && *constant <= largest) return;
  throw InputError(
      pair_.place,
      fmt::format("\"complementarity constant\" is {:g}; allowed: {:.2g} to {:.2g}, as errors of the iteration would choose the active set "
                  "beyond; please take about Young's modulus over the side of a facet, here {:.2g}, or leave it out",
                  *constant, least, largest, facet));
}

double PairCoupling::complementarity_constant(std::size_t s) const {
  constexpr double zone = 0.1;  // a contact zone that gives way as a whole, or yields, is that much softer than a facet
  const double facet = pair_.youngs_modulus / size_;
  return pair_.options.complementarity_constant.value_or(regularisation_ ? zone * facet : facet) / slave_nodes()[s].weight;
}

bool PairCoupling::covered(std::size_t s) const {
  const SlaveNode& node = slave_nodes()[s];
  const bool dual = pair_.options.mortar.coupling == Coupling::dual_mortar;  // else int phi_j N_j may be negative on a part of a quadratic facet
  return node.carries_multiplier && (dual ? rows_[s].D : rows_[s].covered) > 0.0;
}

SpatialVector PairCoupling::resultant(std::size_t s, const SpatialVector& z) const {
  const SpatialVector coupled = rows_[s].covered * coupled_part(s, z);
  return variational() ? SpatialVector(coupled + gap_pressure(s, z) * openings_[s]) : coupled;
}

std::vector<GapCurvature> PairCoupling::gap_curvatures(const std::vector<double>& pressures) const {
  return frozen_ ? std::vector<GapCurvature>() : interface_->gap_curvatures(*local_positions_, pressures);
}

bool PairCoupling::closed(std::size_t s, const NodeMultiplier& multiplier) const {
  if (regularisation_) return complementarity(s, multiplier).state != ContactState::open;
  return covered(s) && multiplier.z.dot(rows_[s].normal) - complementarity_constant(s) * gap(s, multiplier) > 0.0;
}

double PairCoupling::gap(std::size_t s, const NodeMultiplier& multiplier) const {
  return multiplier.shift.size() == 0 ? own_gap(s) : own_gap(s) + rows_[s].normal.dot(multiplier.shift);
}

// u_j - (T_j q - T_j^old q^old): slips are those of the step, so what a tie bears is so too. With T_j q alone, a tied node that sticks would slip
// anew in each step by what its tie bears, until that bears nothing.
TangentVector PairCoupling::slip(std::size_t s, const NodeMultiplier& multiplier) const {
  TangentVector slip = rows_[s].slip;
  if (multiplier.shift.size() > 0) slip -= frame(s).tangents * multiplier.shift;
  if (friction_ != nullptr && slip_[s].start.tie.size() > 0) slip += slip_[s].start.tie;
  return slip;
}

// Of regularised conditions without history, lambda = 0:  (1 - theta) z_n > theta eps g / w  where  theta / (1 - theta) = c w / (eps A_j),  c = c_n
// A_j.
double PairCoupling::closing_pressure(std::size_t s) const { return complementarity_constant(s) * own_gap(s); }

// A component that is prescribed takes one tangent: there the node bears no shear traction.
Complementarity PairCoupling::complementarity(std::size_t s, const NodeMultiplier& multiplier, std::optional<Diagnostic>* missing_bound) const {
  Complementarity law = law_of(s, multiplier, missing_bound);
  if (multiplier.tie > 0.0) law.C_z += multiplier.tie * shift_factor(law, s);
  return law;
}

bool PairCoupling::rubs(std::size_t s) const {
  const SlaveNode& node = slave_nodes()[s];
  const auto fixed = std::count(node.fixed.begin(), node.fixed.end(), true);
  return friction_ != nullptr && !slip_[s].start.nodes.empty() && fixed < dimension_ - 1;
}

RegularisedNode PairCoupling::regularised_node(std::size_t s) const {
  const double scale = pair_.youngs_modulus / size_ * start_[s].stiffening * settling_.hardening, weight = slave_nodes()[s].weight;
  return {regularisation_->normal * scale, regularisation_->tangential * scale, complementarity_constant(s) * weight, weight, start_[s].multiplier};
}

Complementarity PairCoupling::law_of(std::size_t s, const NodeMultiplier& multiplier, std::optional<Diagnostic>* missing_bound) const {
  const NodeRow& row = rows_[s];
  const SpatialVector& z = multiplier.z;
  const SlaveNode& node = slave_nodes()[s];
  const auto fixed = std::count(node.fixed.begin(), node.fixed.end(), true);
  const bool rubs = this->rubs(s);
  const auto without_fixed = [&](Complementarity law, const Frame& in) {
    if (rubs && fixed > 0 && law.state != ContactState::open) hold_tangent(law, in, z, 0);
    return law;
  };
  const auto bound = [&](double pressure) {
    const double path = slip_[s].start.path;
    if (missing_bound != nullptr) *missing_bound = friction_->missing_bound(pressure, path);
    return friction_->bound(pressure, path);
  };
  // What the law of friction sees of slip and traction.
  TangentVector slip = this->slip(s, multiplier);
  const double gap = this->gap(s, multiplier);
  SpatialVector borne = z;
  if (regularisation_) {
    if (!covered(s)) return open_node(z);
    const Frame in = frame(s);
    if (rubs && fixed > 0) slip[0] = 0.0;
    return without_fixed(regularised(regularised_node(s), gap, slip, row.covered, in, z, rubs ? &bound : nullptr), in);
  }
  const double c = complementarity_constant(s);
  if (!closed(s, multiplier)) return open_node(z);
  const Frame in = frame(s);
  if (!rubs) return closed_node(c, gap, in, z);
  if (fixed > 0) {
    slip[0] = 0.0;
    borne -= in.tangents.row(0).dot(z) * in.tangents.row(0).transpose();
  }
  return without_fixed(with_friction(c, c, gap, slip, in, borne, bound(z.dot(row.normal) - c * gap)), in);
}

SpatialMatrix PairCoupling::shift_factor(const Complementarity& law, std::size_t s) const {
  SpatialMatrix factor = law.gap_factor * rows_[s].normal.transpose();
  if (law.slip_factor.size() > 0) factor.bottomRows(dimension_ - 1) -= law.slip_factor * frame(s).tangents;
  return factor;
}

// At fixed q:   d(n . q) = q . dn,   d(T q)_a = (turn_a^T q) . dn.
SpatialVector PairCoupling::constraint_gradient(const Complementarity& law, std::size_t s, std::size_t entry,
                                                const NodeMultiplier& multiplier) const {
  const NodeRow& row = rows_[s];
  const auto column = static_cast<Eigen::Index>(entry);
  SpatialVector gradient = law.gap_factor * row.dgap[entry] + law.normal_factor * row.dnormal.col(column);
  if (law.slip_factor.size() > 0) gradient.tail(dimension_ - 1) += law.slip_factor * row.dslip.col(column);
  if (regularisation_) gradient += law.weight_factor * row.dcovered[entry];
  if (multiplier.shift.size() == 0) return gradient;
  gradient += law.gap_factor * multiplier.shift.dot(row.dnormal.col(column));
  if (law.slip_factor.size() == 0) return gradient;
  const Frame in = frame(s);
  TangentVector turned(dimension_ - 1);
  for (Eigen::Index a = 0; a < turned.size(); ++a) turned[a] = multiplier.shift.dot(in.turn[a] * row.dnormal.col(column));
  gradient.tail(dimension_ - 1) -= law.slip_factor * turned;
  return gradient;
}

bool PairCoupling::search(const MultiVector& x) {
  if (frozen_) return false;
  const bool changed = interface_->search(uses_reference() ? *reference_ : x) || import_.is_null();
  if (changed) follow_pattern();
  return changed;
}

void PairCoupling::follow_pattern() {
  import_ = rcp(new Import(owned_nodes_, interface_->local_nodes()));
  local_positions_ = rcp(new MultiVector(interface_->local_nodes(), static_cast<std::size_t>(dimension_)));
  position_in_row_.assign(interface_->local_nodes()->getNodeNumElements(), -1);
  place_slip_histories();
}

CornerRule PairCoupling::corner_rule() const { return uses_reference() ? CornerRule::averaged : pair_.options.mortar.corner_rule(dimension_); }

// By the mean gap: phi_j sum to 1.
void PairCoupling::find_nearest_facets() {
  nearest_accepted_.assign(rows_.size(), {});
  std::vector<double> least(rows_.size(), std::numeric_limits<double>::max());
  for (const FacetCoupling& facet : couplings_) {
    const double distance = std::abs(facet.gap.sum() / facet.D.sum());
    for (const LocalOrdinal node : facet.slave) {
      const auto s = static_cast<std::size_t>(node);
      if (s >= rows_.size() || distance >= least[s]) continue;
      least[s] = distance;
      nearest_accepted_[s] = facet.slave;
    }
  }
}

void PairCoupling::accept_cover() {
  if (corner_rule() == CornerRule::nearest_facet) find_nearest_facets();
  mark_cover();
  accepted_covered_ = marked_covered_;
}

void PairCoupling::mark_cover() {
  marked_covered_.resize(rows_.size());
  for (std::size_t s = 0; s < rows_.size(); ++s) marked_covered_[s] = covered(s);
}

bool PairCoupling::adapt_surface(const MultiVector& x) {
  return corner_rule() != CornerRule::averaged && interface_->split_kinks(x, nearest_accepted_);  // the next search renews the pattern
}

void PairCoupling::evaluate(const MultiVector& x, bool derivatives, std::optional<StepFailure>& failure) {
  const bool reference = uses_reference();
  if (frozen_) {
    evaluate_frozen(x);
    return;
  }
  const bool slopes = derivatives || reference || variational();
  local_positions_->doImport(reference ? *reference_ : x, *import_, Tpetra::REPLACE);
  interface_->evaluate(*local_positions_, slopes, couplings_, normals_, failure);
  sum_to_rows(slopes);
  if (has_ties())
    ties_.measure(
        couplings_, slave_nodes(), [this](std::size_t s) { return covered(s); }, *interface_->local_nodes(), pair_.options.full_cover,
        size_ / pair_.youngs_modulus, dimension_, slopes && !reference);
  if (regularisation_ && derivatives && !reference) measure_covered();
  if (reference) {
    freeze();
    evaluate_frozen(x);
  } else if (friction_ != nullptr) {
    measure_slip(derivatives);
  }
}

void PairCoupling::sum_to_rows(bool derivatives) {
  const std::size_t slaves = rows_.size();
  std::vector<std::vector<std::pair<const FacetCoupling*, int>>> facets_of(slaves);
  for (const FacetCoupling& facet : couplings_)
    for (std::size_t j = 0; j < facet.slave.size(); ++j)
      if (static_cast<std::size_t>(facet.slave[j]) < slaves) facets_of[facet.slave[j]].push_back({&facet, static_cast<int>(j)});

  for (std::size_t s = 0; s < slaves; ++s) {
    const std::vector<LocalOrdinal>& coupled = interface_->coupled_nodes(s);
    NodeRow& row = rows_[s];
    row.D = row.covered = row.gap = 0.0;
    if (variational()) openings_[s] = SpatialVector::Zero(dimension_);
    row.coefficients.assign(coupled.size(), 0.0);
    row.dgap.assign(derivatives ? dimension_ * coupled.size() : 0, 0.0);
    row.dnormal.setZero(dimension_, derivatives ? dimension_ * static_cast<Eigen::Index>(coupled.size()) : 0);
    for (std::size_t c = 0; c < coupled.size(); ++c) position_in_row_[coupled[c]] = static_cast<LocalOrdinal>(c);
    const auto place = [&](LocalOrdinal node) {
      const LocalOrdinal found = position_in_row_[node];
      if (found < 0) throw std::logic_error("contact: a slave node is coupled with a node that is not in its pattern");
      return found;
    };

    for (const auto& [facet, j] : facets_of[s]) {
      row.D += facet->D(j, j);
      row.covered += facet->D.row(j).sum();
      for (int k = 0; k < static_cast<int>(facet->slave.size()); ++k)
        if (k != j && facet->D(j, k) != 0.0) row.coefficients[place(facet->slave[k])] += facet->D(j, k);
      for (std::size_t l = 0; l < facet->master.size(); ++l) row.coefficients[place(facet->master[l])] -= facet->M(j, l);
      row.gap += facet->gap(j);
      if (!derivatives) continue;
      for (std::size_t c = 0; c < facet->columns.size(); ++c)
        for (int i = 0; i < dimension_; ++i)
          row.dgap[dimension_ * place(facet->columns[c]) + i] += facet->dgap(j, dimension_ * static_cast<Eigen::Index>(c) + i);
      if (variational())  // master nodes are the last columns
        for (std::size_t c = facet->columns.size() - facet->master.size(); c < facet->columns.size(); ++c)
          openings_[s] += facet->dgap.block(j, dimension_ * static_cast<Eigen::Index>(c), 1, dimension_).transpose();
    }
    row.normal = normals_[s].normal;
    if (axes_[s] < 0) axes_[s] = transverse_axis(row.normal);
    if (derivatives)
      for (std::size_t c = 0; c < normals_[s].columns.size(); ++c)
        row.dnormal.middleCols(dimension_ * place(normals_[s].columns[c]), dimension_) +=
            normals_[s].derivative.middleCols(dimension_ * static_cast<Eigen::Index>(c), dimension_);
    for (const LocalOrdinal node : coupled) position_in_row_[node] = -1;
  }
}

void PairCoupling::measure_covered() {
  for (std::size_t s = 0; s < rows_.size(); ++s) rows_[s].dcovered.assign(dimension_ * interface_->coupled_nodes(s).size(), 0.0);
  for (const FacetCoupling& facet : couplings_) {
    const auto nodes = static_cast<Eigen::Index>(facet.slave.size());
    for (Eigen::Index j = 0; j < nodes; ++j) {
      const auto s = static_cast<std::size_t>(facet.slave[j]);
      if (s >= rows_.size()) continue;
      const std::vector<LocalOrdinal>& coupled = interface_->coupled_nodes(s);
      for (std::size_t c = 0; c < facet.columns.size(); ++c) {
        const auto place = std::lower_bound(coupled.begin(), coupled.end(), facet.columns[c]) - coupled.begin();
        for (int i = 0; i < dimension_; ++i)
          rows_[s].dcovered[dimension_ * place + i] += facet.dD.col(dimension_ * static_cast<Eigen::Index>(c) + i).segment(nodes * j, nodes).sum();
      }
    }
  }
}

void PairCoupling::choose_axes() {
  constexpr double nearly_parallel = 0.9;
  for (std::size_t s = 0; s < rows_.size(); ++s)
    if (axes_[s] >= 0 && !slave_nodes()[s].partly_fixed() && std::abs(rows_[s].normal[axes_[s]]) > nearly_parallel)
      axes_[s] = transverse_axis(rows_[s].normal);
}

// Small displacements: D, M and n are those of the reference configuration. With the multipliers' own functions as weights the gap is
//   g_j(u) = g_j(0) + n_j . (sum_l M_jl u_l - sum_k D_jk u_k),
// the transpose of the contact force of z_n n_j, so that the condensed operator of a symmetric bulk is symmetric. With standard weights
// it is the linearisation of the weighted gap.
void PairCoupling::freeze() {
  frozen_ = true;
  frozen_gap_.resize(rows_.size());
  const MortarOptions& options = pair_.options.mortar;
  const bool dual = options.coupling != Coupling::dual_mortar || options.gap_weighting == GapWeighting::dual;
  for (std::size_t s = 0; s < rows_.size(); ++s) {
    NodeRow& row = rows_[s];
    frozen_gap_[s] = row.gap;
    row.dnormal.setZero();
    if (variational()) openings_[s] = row.covered * row.normal;
    if (regularisation_) row.dcovered.assign(row.dgap.size(), 0.0);
    if (!dual) continue;
    const std::vector<LocalOrdinal>& coupled = interface_->coupled_nodes(s);
    for (std::size_t c = 0; c < coupled.size(); ++c) {
      const double own = coupled[c] == slave_nodes()[s].local_node ? row.D : 0.0;
      for (int i = 0; i < dimension_; ++i) row.dgap[dimension_ * c + i] = -row.normal[i] * (row.coefficients[c] + own);
    }
  }
  couplings_.clear();
}

void PairCoupling::evaluate_frozen(const MultiVector& x) {
  MultiVector displacement(x, Teuchos::Copy);
  displacement.update(-1.0, *reference_, 1.0);
  local_positions_->doImport(displacement, *import_, Tpetra::REPLACE);
  const auto u = local_positions_->getLocalViewHost(Tpetra::Access::ReadOnly);
  for (std::size_t s = 0; s < rows_.size(); ++s) {
    const std::vector<LocalOrdinal>& coupled = interface_->coupled_nodes(s);
    double gap = frozen_gap_[s];
    for (std::size_t c = 0; c < coupled.size(); ++c)
      for (int i = 0; i < dimension_; ++i) gap += rows_[s].dgap[dimension_ * c + i] * u(coupled[c], i);
    rows_[s].gap = gap;
  }
  if (friction_ == nullptr) return;
  local_positions_->doImport(x, *import_, Tpetra::REPLACE);
  measure_frozen_slip();
}

}  // namespace mortise::detail
