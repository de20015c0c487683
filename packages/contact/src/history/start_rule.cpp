// Guesses of multipliers, at the start of a step and where the cover changes. Only guesses: no residual is changed by them.

#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <cmath>

#include "evaluation/arguments.hpp"
#include "evaluation/evaluated_contact.hpp"
#include "mortise/contact/holding_nodes.hpp"

namespace mortise {
namespace {

constexpr double small_strain = 1e-6;  // the pressure it starts with, over Young's modulus
/// Sets z_n of slave node s of a pair, and nothing along the surface.
template <class View>
void set_pressure(const detail::ContactModel& model, const detail::PairEvaluation& pair, std::size_t p, std::size_t s, double z_n,
                  const View& values) {
  const LocalOrdinal first = model.multiplier_of[p][s];
  for (int i = 0; i < model.dimension; ++i) values(first + i, 0) = z_n * pair.row(s).normal[i];
}

double first_pressure(const detail::PairEvaluation& pair) { return small_strain * pair.pair().definition().youngs_modulus; }

}  // namespace

// The solution is continuous where a facet begins to be covered: nothing acts there, so r_b = z_b - sum_k T_bk z_k = 0. But T, a quotient of covers,
// is steep there, and with r_b != 0 as with z_b = 0 so would be the residual: its linearisation would be worth nothing. Nodes that begin to be
// covered together are tied to one another: z = T z is solved by sweeps.
bool ContactEvaluation::follow_cover(const ContactStates& last, Vector& z) const {
  constexpr int most_sweeps = 100;
  constexpr double settled = 1e-8;  // change of a sweep over the largest multiplier
  bool tied = false, changed = false;
  const detail::ContactModel& self = *evaluated_->model;
  detail::Arguments(self, "follow_cover").states(last).on_multipliers(z, "z").agree();
  const auto values = z.getLocalViewHost(Tpetra::Access::ReadWrite);
  for (std::size_t p = 0; p < self.pairs.size(); ++p) {
    const detail::PairEvaluation& pair = evaluated_->pairs[p];
    if (!pair.pair().has_ties()) continue;
    tied = true;
    const auto set = [&](std::size_t s, const SpatialVector& zs) {
      for (int i = 0; i < self.dimension; ++i) values(self.multiplier_of[p][s] + i, 0) = zs[i];
    };
    for (std::size_t s = 0; s < pair.slave_nodes().size(); ++s) {
      if (self.multiplier_of[p][s] < 0 || pair.covered(s) || self.z_of(values, p, s).isZero(0.0)) continue;
      set(s, SpatialVector::Zero(self.dimension));
      changed = true;
    }
    if (!pair.ties().any()) continue;
    std::vector<const detail::MultiplierTie*> new_ones;
    for (const detail::MultiplierTie& tie : pair.ties().ties())
      if (pair.covered(tie.node) && !last[p].covered[tie.node]) new_ones.push_back(&tie);
    if (self.maximum(new_ones.empty() ? 0.0 : 1.0) == 0.0) continue;
    changed = true;
    double change = 1.0, largest = 0.0;
    for (int sweep = 0; sweep < most_sweeps && change > settled * largest; ++sweep) {
      const RCP<MultiVector> on_nodes = pair.ties().on_nodes(*self.owned_multipliers(p, values, pair.ties().owned_nodes()));
      change = largest = 0.0;
      for (const detail::MultiplierTie* tie : new_ones) {
        const SpatialVector deviation = detail::MultiplierTies::deviation(*tie, *on_nodes), zs = self.z_of(values, p, tie->node) - deviation;
        set(tie->node, zs);
        change = std::max(change, deviation.norm());
        largest = std::max(largest, zs.norm());
      }
      change = self.maximum(change);
      largest = self.maximum(largest);
    }
    for (const detail::MultiplierTie* tie : new_ones) {
      detail::NodeMultiplier settled(self.z_of(values, p, tie->node));  // q_b of its own tie is 0
      settled.tie = tie->compliance;
      if (!pair.closed(tie->node, settled)) set(tie->node, SpatialVector::Zero(self.dimension));
    }
  }
  return tied && self.maximum(changed) > 0.0;
}

// A node whose gap is zero up to round-off would be open or closed at random: it starts closed, at a pressure that no result can see.
ContactHistory ContactSystem::start_step(const ContactHistory& accepted, const NodalDisplacement& d, Vector& z) const {
  const detail::ContactModel& self = *model_;
  detail::Arguments(self, "start_step").history(accepted).displacement(d).on_multipliers(z, "z").agree();
  const ContactHistory history = detail::with_kinks_of_its_state(model_, accepted);
  const ContactEvaluation evaluation = evaluate(d, history);
  const detail::EvaluatedContact& contact = detail::evaluated(evaluation);
  evaluation.follow_cover(history->states, z);

  const auto values = z.getLocalViewHost(Tpetra::Access::ReadWrite);
  for (std::size_t p = 0; p < self.pairs.size(); ++p) {
    const detail::PairEvaluation& pair = contact.pairs[p];
    const std::vector<detail::NodeMultiplier> multipliers = contact.multipliers_of(z, p);
    for (std::size_t s = 0; s < pair.slave_nodes().size(); ++s) {
      if (!pair.covered(s) || !pair.may_close(s)) {
        if (self.multiplier_of[p][s] >= 0) set_pressure(self, pair, p, s, 0.0, values);
        continue;
      }
      const double gap = pair.gap_to_onset(s) / pair.slave_nodes()[s].weight;
      if (std::abs(gap) < detail::touching * pair.pair().size() && !pair.closed(s, multipliers[s]))
        set_pressure(self, pair, p, s, first_pressure(pair), values);
    }
  }
  return history;
}

// A node sticks where |z_tau + c_t u| is below the bound. Above it, its condition is  z_tau = rho y / |y|.  Across y it is that of a spring of c_t
// rho / |y|: with |y| = 1e6 rho it holds nothing, and bears nothing that a result can see.
void guess_closed(const ContactLaws& laws, const BearingNode& node, Vector& z, bool slides) {
  constexpr double hardly_a_strain = 1e-15;
  const detail::EvaluatedContact& contact = *detail::evaluated(laws).contact;
  const detail::PairEvaluation& pair = contact.pairs[node.pair];
  const SlaveNode& slave = pair.slave_nodes()[node.slave];
  const double modulus = pair.pair().definition().youngs_modulus, across = std::max(0.0, pair.closing_pressure(node.slave));
  const auto values = z.getLocalViewHost(Tpetra::Access::ReadWrite);
  if (!slides || slave.partly_fixed() || pair.pair().friction() == nullptr) {
    set_pressure(*contact.model, pair, node.pair, node.slave, across + first_pressure(pair), values);
    return;
  }
  set_pressure(*contact.model, pair, node.pair, node.slave, across + hardly_a_strain * modulus, values);
  const SpatialVector shear = 1e6 * hardly_a_strain * modulus * pair.frame(node.slave).tangents.row(0).transpose();
  const LocalOrdinal first = contact.model->multiplier_of[node.pair][node.slave];
  for (int i = 0; i < contact.model->dimension; ++i) values(first + i, 0) += shear[i];
}

}  // namespace mortise
