// Slip of the slave nodes of a pair with friction, since the start of the step.

#include <Tpetra_Import.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_MultiVector.hpp>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "pair_coupling.hpp"

namespace mortise::detail {

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

void PairCoupling::take_slip_reference() {
  const auto x = local_positions_->getLocalViewHost(Tpetra::Access::ReadOnly);
  for (std::size_t s = 0; s < slip_.size(); ++s) {
    SlipReference& reference = slip_[s].accepted;
    const NodeRow& row = rows_[s];
    const std::vector<LocalOrdinal>& coupled = interface_->coupled_nodes(s);
    reference.nodes.clear();
    reference.coefficients.clear();
    reference.position = 0.0;
    if (!covered(s)) continue;
    for (std::size_t c = 0; c < coupled.size(); ++c) {
      const double coefficient = row.coefficients[c] + (coupled[c] == slave_nodes()[s].local_node ? row.D : 0.0);
      if (coefficient == 0.0) continue;
      reference.nodes.push_back(interface_->local_nodes()->getGlobalElement(coupled[c]));
      reference.coefficients.push_back(coefficient);
      reference.position += coefficient * tangent(row.normal).dot(Eigen::Vector2d(x(coupled[c], 0), x(coupled[c], 1)));
    }
  }
}

void PairCoupling::start_step() {
  start_multipliers_ = accepted_multipliers_;
  if (friction_ == nullptr) return;
  std::vector<std::vector<GlobalOrdinal>> retained(slip_.size());
  for (std::size_t s = 0; s < slip_.size(); ++s) {
    slip_[s].start = slip_[s].accepted;
    retained[s] = slip_[s].start.nodes;
  }
  interface_->retain(std::move(retained));
  place_slip_histories();
}

// u_j = -tau_j . w,  w = sum_m (c_jm - c_jm^old) x_m:
//   du_j = -d(tau_j) . w - tau_j . sum_m (dc_jm x_m + (c_jm - c_jm^old) dx_m),   d(tau) . w = dn . (w_y, -w_x).
void PairCoupling::measure_slip(bool derivatives) {
  ++slip_evaluations_;
  const auto x = local_positions_->getLocalViewHost(Tpetra::Access::ReadOnly);
  const auto position = [&](LocalOrdinal node) { return Eigen::Vector2d(x(node, 0), x(node, 1)); };
  for (std::size_t s = 0; s < slip_.size(); ++s) {
    NodeRow& row = rows_[s];
    const SlipReference& start = slip_[s].start;
    const std::vector<LocalOrdinal>& coupled = interface_->coupled_nodes(s);
    row.slip = 0.0;
    row.dslip.assign(derivatives ? 2 * coupled.size() : 0, 0.0);
    if (start.nodes.empty() || !covered(s)) continue;
    std::vector<double> change = row.coefficients;
    for (std::size_t c = 0; c < coupled.size(); ++c)
      if (coupled[c] == slave_nodes()[s].local_node) change[c] += row.D;
    for (std::size_t n = 0; n < start.nodes.size(); ++n) change[slip_[s].places[n]] -= start.coefficients[n];
    Eigen::Vector2d w = Eigen::Vector2d::Zero();
    for (std::size_t c = 0; c < coupled.size(); ++c) w += change[c] * position(coupled[c]);
    const Eigen::Vector2d tau = tangent(row.normal);
    row.slip = -tau.dot(w);
    if (!derivatives) continue;
    for (std::size_t c = 0; c < coupled.size(); ++c)
      for (int i = 0; i < 2; ++i)
        row.dslip[2 * c + i] = -tau[i] * change[c] - (w.y() * row.dnormal(0, 2 * c + i) - w.x() * row.dnormal(1, 2 * c + i));
  }
  if (!derivatives) return;
  // The facets' derivatives of D and M.
  for (const FacetCoupling& facet : couplings_)
    for (int j = 0; j < 2; ++j) {
      const auto s = static_cast<std::size_t>(facet.slave[j]);
      if (s >= slip_.size() || slip_[s].start.nodes.empty() || !covered(s)) continue;
      const Eigen::Vector2d tau = tangent(rows_[s].normal);
      Eigen::RowVectorXd gradient = Eigen::RowVectorXd::Zero(2 * facet.columns.size());
      for (int k = 0; k < 2; ++k)
        if (facet.slave[k] != FacetCoupling::none) gradient -= tau.dot(position(facet.slave[k])) * facet.dD.row(2 * j + k);
      for (std::size_t l = 0; l < facet.master.size(); ++l)
        gradient += tau.dot(position(facet.master[l])) * facet.dM.row(j * facet.master.size() + l);
      const std::vector<LocalOrdinal>& coupled = interface_->coupled_nodes(s);
      for (std::size_t c = 0; c < facet.columns.size(); ++c) {
        const auto place = std::lower_bound(coupled.begin(), coupled.end(), facet.columns[c]) - coupled.begin();
        for (int i = 0; i < 2; ++i) rows_[s].dslip[2 * place + i] += gradient[2 * c + i];
      }
    }
}

// With frozen D, M and n the slip is the motion itself: u_j = tau_j . sum_m c_jm x_m since the start.
void PairCoupling::measure_frozen_slip() {
  ++slip_evaluations_;
  const auto x = local_positions_->getLocalViewHost(Tpetra::Access::ReadOnly);
  for (std::size_t s = 0; s < slip_.size(); ++s) {
    NodeRow& row = rows_[s];
    const std::vector<LocalOrdinal>& coupled = interface_->coupled_nodes(s);
    const Eigen::Vector2d tau = tangent(row.normal);
    row.slip = -slip_[s].start.position;
    row.dslip.assign(2 * coupled.size(), 0.0);
    for (std::size_t c = 0; c < coupled.size(); ++c) {
      const double coefficient = row.coefficients[c] + (coupled[c] == slave_nodes()[s].local_node ? row.D : 0.0);
      for (int i = 0; i < 2; ++i) {
        row.slip += coefficient * tau[i] * x(coupled[c], i);
        row.dslip[2 * c + i] = coefficient * tau[i];
      }
    }
  }
}

// Path: |u_j| over the weight that it carries.
void PairCoupling::accept_slip(std::size_t s, ContactState state) {
  SlipHistory& history = slip_[s];
  history.accepted.path = history.start.path;
  if (state == ContactState::open || history.start.nodes.empty()) return;
  history.accepted.path += std::abs(rows_[s].slip) / rows_[s].covered;
}

}  // namespace mortise::detail
