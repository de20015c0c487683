// What can be known of the pairs at an iterate: states of nodes, resultants, kinks.

#include "mortise/contact/contact_report.hpp"

#include <Tpetra_Import.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_MultiVector.hpp>
#include <Tpetra_Vector.hpp>
#include <algorithm>

#include "evaluated_contact.hpp"

namespace mortise {

CornerReport corners(const ContactEvaluation& evaluation, std::size_t pair) {
  const detail::EvaluatedContact& contact = detail::evaluated(evaluation);
  const detail::ContactModel& model = *contact.model;
  CornerReport report;
  report.rule = model.pairs[pair]->corner_rule();
  report.as_asked = report.rule == model.pairs[pair]->definition().options.mortar.corners;
  long mine = model.pairs[pair]->interface().kinks(*contact.positions);
  if (const auto other = model.second_pass(pair)) mine += model.pairs[*other]->interface().kinks(*contact.positions);
  report.kinks = static_cast<long>(model.sum(static_cast<double>(mine)));
  return report;
}

namespace {

/// z of the heirs of owned nodes [x dim], on the target of ContactModel::heirs. Collective.
RCP<const MultiVector> of_heirs(const detail::EvaluatedLaws& at, std::size_t pair) {
  const RCP<const Import>& import = at.contact->model->heirs[pair];
  const auto z = at.z->getLocalViewHost(Tpetra::Access::ReadOnly);
  const RCP<MultiVector> owned = at.contact->model->owned_multipliers(pair, z, import->getSourceMap());
  const auto result = rcp(new MultiVector(import->getTargetMap(), owned->getNumVectors()));
  result->doImport(*owned, *import, Tpetra::INSERT);
  return result;
}

}  // namespace

std::vector<ContactNodeState> node_states(const ContactLaws& laws, std::size_t pair) {
  const detail::EvaluatedLaws& at = detail::evaluated(laws);
  const detail::PairEvaluation& of_pair = at.contact->pairs[pair];
  const FrictionLaw* friction = of_pair.pair().friction();
  std::vector<ContactNodeState> states;
  RCP<const MultiVector> inherited;
  if (!at.contact->model->heirs[pair].is_null()) inherited = of_heirs(at, pair);
  for (std::size_t s = 0; s < at.laws[pair].size(); ++s) {
    const SlaveNode& slave = of_pair.slave_nodes()[s];
    const detail::NodeRow& row = of_pair.row(s);
    SpatialVector zs = at.multipliers[pair][s].z;
    const SpatialVector force = of_pair.resultant(s, zs);
    if (!slave.heirs.empty()) {
      const auto z = inherited->getLocalViewHost(Tpetra::Access::ReadOnly);
      for (const auto& [id, share] : slave.heirs)
        for (Eigen::Index i = 0; i < zs.size(); ++i) zs[i] += share * z(inherited->getMap()->getLocalElement(id), static_cast<std::size_t>(i));
    }
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
    state.state = at.state(pair, s);
    state.closed = state.state != ContactState::open;
    state.covered = row.covered;
    state.shear = signed_size(across);
    if (friction != nullptr && row.covered > 0.0) {
      state.slip = signed_size(of_pair.geometry()->slips[s].slip) / row.covered;
      state.slip_path = of_pair.slip_path(s, state.state);
      if (state.closed) state.shear_bound = friction->bound(std::max(0.0, state.pressure), of_pair.history().slip->paths[s]).value;
    }
    std::copy(force.begin(), force.end(), state.force.begin());
    states.push_back(state);
  }
  return states;
}

double allowed_overlap(const ContactLaws& laws, std::size_t pair) {
  const detail::EvaluatedContact& contact = *detail::evaluated(laws).contact;
  const detail::PairEvaluation& of_pair = contact.pairs[pair];
  double clearance = 0.0;
  for (std::size_t s = 0; s < of_pair.slave_nodes().size(); ++s) clearance = std::max(clearance, of_pair.clearance(s));
  return contact.model->maximum(clearance) + of_pair.history().allowed_overlap;
}

std::array<double, 3> resultant(const ContactLaws& laws, std::size_t pair) {
  const detail::EvaluatedLaws& at = detail::evaluated(laws);
  const detail::ContactModel& model = *at.contact->model;
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
