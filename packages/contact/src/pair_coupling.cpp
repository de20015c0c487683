#include "pair_coupling.hpp"

#include <Tpetra_Import.hpp>
#include <Tpetra_MultiVector.hpp>

namespace mortise::detail {

PairCoupling::PairCoupling(RCP<const Map> owned_nodes, RCP<const MultiVector> reference, RCP<const MultiVector> fixed,
                           const InterfaceMeasure& measure, ContactPair pair)
    : pair_(std::move(pair)), owned_nodes_(std::move(owned_nodes)), reference_(std::move(reference)) {
  interface_ = std::make_unique<MortarInterface>(owned_nodes_, reference_, std::move(fixed), pair_.slave, pair_.master, measure, pair_.options.mortar,
                                                 pair_.place);
  size_ = interface_->shortest_facet();
  rows_.resize(slave_nodes().size());
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
  return covered(s) && z.dot(rows_[s].normal) - complementarity_constant(s) * rows_[s].gap > 0.0;
}

Complementarity PairCoupling::complementarity(std::size_t s, const Eigen::Vector2d& z) const {
  const NodeRow& row = rows_[s];
  const double c = complementarity_constant(s);
  const bool is_closed = closed(s, z);
  const SlaveNode& node = slave_nodes()[s];
  if (!is_closed || friction_ == nullptr || slip_[s].start.nodes.empty() || node.fixed[0] || node.fixed[1])
    return frictionless(is_closed, c, row.gap, row.normal, z);
  return with_friction(c, c, row.gap, row.slip, row.normal, z, friction_->bound(z.dot(row.normal) - c * row.gap, slip_[s].start.path));
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
      row.coefficients[position_in_row_[facet->slave[1 - j]]] += facet->D(j, 1 - j);
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

// Small displacements: D, M and n are those of the reference configuration. With dual weights the gap is
//   g_j(u) = g_j(0) + n_j . (sum_l M_jl u_l - sum_k D_jk u_k),
// the transpose of the contact force of z_n n_j, so that the condensed operator of a symmetric bulk is symmetric. With standard weights
// it is the linearisation of the weighted gap.
void PairCoupling::freeze() {
  frozen_ = true;
  frozen_gap_.resize(rows_.size());
  const bool dual = pair_.options.mortar.gap_weighting == GapWeighting::dual;
  for (std::size_t s = 0; s < rows_.size(); ++s) {
    NodeRow& row = rows_[s];
    frozen_gap_[s] = row.gap;
    row.dnormal.setZero();
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
