// Slip of the slave nodes of a pair with friction, since the accepted state.

#include <Tpetra_Map.hpp>
#include <Tpetra_MultiVector.hpp>
#include <algorithm>
#include <stdexcept>

#include "pairs/pair.hpp"

namespace mortise::detail {

const Pair::Places& Pair::places_of(const std::shared_ptr<const InterfacePattern>& pattern,
                                    const std::shared_ptr<const SlipReferences>& references) const {
  if (places_pattern_ == pattern && places_references_ == references) return places_;
  Places places(references->nodes.size());
  for (std::size_t s = 0; s < places.size(); ++s) {
    const std::vector<LocalOrdinal>& coupled = pattern->coupled[s];
    for (const GlobalOrdinal id : references->nodes[s]) {
      const LocalOrdinal node = pattern->local_nodes->getLocalElement(id);
      const auto found = std::lower_bound(coupled.begin(), coupled.end(), node);
      if (node < 0 || found == coupled.end() || *found != node)
        throw std::logic_error("contact: a node that a slip is measured against is not in the pattern");
      places[s].push_back(static_cast<LocalOrdinal>(found - coupled.begin()));
    }
  }
  places_ = std::move(places);
  const auto start = rcp(new MultiVector(pattern->local_nodes, static_cast<std::size_t>(dimension_)));
  start->doImport(*references->start, *pattern->import, Tpetra::REPLACE);
  start_ = start;
  if (any_held_) {
    const auto fixed = rcp(new MultiVector(pattern->local_nodes, static_cast<std::size_t>(dimension_)));
    fixed->doImport(*fixed_, *pattern->import, Tpetra::REPLACE);
    held_ = fixed;
  }
  places_pattern_ = pattern;
  places_references_ = references;
  return places_;
}

// u_j = -T_j w,  w = sum_m (c_jm - c_jm^old) x_m, the rows of T_j the tangents tau_a. With d(tau_a) . w = (turn_a^T w) . dn
//   du_j = -dT_j w - T_j sum_m (dc_jm x_m + (c_jm - c_jm^old) dx_m).
void Pair::measure_slip(const PairHistory& history, bool derivatives, PairGeometry& geometry) const {
  ++slip_evaluations_;
  const InterfacePattern& pattern = *geometry.pattern;
  const SlipReferences& start = *history.slip;
  const Places& places = places_of(geometry.pattern, history.slip);
  const auto x = geometry.positions->getLocalViewHost(Tpetra::Access::ReadOnly);
  geometry.slips.assign(geometry.gaps.size(), {TangentVector::Zero(dimension_ - 1), {}, 0.0, {}, {}});
  const auto position = [&](LocalOrdinal node) { return position_of(x, node, dimension_); };
  const Eigen::Index tangents = dimension_ - 1;
  for (std::size_t s = 0; s < geometry.slips.size(); ++s) {
    const NodeRow& row = (*geometry.rows)[s];
    NodeSlip& of_node = geometry.slips[s];
    const std::vector<LocalOrdinal>& coupled = pattern.coupled[s];
    of_node.dslip.setZero(tangents, derivatives ? dimension_ * static_cast<Eigen::Index>(coupled.size()) : 0);
    of_node.start_gap = start.gaps[s];
    if (start.nodes[s].empty() || !covered(s, row)) continue;
    std::vector<double> change = row.coefficients;
    for (std::size_t c = 0; c < coupled.size(); ++c)
      if (coupled[c] == slave_nodes()[s].local_node) change[c] += row.D;
    for (std::size_t n = 0; n < start.nodes[s].size(); ++n) change[places[s][n]] -= start.coefficients[s][n];
    SpatialVector w = SpatialVector::Zero(dimension_);
    for (std::size_t c = 0; c < coupled.size(); ++c) w += change[c] * position(coupled[c]);
    const Frame in = make_frame((*geometry.rows)[s].normal, history.axes[s]);
    of_node.slip = -in.tangents * w;
    if (!derivatives) continue;
    for (Eigen::Index a = 0; a < tangents; ++a) of_node.dslip.row(a) = -(w.transpose() * in.turn[a]) * row.dnormal;
    for (std::size_t c = 0; c < coupled.size(); ++c)
      of_node.dslip.middleCols(dimension_ * static_cast<Eigen::Index>(c), dimension_) -= change[c] * in.tangents;
  }
  measure_first_slip(history, derivatives, geometry);
  find_resting(geometry);
  if (!derivatives) return;
  // The facets' derivatives of D and M.
  for (const FacetCoupling& facet : geometry.couplings) {
    const auto nodes = static_cast<Eigen::Index>(facet.slave.size()), masters = static_cast<Eigen::Index>(facet.master.size());
    for (Eigen::Index j = 0; j < nodes; ++j) {
      const auto s = static_cast<std::size_t>(facet.slave[j]);
      if (s >= geometry.slips.size() || start.nodes[s].empty() || !covered(s, (*geometry.rows)[s])) continue;
      const Frame in = make_frame((*geometry.rows)[s].normal, history.axes[s]);
      Eigen::MatrixXd gradient = Eigen::MatrixXd::Zero(tangents, dimension_ * static_cast<Eigen::Index>(facet.columns.size()));
      for (Eigen::Index k = 0; k < nodes; ++k) gradient -= (in.tangents * position(facet.slave[k])) * facet.dD.row(nodes * j + k);
      for (Eigen::Index l = 0; l < masters; ++l) gradient += (in.tangents * position(facet.master[l])) * facet.dM.row(j * masters + l);
      const std::vector<LocalOrdinal>& coupled = pattern.coupled[s];
      for (std::size_t c = 0; c < facet.columns.size(); ++c) {
        const auto place = std::lower_bound(coupled.begin(), coupled.end(), facet.columns[c]) - coupled.begin();
        geometry.slips[s].dslip.middleCols(dimension_ * place, dimension_) +=
            gradient.middleCols(dimension_ * static_cast<Eigen::Index>(c), dimension_);
      }
    }
  }
}

// With frozen D, M and n the slip is the motion itself: u_j = T_j sum_m c_jm x_m since the start.
void Pair::measure_frozen_slip(const PairHistory& history, PairGeometry& geometry) const {
  ++slip_evaluations_;
  const SlipReferences& start = *history.slip;
  if (any_held_) places_of(geometry.pattern, history.slip);
  const auto x = geometry.positions->getLocalViewHost(Tpetra::Access::ReadOnly);
  geometry.slips.assign(geometry.gaps.size(), {TangentVector::Zero(dimension_ - 1), {}, 0.0, {}, {}});
  find_resting(geometry);
  for (std::size_t s = 0; s < geometry.slips.size(); ++s) {
    const NodeRow& row = (*geometry.rows)[s];
    NodeSlip& of_node = geometry.slips[s];
    const std::vector<LocalOrdinal>& coupled = geometry.pattern->coupled[s];
    const Frame in = make_frame(row.normal, history.axes[s]);
    if (start.positions[s].size() > 0) of_node.slip -= start.positions[s];
    of_node.start_gap = start.gaps[s];
    of_node.dslip.resize(dimension_ - 1, dimension_ * static_cast<Eigen::Index>(coupled.size()));
    for (std::size_t c = 0; c < coupled.size(); ++c) {
      const double coefficient = row.coefficients[c] + (coupled[c] == slave_nodes()[s].local_node ? row.D : 0.0);
      of_node.slip += coefficient * (in.tangents * position_of(x, coupled[c], dimension_));
      of_node.dslip.middleCols(dimension_ * static_cast<Eigen::Index>(c), dimension_) = coefficient * in.tangents;
    }
  }
}

}  // namespace mortise::detail
