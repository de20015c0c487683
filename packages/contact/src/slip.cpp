// Slip of the slave nodes of a pair with friction, since the start of the step.

#include <Tpetra_Import.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_MultiVector.hpp>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "pair_coupling.hpp"

namespace mortise::detail {

namespace {
template <class View>
SpatialVector position_of(const View& x, LocalOrdinal node, int dimension) {
  SpatialVector position(dimension);
  for (int i = 0; i < dimension; ++i) position[i] = x(node, i);
  return position;
}
}  // namespace

void PairCoupling::place_slip_histories() {
  for (std::size_t s = 0; s < slip_.size(); ++s) {
    const std::vector<LocalOrdinal>& coupled = interface_->coupled_nodes(s);
    SlipHistory& history = slip_[s];
    history.places.clear();
    for (const GlobalOrdinal id : history.start.nodes) {
      const LocalOrdinal node = interface_->local_nodes()->getLocalElement(id);
      const auto found = std::lower_bound(coupled.begin(), coupled.end(), node);
      if (node < 0 || found == coupled.end() || *found != node)
        throw std::logic_error("contact: a node that a slip is measured against is not in the pattern");
      history.places.push_back(static_cast<LocalOrdinal>(found - coupled.begin()));
    }
  }
}

void PairCoupling::take_slip_reference(const std::vector<NodeMultiplier>& multipliers, const std::vector<ContactState>& states) {
  const auto x = local_positions_->getLocalViewHost(Tpetra::Access::ReadOnly);
  for (std::size_t s = 0; s < slip_.size(); ++s) {
    SlipReference& reference = slip_[s].accepted;
    const NodeRow& row = rows_[s];
    const std::vector<LocalOrdinal>& coupled = interface_->coupled_nodes(s);
    reference.nodes.clear();
    reference.coefficients.clear();
    reference.position = TangentVector::Zero(dimension_ - 1);
    reference.tie.resize(0);
    if (!covered(s)) continue;
    const Frame in = frame(s);
    if (states[s] != ContactState::open && multipliers[s].shift.size() > 0) reference.tie = in.tangents * multipliers[s].shift;
    for (std::size_t c = 0; c < coupled.size(); ++c) {
      const double coefficient = row.coefficients[c] + (coupled[c] == slave_nodes()[s].local_node ? row.D : 0.0);
      if (coefficient == 0.0) continue;
      reference.nodes.push_back(interface_->local_nodes()->getGlobalElement(coupled[c]));
      reference.coefficients.push_back(coefficient);
      reference.position += coefficient * (in.tangents * position_of(x, coupled[c], dimension_));
    }
  }
}

void PairCoupling::start_step() {
  start_ = accepted_start_;
  settling_ = accepted_settling_;
  marked_covered_ = accepted_covered_;
  if (regularisation_ && regularisation_->augmentations > 0)
    for (std::size_t s = 0; s < start_.size(); ++s) set_stiffness(s, start_[s]);
  if (friction_ == nullptr) return;
  std::vector<std::vector<GlobalOrdinal>> retained(slip_.size());
  for (std::size_t s = 0; s < slip_.size(); ++s) {
    slip_[s].start = slip_[s].accepted;
    retained[s] = slip_[s].start.nodes;
  }
  interface_->retain(std::move(retained));
  place_slip_histories();
}

// u_j = -T_j w,  w = sum_m (c_jm - c_jm^old) x_m, the rows of T_j the tangents tau_a. With d(tau_a) . w = (turn_a^T w) . dn
//   du_j = -dT_j w - T_j sum_m (dc_jm x_m + (c_jm - c_jm^old) dx_m).
void PairCoupling::measure_slip(bool derivatives) {
  ++slip_evaluations_;
  const auto x = local_positions_->getLocalViewHost(Tpetra::Access::ReadOnly);
  const auto position = [&](LocalOrdinal node) { return position_of(x, node, dimension_); };
  const Eigen::Index tangents = dimension_ - 1;
  for (std::size_t s = 0; s < slip_.size(); ++s) {
    NodeRow& row = rows_[s];
    const SlipReference& start = slip_[s].start;
    const std::vector<LocalOrdinal>& coupled = interface_->coupled_nodes(s);
    row.slip.setZero();
    row.dslip.setZero(tangents, derivatives ? dimension_ * static_cast<Eigen::Index>(coupled.size()) : 0);
    if (start.nodes.empty() || !covered(s)) continue;
    std::vector<double> change = row.coefficients;
    for (std::size_t c = 0; c < coupled.size(); ++c)
      if (coupled[c] == slave_nodes()[s].local_node) change[c] += row.D;
    for (std::size_t n = 0; n < start.nodes.size(); ++n) change[slip_[s].places[n]] -= start.coefficients[n];
    SpatialVector w = SpatialVector::Zero(dimension_);
    for (std::size_t c = 0; c < coupled.size(); ++c) w += change[c] * position(coupled[c]);
    const Frame in = frame(s);
    row.slip = -in.tangents * w;
    if (!derivatives) continue;
    for (Eigen::Index a = 0; a < tangents; ++a) row.dslip.row(a) = -(w.transpose() * in.turn[a]) * row.dnormal;
    for (std::size_t c = 0; c < coupled.size(); ++c)
      row.dslip.middleCols(dimension_ * static_cast<Eigen::Index>(c), dimension_) -= change[c] * in.tangents;
  }
  if (!derivatives) return;
  // The facets' derivatives of D and M.
  for (const FacetCoupling& facet : couplings_) {
    const auto nodes = static_cast<Eigen::Index>(facet.slave.size()), masters = static_cast<Eigen::Index>(facet.master.size());
    for (Eigen::Index j = 0; j < nodes; ++j) {
      const auto s = static_cast<std::size_t>(facet.slave[j]);
      if (s >= slip_.size() || slip_[s].start.nodes.empty() || !covered(s)) continue;
      const Frame in = frame(s);
      Eigen::MatrixXd gradient = Eigen::MatrixXd::Zero(tangents, dimension_ * static_cast<Eigen::Index>(facet.columns.size()));
      for (Eigen::Index k = 0; k < nodes; ++k) gradient -= (in.tangents * position(facet.slave[k])) * facet.dD.row(nodes * j + k);
      for (Eigen::Index l = 0; l < masters; ++l) gradient += (in.tangents * position(facet.master[l])) * facet.dM.row(j * masters + l);
      const std::vector<LocalOrdinal>& coupled = interface_->coupled_nodes(s);
      for (std::size_t c = 0; c < facet.columns.size(); ++c) {
        const auto place = std::lower_bound(coupled.begin(), coupled.end(), facet.columns[c]) - coupled.begin();
        rows_[s].dslip.middleCols(dimension_ * place, dimension_) += gradient.middleCols(dimension_ * static_cast<Eigen::Index>(c), dimension_);
      }
    }
  }
}

// With frozen D, M and n the slip is the motion itself: u_j = T_j sum_m c_jm x_m since the start.
void PairCoupling::measure_frozen_slip() {
  ++slip_evaluations_;
  const auto x = local_positions_->getLocalViewHost(Tpetra::Access::ReadOnly);
  for (std::size_t s = 0; s < slip_.size(); ++s) {
    NodeRow& row = rows_[s];
    const std::vector<LocalOrdinal>& coupled = interface_->coupled_nodes(s);
    const Frame in = frame(s);
    row.slip.setZero();
    if (slip_[s].start.position.size() > 0) row.slip -= slip_[s].start.position;
    row.dslip.resize(dimension_ - 1, dimension_ * static_cast<Eigen::Index>(coupled.size()));
    for (std::size_t c = 0; c < coupled.size(); ++c) {
      const double coefficient = row.coefficients[c] + (coupled[c] == slave_nodes()[s].local_node ? row.D : 0.0);
      row.slip += coefficient * (in.tangents * position_of(x, coupled[c], dimension_));
      row.dslip.middleCols(dimension_ * static_cast<Eigen::Index>(c), dimension_) = coefficient * in.tangents;
    }
  }
}

// Path: |u_j| over the weight that it carries.
void PairCoupling::accept_slip(std::size_t s, ContactState state) {
  SlipHistory& history = slip_[s];
  history.accepted.path = history.start.path;
  if (state == ContactState::open || history.start.nodes.empty()) return;
  history.accepted.path += rows_[s].slip.norm() / rows_[s].covered;
}

}  // namespace mortise::detail
