#include "pair_coupling.hpp"

#include <Tpetra_Import.hpp>
#include <Tpetra_MultiVector.hpp>
#include <algorithm>
#include <cmath>

namespace mortise::detail {

PairCoupling::PairCoupling(RCP<const Map> owned_nodes, RCP<const MultiVector> reference, RCP<const MultiVector> fixed,
                           const InterfaceMeasure& measure, ContactPair pair)
    : pair_(std::move(pair)), owned_nodes_(std::move(owned_nodes)), reference_(std::move(reference)) {
  interface_ = std::make_unique<MortarInterface>(owned_nodes_, reference_, std::move(fixed), pair_.slave, pair_.master, measure, pair_.options.mortar,
                                                 pair_.place);
  size_ = interface_->shortest_facet();
  rows_.resize(slave_nodes().size());
  regularisation_ = formulation().regularisation();
  if (regularisation_) {
    accepted_multipliers_.assign(rows_.size(), Eigen::Vector2d::Zero());
    start_multipliers_ = accepted_multipliers_;
  }
  if (!pair_.options.friction.options->acts()) return;
  friction_ = pair_.options.friction.options.get();
  slip_.resize(rows_.size());
}

double PairCoupling::complementarity_constant(std::size_t s) const {
  return pair_.options.complementarity_constant.value_or(pair_.youngs_modulus / size_) / slave_nodes()[s].weight;
}

bool PairCoupling::covered(std::size_t s) const {
  const SlaveNode& node = slave_nodes()[s];
  return node.carries_multiplier && rows_[s].D > 1e-12 * node.weight;
}

bool PairCoupling::closed(std::size_t s, const Eigen::Vector2d& z) const {
  if (regularisation_) return complementarity(s, z).state != ContactState::open;
  return covered(s) && z.dot(rows_[s].normal) - complementarity_constant(s) * rows_[s].gap > 0.0;
}

Complementarity PairCoupling::complementarity(std::size_t s, const Eigen::Vector2d& z) const {
  const NodeRow& row = rows_[s];
  const SlaveNode& node = slave_nodes()[s];
  const bool rubs = friction_ != nullptr && !slip_[s].start.nodes.empty() && !node.fixed[0] && !node.fixed[1];
  if (regularisation_) {
    if (!covered(s)) return frictionless(false, 0.0, row.gap, row.normal, z);
    const double scale = pair_.youngs_modulus / size_;
    const RegularisedNode stiffness{regularisation_->normal * scale, regularisation_->tangential * scale, start_multipliers_[s]};
    const auto bound = [&](double pressure) { return friction_->bound(pressure, slip_[s].start.path); };
    return regularised(stiffness, row.gap, row.slip, row.covered, row.normal, z, rubs ? &bound : nullptr);
  }
  const double c = complementarity_constant(s);
  const bool is_closed = closed(s, z);
  if (!is_closed || !rubs) return frictionless(is_closed, c, row.gap, row.normal, z);
  return with_friction(c, c, row.gap, row.slip, row.normal, z, friction_->bound(z.dot(row.normal) - c * row.gap, slip_[s].start.path));
}

Eigen::Vector2d PairCoupling::constraint_gradient(const Complementarity& law, std::size_t s, std::size_t entry) const {
  const NodeRow& row = rows_[s];
  Eigen::Vector2d gradient = law.gap_factor * row.dgap[entry] + law.normal_factor * row.dnormal.col(static_cast<Eigen::Index>(entry));
  if (law.slip_factor != 0.0) gradient[1] += law.slip_factor * row.dslip[entry];
  if (regularisation_) gradient += law.weight_factor * row.dcovered[entry];
  return gradient;
}

bool PairCoupling::search(const MultiVector& x) {
  if (frozen_) return false;
  const bool changed = interface_->search(uses_reference() ? *reference_ : x) || import_.is_null();
  if (changed) {
    import_ = rcp(new Import(owned_nodes_, interface_->local_nodes()));
    local_positions_ = rcp(new MultiVector(interface_->local_nodes(), 2));
    position_in_row_.assign(interface_->local_nodes()->getNodeNumElements(), -1);
    place_slip_histories();
  }
  return changed;
}

void PairCoupling::evaluate(const MultiVector& x, bool derivatives, std::optional<StepFailure>& failure) {
  const bool reference = uses_reference();
  if (frozen_) {
    evaluate_frozen(x);
    return;
  }
  local_positions_->doImport(reference ? *reference_ : x, *import_, Tpetra::REPLACE);
  interface_->evaluate(*local_positions_, derivatives || reference, couplings_, normals_, failure);
  sum_to_rows(derivatives || reference);
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
    for (int j = 0; j < 2; ++j)
      if (static_cast<std::size_t>(facet.slave[j]) < slaves) facets_of[facet.slave[j]].push_back({&facet, j});

  for (std::size_t s = 0; s < slaves; ++s) {
    const std::vector<LocalOrdinal>& coupled = interface_->coupled_nodes(s);
    NodeRow& row = rows_[s];
    row.D = row.covered = row.gap = 0.0;
    row.coefficients.assign(coupled.size(), 0.0);
    row.dgap.assign(derivatives ? 2 * coupled.size() : 0, 0.0);
    row.dnormal.setZero(2, derivatives ? 2 * coupled.size() : 0);
    for (std::size_t c = 0; c < coupled.size(); ++c) position_in_row_[coupled[c]] = static_cast<LocalOrdinal>(c);

    for (const auto& [facet, j] : facets_of[s]) {
      row.D += facet->D(j, j);
      row.covered += facet->D.row(j).sum();
      if (facet->D(j, 1 - j) != 0.0) row.coefficients[position_in_row_[facet->slave[1 - j]]] += facet->D(j, 1 - j);
      for (std::size_t l = 0; l < facet->master.size(); ++l) row.coefficients[position_in_row_[facet->master[l]]] -= facet->M(j, l);
      row.gap += facet->gap(j);
      if (!derivatives) continue;
      for (std::size_t c = 0; c < facet->columns.size(); ++c)
        for (int i = 0; i < 2; ++i) row.dgap[2 * position_in_row_[facet->columns[c]] + i] += facet->dgap(j, 2 * c + i);
    }
    row.normal = normals_[s].normal;
    if (derivatives)
      for (std::size_t c = 0; c < normals_[s].columns.size(); ++c)
        row.dnormal.middleCols<2>(2 * position_in_row_[normals_[s].columns[c]]) += normals_[s].derivative.middleCols<2>(2 * c);
  }
}

void PairCoupling::measure_covered() {
  for (std::size_t s = 0; s < rows_.size(); ++s) rows_[s].dcovered.assign(2 * interface_->coupled_nodes(s).size(), 0.0);
  for (const FacetCoupling& facet : couplings_)
    for (int j = 0; j < 2; ++j) {
      const auto s = static_cast<std::size_t>(facet.slave[j]);
      if (s >= rows_.size()) continue;
      const std::vector<LocalOrdinal>& coupled = interface_->coupled_nodes(s);
      for (std::size_t c = 0; c < facet.columns.size(); ++c) {
        const auto place = std::lower_bound(coupled.begin(), coupled.end(), facet.columns[c]) - coupled.begin();
        for (int i = 0; i < 2; ++i) rows_[s].dcovered[2 * place + i] += facet.dD(2 * j, 2 * c + i) + facet.dD(2 * j + 1, 2 * c + i);
      }
    }
}

Eigen::Vector2d PairCoupling::in_frame(std::size_t s, const Eigen::Vector2d& z) const {
  const bool keeps_pressure = regularisation_->augmentations > 0;
  return {keeps_pressure ? z.dot(rows_[s].normal) : 0.0, friction_ != nullptr ? z.dot(tangent(rows_[s].normal)) : 0.0};
}

double PairCoupling::violation(std::size_t s, const Eigen::Vector2d& z) const {
  const NodeRow& row = rows_[s];
  const ContactState state = complementarity(s, z).state;
  if (state == ContactState::open) return 0.0;
  const double slip = state == ContactState::stick ? std::abs(row.slip) : 0.0;
  return std::max(std::abs(row.gap), slip) / (row.covered * size_);
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
    if (regularisation_) row.dcovered.assign(row.dgap.size(), 0.0);
    if (!dual) continue;
    const std::vector<LocalOrdinal>& coupled = interface_->coupled_nodes(s);
    for (std::size_t c = 0; c < coupled.size(); ++c) {
      const double own = coupled[c] == slave_nodes()[s].local_node ? row.D : 0.0;
      for (int i = 0; i < 2; ++i) row.dgap[2 * c + i] = -row.normal[i] * (row.coefficients[c] + own);
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
      for (int i = 0; i < 2; ++i) gap += rows_[s].dgap[2 * c + i] * u(coupled[c], i);
    rows_[s].gap = gap;
  }
  if (friction_ == nullptr) return;
  local_positions_->doImport(x, *import_, Tpetra::REPLACE);
  measure_frozen_slip();
}

}  // namespace mortise::detail
