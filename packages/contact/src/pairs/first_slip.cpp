// Slip of the slave nodes that master facets did not cover, or hardly did, when the step began.

#include <Tpetra_Map.hpp>
#include <Tpetra_MultiVector.hpp>
#include <algorithm>

#include "mortise/mortar/quadratic_facet.hpp"
#include "pairs/facet_motion.hpp"
#include "pairs/pair.hpp"

namespace mortise::detail {

// A node that was not covered has nothing to compare its couplings with. Its slip is the motion since the start of the step relative to what it faces
// now. Each facet's part counts in the facet's own motion. W_e is the vector from the master at the start, V_e is W_e carried along by the facet:
//   W_e = sum_m c^e_jm X_m,   V_e = B_e B_e0^-1 W_e,
//   u_j = T_j r,   r = sum_e ( sum_m c^e_jm x_m - V_e ),   and the gap at the start  g_j^0 = -n_j . sum_e V_e.
// A rigid motion turns both alike. Where there is an older coupling both measures agree to second order in the step. One compares the motion with
// what the node faces at its end, the other with what it faced at its start. Derivative:
//   dr = sum_e sum_m ( dc^e_jm (x_m - B_e B_e0^-1 X_m) + c^e_jm dx_m ) - sum_e d(B_e) B_e0^-1 W_e
void Pair::measure_first_slip(const PairHistory& history, bool derivatives, PairGeometry& geometry) const {
  const SlipReferences& start = *history.slip;
  const auto is_new = [&](std::size_t s) { return s < geometry.slips.size() && start.nodes[s].empty() && covered(s, (*geometry.rows)[s]); };
  const auto x = geometry.positions->getLocalViewHost(Tpetra::Access::ReadOnly), X = start_->getLocalViewHost(Tpetra::Access::ReadOnly);
  std::vector<SpatialVector> r, V;  // [slave nodes]
  for (const FacetCoupling& facet : geometry.couplings) {
    const auto nodes = static_cast<Eigen::Index>(facet.slave.size()), masters = static_cast<Eigen::Index>(facet.master.size());
    if (std::none_of(facet.slave.begin(), facet.slave.end(), [&](LocalOrdinal node) { return is_new(static_cast<std::size_t>(node)); })) continue;
    if (r.empty()) V = r = std::vector<SpatialVector>(geometry.slips.size(), SpatialVector::Zero(dimension_));
    // A node that is coupled by itself, without its facet, goes by the master's.
    const bool by_itself = nodes < dimension_;
    std::vector<LocalOrdinal> corners(facet.slave.begin(), facet.slave.end());
    if (by_itself) corners = facet.master;
    corners.resize(facet_corners(dimension_, corners.size()));
    std::vector<SpatialVector> before, now;
    for (const LocalOrdinal node : corners) {
      before.push_back(position_of(X, node, dimension_));
      now.push_back(position_of(x, node, dimension_));
    }
    const FacetMotion motion(before, now);
    for (Eigen::Index j = 0; j < nodes; ++j) {
      const auto s = static_cast<std::size_t>(facet.slave[j]);
      if (!is_new(s)) continue;
      SpatialVector w = SpatialVector::Zero(dimension_), W = w;
      for (Eigen::Index k = 0; k < nodes; ++k) {
        w += facet.D(j, k) * position_of(x, facet.slave[k], dimension_);
        W += facet.D(j, k) * position_of(X, facet.slave[k], dimension_);
      }
      for (Eigen::Index l = 0; l < masters; ++l) {
        w -= facet.M(j, l) * position_of(x, facet.master[l], dimension_);
        W -= facet.M(j, l) * position_of(X, facet.master[l], dimension_);
      }
      const SpatialVector carried = motion.carried() * W;
      V[s] += carried;
      r[s] += w - carried;
      if (!derivatives) continue;
      NodeSlip& of_node = geometry.slips[s];
      of_node.dstart_gap.resize(static_cast<std::size_t>(of_node.dslip.cols()), 0.0);
      const NodeRow& row = (*geometry.rows)[s];
      const Frame in = make_frame(row.normal, history.axes[s]);
      // Of r and of V, along the tangents and along the normal.
      const auto columns = dimension_ * static_cast<Eigen::Index>(facet.columns.size());
      Eigen::MatrixXd of_slip = Eigen::MatrixXd::Zero(dimension_ - 1, columns);
      Eigen::RowVectorXd of_gap = Eigen::RowVectorXd::Zero(columns);
      const auto add_change = [&](LocalOrdinal node, double sign, const auto& change) {
        const SpatialVector was = motion.carried() * position_of(X, node, dimension_);
        of_slip += (sign * (in.tangents * (position_of(x, node, dimension_) - was))) * change;
        of_gap -= sign * row.normal.dot(was) * change;
      };
      for (Eigen::Index k = 0; k < nodes; ++k) add_change(facet.slave[k], 1.0, facet.dD.row(nodes * j + k));
      for (Eigen::Index l = 0; l < masters; ++l) add_change(facet.master[l], -1.0, facet.dM.row(j * masters + l));
      const std::vector<LocalOrdinal>& coupled = geometry.pattern->coupled[s];
      const auto place_of = [&](LocalOrdinal node) {
        return dimension_ * (std::lower_bound(coupled.begin(), coupled.end(), node) - coupled.begin());
      };
      const auto add_at = [&](LocalOrdinal node, const auto& slip, const auto& gap) {
        const auto place = place_of(node);
        of_node.dslip.middleCols(place, dimension_) += slip;
        for (int i = 0; i < dimension_; ++i) of_node.dstart_gap[static_cast<std::size_t>(place + i)] += gap[i];
      };
      for (std::size_t c = 0; c < facet.columns.size(); ++c) {
        const auto first = dimension_ * static_cast<Eigen::Index>(c);
        add_at(facet.columns[c], of_slip.middleCols(first, dimension_), of_gap.segment(first, dimension_));
      }
      const auto add_motion = [&](LocalOrdinal node, double coefficient) {
        of_node.dslip.middleCols(place_of(node), dimension_) += coefficient * in.tangents;
      };
      for (Eigen::Index k = 0; k < nodes; ++k) add_motion(facet.slave[k], facet.D(j, k));
      for (Eigen::Index l = 0; l < masters; ++l) add_motion(facet.master[l], -facet.M(j, l));
      for (std::size_t k = 0; k < corners.size(); ++k) {
        const SpatialMatrix slope = motion.slope(k, W);
        add_at(corners[k], Eigen::MatrixXd(-in.tangents * slope), Eigen::RowVectorXd(-row.normal.transpose() * slope));
      }
    }
  }
  for (std::size_t s = 0; s < r.size(); ++s) {
    if (!is_new(s)) continue;
    NodeSlip& of_node = geometry.slips[s];
    const NodeRow& row = (*geometry.rows)[s];
    const Frame in = make_frame(row.normal, history.axes[s]);
    of_node.slip = in.tangents * r[s];
    of_node.start_gap = -row.normal.dot(V[s]);
    if (!derivatives) continue;
    for (Eigen::Index a = 0; a < in.tangents.rows(); ++a) of_node.dslip.row(a) += (r[s].transpose() * in.turn[a]) * row.dnormal;
    const Eigen::RowVectorXd turned = V[s].transpose() * row.dnormal;
    for (Eigen::Index c = 0; c < turned.size(); ++c) of_node.dstart_gap[static_cast<std::size_t>(c)] -= turned[c];
  }
}

}  // namespace mortise::detail
