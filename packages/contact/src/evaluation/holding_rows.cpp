// Rows by which contact holds bodies, and the shear that friction bears where it slips: the forces of multipliers, body by body.

#include <Eigen/Geometry>
#include <Tpetra_Import.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_MultiVector.hpp>
#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <cmath>

#include "evaluation/evaluated_contact.hpp"
#include "mortise/contact/holding_nodes.hpp"

namespace mortise {
namespace {

void add_force(const SpatialVector& force, const SpatialVector& arm, int body, std::vector<HoldingRow::Wrench>& wrenches) {
  auto found = std::find_if(wrenches.begin(), wrenches.end(), [&](const auto& wrench) { return wrench.body == body; });
  if (found == wrenches.end()) found = wrenches.insert(found, {body});
  Eigen::Vector3d f = Eigen::Vector3d::Zero(), x = Eigen::Vector3d::Zero();
  f.head(force.size()) = force;
  x.head(arm.size()) = arm;
  const Eigen::Vector3d moment = x.cross(f);
  for (int i = 0; i < 3; ++i) {
    found->force[i] += f[i];
    found->moment[i] += moment[i];
  }
}

/// Forces at the coupled nodes of a slave node, summed for each body.
/// @param at        [local nodes] body and arm
/// @param largest   gets the largest force
template <class View, class ForceAt>
std::vector<HoldingRow::Wrench> wrenches(const std::vector<LocalOrdinal>& coupled, const View& at, int dimension, const ForceAt& force_at,
                                         double& largest) {
  std::vector<HoldingRow::Wrench> result;
  for (std::size_t c = 0; c < coupled.size(); ++c) {
    const SpatialVector force = force_at(c);
    largest = std::max(largest, force.norm());
    const int body = static_cast<int>(at(coupled[c], 0));
    if (body < 0 || force.isZero(0.0)) continue;
    SpatialVector arm(dimension);
    for (int i = 0; i < dimension; ++i) arm[i] = at(coupled[c], 1 + static_cast<std::size_t>(i));
    add_force(force, arm, body, result);
  }
  return result;
}

}  // namespace

// A multiplier acts at the nodes m with c_jm; where forces are the gaps' derivatives its normal part acts with -dg_j/dx_m instead.
std::vector<HoldingRow> holding_rows(const ContactLaws& laws, const MultiVector& places, Holds holds) {
  const detail::EvaluatedLaws& evaluated = detail::evaluated(laws);
  const detail::ContactModel& self = *evaluated.contact->model;
  const Eigen::Index dimension = self.dimension;
  std::vector<HoldingRow> rows;
  for (std::size_t p = 0; p < self.pairs.size(); ++p) {
    const detail::PairEvaluation& pair = evaluated.contact->pairs[p];
    const InterfacePattern& pattern = *pair.geometry()->pattern;
    MultiVector local(pattern.local_nodes, static_cast<std::size_t>(1 + dimension));
    local.doImport(places, *pattern.import, Tpetra::REPLACE);
    const auto at = local.getLocalViewHost(Tpetra::Access::ReadOnly);
    for (std::size_t s = 0; s < pair.rows().size(); ++s) {
      if (self.multiplier_of[p][s] < 0) continue;
      const ContactState state = evaluated.state(p, s);
      if (state == ContactState::open) continue;
      const detail::NodeRow& row = pair.row(s);
      const std::vector<LocalOrdinal>& coupled = pair.coupled_nodes(s);
      const LocalOrdinal own = pair.slave_nodes()[s].local_node;
      const auto add_row = [&](bool along_surface, const auto& force_at) {
        double largest = 0.0;
        HoldingRow result{p, along_surface, wrenches(coupled, at, self.dimension, force_at, largest)};
        if (result.bodies.empty()) return;
        for (HoldingRow::Wrench& wrench : result.bodies)
          for (int i = 0; i < 3; ++i) {
            wrench.force[i] /= largest;
            wrench.moment[i] /= largest;
          }
        rows.push_back(std::move(result));
      };
      const auto along = [&](const SpatialVector& direction) {
        return [&](std::size_t c) { return SpatialVector((row.coefficients[c] + (coupled[c] == own ? row.D : 0.0)) * direction); };
      };
      if (holds == Holds::by_conditions || pair.pair().has_forces_of_gaps())
        add_row(false, [&](std::size_t c) { return SpatialVector(-Eigen::Map<const Eigen::VectorXd>(&row.dgap[dimension * c], dimension)); });
      else
        add_row(false, along(row.normal));
      if (state != ContactState::stick && (holds == Holds::by_forces || pair.pair().friction() == nullptr)) continue;
      const Frame in = pair.frame(s);
      for (Eigen::Index a = 0; a < in.tangents.rows(); ++a) {
        const SpatialVector tangent = in.tangents.row(a).transpose();
        add_row(true, along(tangent));
      }
    }
  }
  return rows;
}

// w = sum_m c_jm x_m along tau_a is what a slip changes by: a unit traction along tau_a acts at the nodes m with c_jm tau_a.
std::vector<SlidingNode> sliding_nodes(const ContactLaws& laws, const MultiVector& places) {
  const detail::EvaluatedLaws& evaluated = detail::evaluated(laws);
  const detail::ContactModel& self = *evaluated.contact->model;
  std::vector<SlidingNode> nodes;
  for (std::size_t p = 0; p < self.pairs.size(); ++p) {
    const detail::PairEvaluation& pair = evaluated.contact->pairs[p];
    const std::vector<detail::NodeMultiplier>& multipliers = evaluated.multipliers[p];
    if (pair.pair().friction() == nullptr || !pair.pair().enforcement().holds_exactly()) continue;
    const InterfacePattern& pattern = *pair.geometry()->pattern;
    MultiVector local(pattern.local_nodes, static_cast<std::size_t>(1 + self.dimension));
    local.doImport(places, *pattern.import, Tpetra::REPLACE);
    const auto at = local.getLocalViewHost(Tpetra::Access::ReadOnly);
    for (std::size_t s = 0; s < pair.rows().size(); ++s) {
      if (self.multiplier_of[p][s] < 0 || pair.slave_nodes()[s].partly_fixed()) continue;
      const Complementarity& law = evaluated.laws[p][s];
      if (law.state != ContactState::slip) continue;
      SlidingNode node{p, self.multiplier_of[p][s], {}, 0.0, pair.pair().friction_constant(s), pair.row(s).covered, {}, {}};
      const Frame frame = pair.frame(s);
      for (Eigen::Index a = 0; a < frame.tangents.rows(); ++a)  // C_tau = z_tau - rho y / |y|
        node.bound = std::hypot(node.bound, frame.tangents.row(a).dot(multipliers[s].z) - law.C[1 + a]);
      if (!(node.bound > 0.0)) continue;
      const TangentVector slip = pair.slip_in_contact(s, multipliers[s]);
      node.slip.assign(slip.data(), slip.data() + slip.size());
      const std::vector<LocalOrdinal>& coupled = pair.coupled_nodes(s);
      const LocalOrdinal own = pair.slave_nodes()[s].local_node;
      for (Eigen::Index a = 0; a < frame.tangents.rows(); ++a) {
        const SpatialVector tangent = frame.tangents.row(a).transpose();
        node.tangents.push_back({});
        std::copy(tangent.data(), tangent.data() + tangent.size(), node.tangents.back().begin());
        double largest = 0.0;
        node.along.push_back(wrenches(
            coupled, at, self.dimension,
            [&](std::size_t c) { return SpatialVector((pair.row(s).coefficients[c] + (coupled[c] == own ? pair.row(s).D : 0.0)) * tangent); },
            largest));
      }
      nodes.push_back(std::move(node));
    }
  }
  return nodes;
}

std::vector<BearingNode> bearing_nodes(const ContactLaws& laws, const MultiVector& places, OpenNodes open) {
  const detail::EvaluatedLaws& evaluated = detail::evaluated(laws);
  const detail::ContactModel& self = *evaluated.contact->model;
  std::vector<BearingNode> nodes;
  for (std::size_t p = 0; p < self.pairs.size(); ++p) {
    const detail::PairEvaluation& pair = evaluated.contact->pairs[p];
    const InterfacePattern& pattern = *pair.geometry()->pattern;
    MultiVector local(pattern.local_nodes, static_cast<std::size_t>(1 + self.dimension));
    local.doImport(places, *pattern.import, Tpetra::REPLACE);
    const auto at = local.getLocalViewHost(Tpetra::Access::ReadOnly);
    for (std::size_t s = 0; s < pair.rows().size(); ++s) {
      if (self.multiplier_of[p][s] < 0 || !pair.covered(s)) continue;
      const SlaveNode& slave = pair.slave_nodes()[s];
      const detail::NodeRow& row = pair.row(s);
      BearingNode node;
      node.pair = p;
      node.slave = s;
      node.owned_node = slave.owned_node;
      node.closed = evaluated.state(p, s) != ContactState::open;
      node.gap = pair.gap_to_onset(s) / slave.weight;
      node.near = detail::near * pair.pair().size();
      if (!node.closed && open == OpenNodes::near && pair.own_gap(s) > node.near * slave.weight) continue;
      const std::vector<LocalOrdinal>& coupled = pair.coupled_nodes(s);
      double largest = 0.0;
      const auto along = [&](const SpatialVector& direction) {
        const auto force_at = [&](std::size_t c) {
          return SpatialVector((row.coefficients[c] + (coupled[c] == slave.local_node ? row.D : 0.0)) * direction);
        };
        return wrenches(coupled, at, self.dimension, force_at, largest);
      };
      const auto against_gap = [&](std::size_t c) {
        return SpatialVector(-Eigen::Map<const Eigen::VectorXd>(&row.dgap[static_cast<std::size_t>(self.dimension) * c], self.dimension));
      };
      node.normal = pair.pair().has_forces_of_gaps() ? wrenches(coupled, at, self.dimension, against_gap, largest) : along(row.normal);
      if (node.normal.empty()) continue;
      if (pair.pair().friction() != nullptr) node.friction = pair.pair().friction()->largest_ratio();
      const Frame in = pair.frame(s);
      for (Eigen::Index a = 0; node.friction > 0.0 && a < in.tangents.rows(); ++a) node.along.push_back(along(in.tangents.row(a).transpose()));
      nodes.push_back(std::move(node));
    }
  }
  return nodes;
}

}  // namespace mortise
