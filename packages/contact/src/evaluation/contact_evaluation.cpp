// The conditions of contact at one displacement: forces, laws, norms.

#include "mortise/contact/contact_evaluation.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_Export.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_MultiVector.hpp>
#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <cmath>
#include <limits>

#include "evaluation/arguments.hpp"
#include "evaluation/evaluated_contact.hpp"
#include "mortise/core/dof_map.hpp"

namespace mortise {

namespace detail {

const EvaluatedContact& evaluated(const ContactEvaluation& evaluation) { return *evaluation.evaluated_; }
const EvaluatedLaws& evaluated(const ContactLaws& laws) { return *laws.laws_; }

std::shared_ptr<const EvaluatedContact> EvaluatedContact::with(const ContactHistory& other) const {
  const auto result = std::make_shared<EvaluatedContact>(EvaluatedContact{model, other, positions, {}, dofs});
  for (std::size_t p = 0; p < pairs.size(); ++p) result->pairs.emplace_back(pairs[p].pair(), pairs[p].geometry(), other, p);
  return result;
}

std::vector<NodeMultiplier> EvaluatedContact::multipliers_of(const Vector& z, std::size_t pair) const {
  const auto values = z.getLocalViewHost(Tpetra::Access::ReadOnly);
  std::vector<NodeMultiplier> result;
  for (std::size_t s = 0; s < model->multiplier_of[pair].size(); ++s) result.emplace_back(model->z_of(values, pair, s));
  const MultiplierTies& ties = pairs[pair].ties();
  if (!ties.any()) return result;
  const RCP<MultiVector> q = ties.gradient(*ties.on_nodes(*model->owned_multipliers(pair, values, ties.owned_nodes())), model->dimension);
  const std::vector<double> diagonal = ties.diagonal();
  const auto view = q->getLocalViewHost(Tpetra::Access::ReadOnly);
  for (std::size_t s = 0; s < result.size(); ++s) {
    if (diagonal[s] == 0.0) continue;
    result[s].tie = ties.compliance(s);
    result[s].shift.resize(model->dimension);
    for (int i = 0; i < model->dimension; ++i) result[s].shift[i] = view(s, i);
  }
  return result;
}

// f_c = sum_j c_jm z_j at each node m that slave node j is coupled to, D_jj z_j at j itself; with variational mortar see coupled_part().
void EvaluatedContact::add_force(const Vector& z, Vector& r) const {
  const auto scope = model->timers.scope("contact");
  const auto part = model->timers.scope("contact residual");
  const int dimension = model->dimension;
  const auto values = z.getLocalViewHost(Tpetra::Access::ReadOnly);
  for (std::size_t p = 0; p < pairs.size(); ++p) {
    const PairEvaluation& pair = pairs[p];
    const InterfaceDofs& places = *dofs[p];
    Vector force(places.map);
    {
      const auto view = force.getLocalViewHost(Tpetra::Access::ReadWrite);
      const auto add = [&](LocalOrdinal node, int i, double value) {
        if (const LocalOrdinal place = places.places[static_cast<std::size_t>(dimension * node + i)]; place >= 0) view(place, 0) += value;
      };
      for (std::size_t s = 0; s < pair.slave_nodes().size(); ++s) {
        const SpatialVector zs = model->z_of(values, p, s);
        if (zs.isZero(0.0)) continue;
        const SpatialVector through = pair.coupled_part(s, zs);
        const double pressure = pair.gap_pressure(s, zs);
        const NodeRow& row = pair.row(s);
        const std::vector<LocalOrdinal>& coupled = pair.coupled_nodes(s);
        for (int i = 0; i < dimension; ++i) {
          add(pair.slave_nodes()[s].local_node, i, row.D * through[i]);
          for (std::size_t c = 0; c < coupled.size(); ++c) add(coupled[c], i, row.coefficients[c] * through[i]);
          if (pressure != 0.0)
            for (std::size_t c = 0; c < coupled.size(); ++c) add(coupled[c], i, -pressure * row.dgap[dimension * c + i]);
        }
      }
    }
    // An export with ADD replaces what the rank itself sends to itself: hence a vector in between that starts at zero.
    Vector on_dofs(model->dofs);
    on_dofs.doExport(force, *places.to_owners, Tpetra::ADD);
    r.update(1.0, on_dofs, 1.0);
  }
}

}  // namespace detail

namespace {

/// Collective. Throws StepFailure for multipliers that are no numbers.
void refuse_not_finite(const detail::ContactModel& model, const Vector& z) {
  std::optional<StepFailure> failure;
  const auto values = z.getLocalViewHost(Tpetra::Access::ReadOnly);
  for (std::size_t p = 0; p < model.pairs.size() && !failure; ++p)
    for (std::size_t s = 0; s < model.multiplier_of[p].size() && !failure; ++s)
      if (const SpatialVector zs = model.z_of(values, p, s); !zs.allFinite())
        failure = StepFailure(FailureKind::not_finite,
                              fmt::format("the multiplier of pair '{}' at node {} is not finite: ({:g})", model.pairs[p]->definition().name,
                                          model.pairs[p]->slave_nodes()[s].id, fmt::join(zs.data(), zs.data() + zs.size(), ", ")));
  throw_if_any(model.comm(), failure);
}

}  // namespace

ContactLaws ContactEvaluation::laws(const Vector& z) const {
  const detail::ContactModel& model = *evaluated_->model;
  detail::Arguments(model, "laws").on_multipliers(z, "z").agree();
  const auto scope = model.timers.scope("contact");
  const auto part = model.timers.scope("contact residual");
  refuse_not_finite(model, z);
  const auto result = std::make_shared<detail::EvaluatedLaws>(detail::EvaluatedLaws{*this, evaluated_, rcp(new Vector(z, Teuchos::Copy)), {}, {}});
  for (std::size_t p = 0; p < evaluated_->pairs.size(); ++p) {
    result->multipliers.push_back(evaluated_->multipliers_of(z, p));
    std::vector<Complementarity>& laws = result->laws.emplace_back(model.multiplier_of[p].size());
    for (std::size_t s = 0; s < laws.size(); ++s)
      if (model.multiplier_of[p][s] >= 0) laws[s] = evaluated_->pairs[p].complementarity(s, result->multipliers[p][s]);
  }
  return ContactLaws(result);
}

void ContactEvaluation::add_force(const Vector& z, Vector& r) const {
  detail::Arguments(*evaluated_->model, "add_force").on_multipliers(z, "z").on_dofs(r, "r").agree();
  evaluated_->add_force(z, r);
}

ContactEvaluation ContactEvaluation::with(const ContactHistory& history) const {
  detail::Arguments(*evaluated_->model, "with").history(history).agree();
  return ContactEvaluation(evaluated_->with(history));
}
DifferentiatedContact DifferentiatedContact::with(const ContactHistory& history) const {
  detail::Arguments(*evaluated_->model, "with").history(history).agree();
  return DifferentiatedContact(evaluated_->with(history));
}

RCP<Vector> ContactEvaluation::shear_tractions(const Vector& z) const {
  const detail::ContactModel& model = *evaluated_->model;
  detail::Arguments(model, "shear_tractions").on_multipliers(z, "z").agree();
  const auto shear = rcp(new Vector(model.multipliers));
  const auto values = z.getLocalViewHost(Tpetra::Access::ReadOnly);
  const auto result = shear->getLocalViewHost(Tpetra::Access::ReadWrite);
  for (std::size_t p = 0; p < model.pairs.size(); ++p) {
    if (model.pairs[p]->friction() == nullptr) continue;
    for (std::size_t s = 0; s < model.multiplier_of[p].size(); ++s) {
      const LocalOrdinal first = model.multiplier_of[p][s];
      if (first < 0) continue;
      const SpatialVector zs = model.z_of(values, p, s), &normal = evaluated_->pairs[p].row(s).normal, across = zs - zs.dot(normal) * normal;
      for (int i = 0; i < model.dimension; ++i) result(first + i, 0) = across[i];
    }
  }
  return shear;
}

ContactStates ContactLaws::states() const {
  ContactStates states;
  for (std::size_t p = 0; p < laws_->laws.size(); ++p) {
    PairStates& pair = states.emplace_back();
    for (std::size_t s = 0; s < laws_->laws[p].size(); ++s) {
      pair.states.push_back(laws_->state(p, s));
      pair.covered.push_back(laws_->contact->pairs[p].covered(s));
    }
  }
  return states;
}

void ContactLaws::complementarity(Vector& C) const {
  const detail::ContactModel& model = *laws_->contact->model;
  detail::Arguments(model, "complementarity").on_multipliers(C, "C").agree();
  const auto result = C.getLocalViewHost(Tpetra::Access::OverwriteAll);
  for (std::size_t p = 0; p < laws_->laws.size(); ++p)
    for (std::size_t s = 0; s < laws_->laws[p].size(); ++s)
      for (int i = 0; i < model.dimension && model.multiplier_of[p][s] >= 0; ++i) result(model.multiplier_of[p][s] + i, 0) = laws_->laws[p][s].C[i];
}

void ContactLaws::add_force(Vector& r) const {
  detail::Arguments(*laws_->contact->model, "add_force").on_dofs(r, "r").agree();
  laws_->contact->add_force(*laws_->z, r);
}
const Vector& ContactLaws::multipliers() const { return *laws_->z; }
const ContactEvaluation& ContactLaws::evaluation() const { return laws_->evaluation; }

ContactNorms ContactLaws::norms(const ContactStates& last) const {
  const detail::ContactModel& model = *laws_->contact->model;
  detail::Arguments(model, "norms").states(last).agree();
  const auto scope = model.timers.scope("contact");
  const auto part = model.timers.scope("contact residual");
  enum Largest { gap, violation, traction, floor, round_off, count_of_largest };
  enum Sum { active, sticking, changed, squares, force, count_of_sums };
  std::array<double, count_of_largest> mine{}, largest{};
  std::array<double, count_of_sums> own{}, sums{};
  for (std::size_t p = 0; p < laws_->laws.size(); ++p) {
    const detail::PairEvaluation& of_pair = laws_->contact->pairs[p];
    const detail::Pair& pair = of_pair.pair();
    mine[floor] = std::max(mine[floor], 1e-9 * pair.definition().youngs_modulus);
    // Round-off of positions in c g and c u; penalty weighs them with less, c eps / (c + eps). Augmented Lagrange is judged by the
    // return map, not by its C, in which gaps count for 1 + eps/c times less. By C, multipliers would be updated from gaps below Newton's
    // tolerance.
    const bool updated = pair.enforcement().updates().has_value();
    mine[round_off] = std::max(mine[round_off], updated ? of_pair.mismatch_of(model.position_round_off())
                                                        : model.position_round_off() * pair.definition().youngs_modulus / pair.size());
    for (std::size_t s = 0; s < laws_->laws[p].size(); ++s) {
      if (model.multiplier_of[p][s] < 0) continue;
      const detail::NodeMultiplier& multiplier = laws_->multipliers[p][s];
      const Complementarity& law = laws_->laws[p][s];
      const bool closed = law.state != ContactState::open;
      const SpatialVector& C = law.C;
      const double weight = pair.slave_nodes()[s].weight;
      own[squares] += std::pow(weight, 2) * C.squaredNorm();
      if (!C.allFinite()) mine[violation] = std::numeric_limits<double>::infinity();  // largest values leave out what is no number
      mine[traction] = std::max(mine[traction], multiplier.z.norm());
      const bool exactly_closed = closed && pair.enforcement().holds_exactly();  // then C_n is the gap
      mine[violation] = std::max(mine[violation], updated          ? std::max(of_pair.mismatch(s, multiplier), C.norm())
                                                  : exactly_closed ? C.tail(model.dimension - 1).norm()
                                                                   : C.norm());
      if (exactly_closed) mine[gap] = std::max(mine[gap], std::abs(of_pair.gap(s, multiplier)) / (weight * pair.size()));
      own[active] += closed;
      own[sticking] += law.state == ContactState::stick;
      own[changed] += law.state != last[p].states[s];
    }
  }
  Vector forces(model.dofs);
  laws_->contact->add_force(*laws_->z, forces);
  {
    const auto values = forces.getLocalViewHost(Tpetra::Access::ReadOnly);
    for (std::size_t i = 0; i < values.extent(0); ++i) own[force] += values(i, 0) * values(i, 0);
  }
  Teuchos::reduceAll(model.comm(), Teuchos::REDUCE_MAX, static_cast<int>(mine.size()), mine.data(), largest.data());
  Teuchos::reduceAll(model.comm(), Teuchos::REDUCE_SUM, static_cast<int>(own.size()), own.data(), sums.data());
  ContactNorms norms;
  norms.gap = largest[gap];
  norms.complementarity = largest[violation] <= largest[round_off] ? 0.0 : largest[violation] / std::max(largest[traction], largest[floor]);
  norms.violation = std::sqrt(sums[squares]);
  norms.active = static_cast<int>(sums[active]);
  norms.sticking = static_cast<int>(sums[sticking]);
  norms.changed = static_cast<int>(sums[changed]);
  norms.force = std::sqrt(sums[force]);
  return norms;
}

std::optional<StepFailure> ContactLaws::friction_failure() const {
  const detail::EvaluatedContact& contact = *laws_->contact;
  const auto reference = contact.model->reference->getLocalViewHost(Tpetra::Access::ReadOnly);
  for (std::size_t p = 0; p < contact.pairs.size(); ++p)
    for (std::size_t s = 0; s < laws_->laws[p].size(); ++s) {
      if (contact.model->multiplier_of[p][s] < 0) continue;
      std::optional<Diagnostic> missing_bound;
      contact.pairs[p].complementarity(s, laws_->multipliers[p][s], &missing_bound);
      if (!missing_bound) continue;
      std::vector<double> position;
      for (int i = 0; i < contact.model->dimension; ++i) position.push_back(reference(contact.pairs[p].slave_nodes()[s].owned_node, i));
      missing_bound->message += fmt::format("; at the slave node of reference position ({:g})", fmt::join(position, ", "));
      return StepFailure(FailureKind::input, to_string(*missing_bound));
    }
  return std::nullopt;
}

}  // namespace mortise
