// What can be known of the pairs after a solve: states of nodes, resultants, how the integrals are spread over the ranks.

#include <Tpetra_Map.hpp>
#include <Tpetra_Vector.hpp>
#include <algorithm>

#include "implementation.hpp"

namespace mortise {

IntegrationLoad ContactSystem::integration_load(std::size_t pair) const {
  const Implementation& self = *implementation_;
  IntegrationLoad load;
  const auto add = [&](std::size_t p) {
    const InterfaceLoad& mine = self.pairs[p]->interface().load();
    load.facets += mine.facets;
    load.segments += mine.segments;
    load.imbalance_as_owned = std::max(load.imbalance_as_owned, mine.imbalance_as_owned);
    load.redistributions += mine.redistributions;
  };
  add(pair);
  if (const auto other = second_pass(pair)) add(*other);
  const double largest = self.maximum(static_cast<double>(load.segments)), sum = self.sum(static_cast<double>(load.segments));
  load.facets = static_cast<long>(self.sum(static_cast<double>(load.facets)));
  load.segments = static_cast<long>(sum);
  if (sum > 0.0) load.imbalance = largest * self.dofs->getComm()->getSize() / sum;
  return load;
}

CornerReport ContactSystem::corners(std::size_t pair) const {
  const Implementation& self = *implementation_;
  CornerReport report;
  report.rule = self.pairs[pair]->corner_rule();
  report.as_asked = report.rule == self.pairs[pair]->definition().options.mortar.corners;
  long mine = self.pairs[pair]->interface().kinks(*self.evaluated_at);
  if (const auto other = second_pass(pair)) mine += self.pairs[*other]->interface().kinks(*self.evaluated_at);
  report.kinks = static_cast<long>(self.sum(static_cast<double>(mine)));
  return report;
}

std::vector<ContactNodeState> ContactSystem::node_states(std::size_t pair, const Vector& z) const {
  const Implementation& self = *implementation_;
  const auto values = z.getLocalViewHost(Tpetra::Access::ReadOnly);
  std::vector<ContactNodeState> states;
  const std::vector<detail::NodeMultiplier> multipliers = self.multipliers_of(values, pair);
  for (std::size_t s = 0; s < self.multiplier_of[pair].size(); ++s) {
    const SlaveNode& slave = self.pairs[pair]->slave_nodes()[s];
    const detail::NodeRow& row = self.pairs[pair]->rows()[s];
    const SpatialVector zs = self.z_of(values, pair, s);
    const SpatialVector across = self.pairs[pair]->frame(s).tangents * zs;
    const auto signed_size = [](const TangentVector& v) { return v.size() == 1 ? v[0] : v.norm(); };
    ContactNodeState state;
    state.node = slave.id;
    state.owned_node = slave.owned_node;
    std::copy(zs.begin(), zs.end(), state.traction.begin());
    std::copy(row.normal.begin(), row.normal.end(), state.normal.begin());
    state.pressure = zs.dot(row.normal);
    state.gap = row.gap / slave.weight;
    state.weight = slave.weight;
    if (slave.carries_multiplier) state.state = self.pairs[pair]->complementarity(s, multipliers[s]).state;
    state.closed = state.state != ContactState::open;
    state.covered = row.covered;
    state.shear = signed_size(across);
    if (self.pairs[pair]->friction() != nullptr && row.covered > 0.0) {
      state.slip = signed_size(row.slip) / row.covered;
      state.slip_path = self.pairs[pair]->slip_histories()[s].accepted.path;
      if (state.closed)
        state.shear_bound =
            self.pairs[pair]->friction()->bound(std::max(0.0, state.pressure), self.pairs[pair]->slip_histories()[s].start.path).value;
    }
    const SpatialVector force = self.pairs[pair]->resultant(s, zs);
    std::copy(force.begin(), force.end(), state.force.begin());
    states.push_back(state);
  }
  return states;
}

std::array<double, 3> ContactSystem::resultant(std::size_t pair, const Vector& z) const {
  const Implementation& self = *implementation_;
  const auto values = z.getLocalViewHost(Tpetra::Access::ReadOnly);
  SpatialVector mine = SpatialVector::Zero(self.dimension);
  const auto subtract = [&](std::size_t p, double sign) {
    for (std::size_t s = 0; s < self.multiplier_of[p].size(); ++s) mine -= sign * self.pairs[p]->resultant(s, self.z_of(values, p, s));
  };
  subtract(pair, 1.0);
  if (const auto other = second_pass(pair)) subtract(*other, -1.0);  // its slave side is the master here
  std::array<double, 3> all{};
  for (int i = 0; i < self.dimension; ++i) all[i] = self.sum(mine[i]);
  return all;
}

}  // namespace mortise
