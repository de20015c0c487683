// Reports on the pairs at an iterate: states of nodes, resultants, kinks.

#include "mortise/contact/contact_report.hpp"

#include <Tpetra_Import.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_MultiVector.hpp>
#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>
#include <utility>

#include "evaluation/arguments.hpp"
#include "evaluation/evaluated_contact.hpp"

namespace mortise {

CornerReport corners(const ContactEvaluation& evaluation, std::size_t pair) {
  const detail::EvaluatedContact& contact = detail::evaluated(evaluation);
  const detail::ContactModel& model = *contact.model;
  detail::require_pair(model, pair);
  CornerReport report;
  report.rule = model.pairs[pair]->corner_rule();
  report.as_asked = report.rule == model.pairs[pair]->definition().options.mortar.corners;
  long mine = model.pairs[pair]->interface().kinks(*contact.positions);
  if (const auto other = model.second_pass(pair)) mine += model.pairs[*other]->interface().kinks(*contact.positions);
  report.kinks = static_cast<long>(model.sum(static_cast<double>(mine)));
  return report;
}

FacetOrientation facet_orientation(const ContactEvaluation& evaluation, std::size_t pair) {
  const detail::EvaluatedContact& contact = detail::evaluated(evaluation);
  detail::require_pair(*contact.model, pair);
  const detail::PairEvaluation& of_pair = contact.pairs[pair];
  std::vector<std::size_t> nodes;
  std::vector<SpatialVector> out, in;
  for (std::size_t s = 0; s < of_pair.slave_nodes().size(); ++s) {
    nodes.push_back(s);
    out.push_back(of_pair.row(s).normal);
    in.push_back(-out.back());
  }
  const MortarInterface& interface = of_pair.pair().interface();
  const auto ahead = interface.distances_to_master(*contact.positions, nodes, out),
             behind = interface.distances_to_master(*contact.positions, nodes, in);
  const auto is_near = [&](const std::optional<double>& distance) { return distance && std::abs(*distance) <= interface.reach(); };
  double facing = 0.0, turned = 0.0;
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    if (is_near(ahead[n]))
      facing += 1.0;
    else if (is_near(behind[n]))
      turned += 1.0;
  }
  return {static_cast<long>(contact.model->sum(facing)), static_cast<long>(contact.model->sum(turned))};
}

namespace {

/// Action of others at slave nodes that carry no multiplier. The multiplier j acts at node k by D_jk = int phi_j N_k: means have the weights |D_jk|.
/// Corners of quadratic facets have entries of either sign.
class ActionOfOthers {
 public:
  /// Collective.
  ActionOfOthers(const detail::EvaluatedLaws& at, std::size_t pair) : dimension_(at.contact->model->dimension) {
    const detail::PairEvaluation& of_pair = at.contact->pairs[pair];
    const InterfacePattern& pattern = *of_pair.geometry()->pattern;
    const auto columns = static_cast<std::size_t>(tangential + dimension_);
    MultiVector local(pattern.local_nodes, columns);
    {
      const auto sums = local.getLocalViewHost(Tpetra::Access::ReadWrite);
      for (std::size_t s = 0; s < at.laws[pair].size(); ++s) {
        const SpatialVector &z = at.multipliers[pair][s].z, &normal = of_pair.row(s).normal;
        if (!of_pair.slave_nodes()[s].carries_multiplier) continue;
        const double pressure = z.dot(normal);
        const SpatialVector across = z - pressure * normal;
        const std::vector<LocalOrdinal>& coupled = of_pair.coupled_nodes(s);
        for (std::size_t c = 0; c < coupled.size(); ++c) {
          const double weight = std::abs(of_pair.row(s).coefficients[c]);
          if (weight == 0.0) continue;
          sums(coupled[c], all) += weight;
          if (at.state(pair, s) != ContactState::open) sums(coupled[c], at.state(pair, s) == ContactState::stick ? stick : slip) += weight;
          sums(coupled[c], normal_part) += weight * pressure;
          for (int i = 0; i < dimension_; ++i) sums(coupled[c], static_cast<std::size_t>(tangential + i)) += weight * across[i];
        }
      }
    }
    sums_ = rcp(new MultiVector(at.contact->model->owned_nodes, columns));
    sums_->doExport(local, *pattern.import, Tpetra::ADD);
  }

  /// The mean traction at a node, and whether and how most of what acts there is closed. Nothing acts where no master covers the node's facets.
  std::pair<SpatialVector, ContactState> at(const SlaveNode& node, const SpatialVector& normal) const {
    constexpr double nothing = 1e-9;
    const auto sums = sums_->getLocalViewHost(Tpetra::Access::ReadOnly);
    const LocalOrdinal row = node.owned_node;
    SpatialVector z = SpatialVector::Zero(dimension_);
    if (!(sums(row, all) > nothing * node.weight)) return {z, ContactState::open};
    for (int i = 0; i < dimension_; ++i) z[i] = sums(row, static_cast<std::size_t>(tangential + i)) / sums(row, all);
    z += (sums(row, normal_part) / sums(row, all) - z.dot(normal)) * normal;
    const double closed = sums(row, stick) + sums(row, slip);
    if (2.0 * closed < sums(row, all)) return {z, ContactState::open};
    return {z, sums(row, stick) > sums(row, slip) ? ContactState::stick : ContactState::slip};
  }

 private:
  enum Column { all, stick, slip, normal_part, tangential };
  int dimension_;
  RCP<MultiVector> sums_;
};

}  // namespace

std::vector<ContactNodeState> node_states(const ContactLaws& laws, std::size_t pair) {
  const detail::EvaluatedLaws& at = detail::evaluated(laws);
  detail::require_pair(*at.contact->model, pair);
  const detail::PairEvaluation& of_pair = at.contact->pairs[pair];
  const FrictionLaw* friction = of_pair.pair().friction();
  std::vector<ContactNodeState> states;
  std::optional<ActionOfOthers> others;
  if (at.contact->model->leaves_out[pair] != 0) others.emplace(at, pair);
  for (std::size_t s = 0; s < at.laws[pair].size(); ++s) {
    const SlaveNode& slave = of_pair.slave_nodes()[s];
    const detail::NodeRow& row = of_pair.row(s);
    SpatialVector zs = at.multipliers[pair][s].z;
    const SpatialVector force = of_pair.resultant(s, zs);
    ContactState acting = at.state(pair, s);
    if (!slave.carries_multiplier) std::tie(zs, acting) = others->at(slave, row.normal);
    const SpatialVector across = of_pair.frame(s).tangents * zs;
    const auto signed_size = [](const TangentVector& v) { return v.size() == 1 ? v[0] : v.norm(); };
    ContactNodeState state;
    state.node = slave.id;
    state.owned_node = slave.owned_node;
    std::copy(zs.begin(), zs.end(), state.traction.begin());
    std::copy(row.normal.begin(), row.normal.end(), state.normal.begin());
    state.pressure = zs.dot(row.normal);
    state.gap = (of_pair.geometry()->gaps[s] + of_pair.clearance(s) * of_pair.row(s).covered) / slave.weight;
    state.weight = slave.weight;
    state.carries = slave.carries_multiplier;
    state.state = acting;
    state.closed = state.state != ContactState::open;
    state.covered = row.covered;
    state.shear = signed_size(across);
    if (friction != nullptr && row.covered > 0.0) {
      state.slip = signed_size(of_pair.geometry()->slips[s].slip) / row.covered;
      state.slip_path = of_pair.slip_path(s, state.state);
      if (state.closed) state.shear_bound = friction->bound(of_pair.friction_point(s, std::max(0.0, state.pressure))).value;
    }
    std::copy(force.begin(), force.end(), state.force.begin());
    states.push_back(state);
  }
  return states;
}

double allowed_overlap(const ContactLaws& laws, std::size_t pair) {
  const detail::EvaluatedContact& contact = *detail::evaluated(laws).contact;
  detail::require_pair(*contact.model, pair);
  const detail::PairEvaluation& of_pair = contact.pairs[pair];
  double clearance = 0.0;
  for (std::size_t s = 0; s < of_pair.slave_nodes().size(); ++s) clearance = std::max(clearance, of_pair.clearance(s));
  return contact.model->maximum(clearance) + of_pair.history().allowed_overlap;
}

std::array<double, 3> resultant(const ContactLaws& laws, std::size_t pair) {
  const detail::EvaluatedLaws& at = detail::evaluated(laws);
  const detail::ContactModel& model = *at.contact->model;
  detail::require_pair(model, pair);
  SpatialVector mine = SpatialVector::Zero(model.dimension);
  const auto subtract = [&](std::size_t p, double sign) {
    for (std::size_t s = 0; s < at.multipliers[p].size(); ++s) mine -= sign * at.contact->pairs[p].resultant(s, at.multipliers[p][s].z);
  };
  subtract(pair, 1.0);
  if (const auto other = model.second_pass(pair)) subtract(*other, -1.0);  // its slave side is the master here
  std::array<double, 3> all{};
  for (int i = 0; i < model.dimension; ++i) all[i] = model.sum(mine[i]);
  return all;
}

}  // namespace mortise
