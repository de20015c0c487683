// Histories: of the start, of an accepted state, with the kinks that it calls for.

#include "mortise/contact/contact_history.hpp"

#include <fmt/format.h>

#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_MultiVector.hpp>
#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <stdexcept>
#include <utility>

#include "evaluation/arguments.hpp"
#include "evaluation/evaluated_contact.hpp"

namespace mortise {

ContactHistory::ContactHistory(AcceptedContact accepted) : accepted_(std::make_shared<const AcceptedContact>(std::move(accepted))) {}

namespace detail {
namespace {

/// The slip references, starts and cover of a state, where `paths` are slipped and nodes do what `states` says.
AcceptedContact accepted_state(const EvaluatedContact& contact, const RCP<const Vector>& z,
                               const std::vector<std::vector<NodeMultiplier>>& multipliers, ContactStates states,
                               std::vector<std::vector<double>> paths) {
  AcceptedContact result{contact.history->pairs, std::move(states), contact.positions, z, contact.model->layout};
  for (std::size_t p = 0; p < contact.pairs.size(); ++p) {
    const PairEvaluation& pair = contact.pairs[p];
    PairHistory& history = result.pairs[p];
    if (pair.pair().friction() != nullptr)
      history.slip = pair.slip_references(multipliers[p], result.states[p].states, std::move(paths[p]), contact.positions);
    if (pair.pair().corner_rule() == CornerRule::nearest_facet) history.nearest_facets = pair.nearest_facets();
    if (pair.pair().definition().has_conditions_on_rate) history.start_gaps = pair.mean_gaps();
  }
  return result;
}

}  // namespace

ContactHistory with_kinks_of_its_state(const std::shared_ptr<const ContactModel>& model, const ContactHistory& accepted) {
  std::vector<SurfaceKinks> kinks;
  double mine = 0.0;
  for (std::size_t p = 0; p < model->pairs.size(); ++p) {
    kinks.push_back(model->pairs[p]->choose_kinks(*accepted->positions, accepted->pairs[p]));
    if (!(kinks.back() == accepted->pairs[p].kinks)) mine = 1.0;
  }
  if (model->maximum(mine) == 0.0) return accepted;
  AcceptedContact with_kinks = *accepted;
  for (std::size_t p = 0; p < kinks.size(); ++p) with_kinks.pairs[p].kinks = kinks[p];
  // Couplings at kinks are others: so is what slips are measured against.
  const auto contact = model->evaluate(model, accepted->positions, ContactHistory(with_kinks), nullptr, false);
  std::vector<std::vector<NodeMultiplier>> multipliers;
  std::vector<std::vector<double>> paths;
  for (std::size_t p = 0; p < kinks.size(); ++p) {
    multipliers.push_back(contact->multipliers_of(*accepted->multipliers, p));
    paths.push_back(accepted->pairs[p].slip == nullptr ? std::vector<double>() : accepted->pairs[p].slip->paths);
  }
  AcceptedContact result = accepted_state(*contact, accepted->multipliers, multipliers, accepted->states, std::move(paths));
  for (std::size_t p = 0; p < kinks.size(); ++p) {
    result.pairs[p].nearest_facets = accepted->pairs[p].nearest_facets;
    for (std::size_t s = 0; s < result.pairs[p].starts.size(); ++s) contact->pairs[p].set_stiffness(s, result.pairs[p].starts[s]);
  }
  return ContactHistory(std::move(result));
}

}  // namespace detail

ContactHistory ContactSystem::initial_history(const NodalDisplacement& d) const {
  const detail::ContactModel& model = *model_;
  detail::Arguments(model, "initial_history").displacement(d).agree();
  AcceptedContact blank;
  for (const auto& pair : model.pairs) blank.pairs.push_back(pair->blank_history());
  const auto x = model.positions(d);
  const auto normals = model.evaluate(model_, x, ContactHistory(blank), nullptr, false);
  for (std::size_t p = 0; p < model.pairs.size(); ++p) blank.pairs[p].axes = normals->pairs[p].choose_axes();
  const auto contact = normals->with(ContactHistory(blank));
  const RCP<const Vector> none = rcp(new Vector(model.multipliers));
  ContactStates states;
  std::vector<std::vector<detail::NodeMultiplier>> multipliers;
  std::vector<std::vector<double>> paths;
  for (std::size_t p = 0; p < model.pairs.size(); ++p) {
    const std::size_t nodes = model.pairs[p]->slave_nodes().size();
    states.push_back({std::vector<ContactState>(nodes, ContactState::open), {}});
    for (std::size_t s = 0; s < nodes; ++s) states[p].covered.push_back(contact->pairs[p].covered(s));
    multipliers.push_back(contact->multipliers_of(*none, p));
    paths.emplace_back(nodes, 0.0);
  }
  AcceptedContact result = detail::accepted_state(*contact, none, multipliers, std::move(states), std::move(paths));
  for (std::size_t p = 0; p < model.pairs.size(); ++p)
    for (std::size_t s = 0; s < result.pairs[p].starts.size(); ++s) contact->pairs[p].set_stiffness(s, result.pairs[p].starts[s]);
  return ContactHistory(std::move(result));
}

ContactHistory ContactSystem::carry_over(const ContactSystem& before, const ContactHistory& accepted) const {
  const detail::ContactModel &model = *model_, &other = *before.model_;
  detail::Arguments(other, "carry_over").history(accepted).agree();
  const double differs = model.layout != other.layout || !model.owned_nodes->locallySameAs(*other.owned_nodes) ? 1.0 : 0.0;
  if (model.maximum(differs) > 0.0)
    throw std::invalid_argument(
        "contact: carry_over() from a system with other slave nodes, or nodes on other ranks; take store() and restore(), which go by ids");
  AcceptedContact carried = *accepted;
  const auto z = rcp(new Vector(model.multipliers));
  const auto to = z->getLocalViewHost(Tpetra::Access::ReadWrite);
  const auto from = accepted->multipliers->getLocalViewHost(Tpetra::Access::ReadOnly);
  std::vector<std::vector<double>> paths;
  for (std::size_t p = 0; p < model.pairs.size(); ++p) {
    carried.pairs[p].axes = model.pairs[p]->blank_history().axes;
    carried.pairs[p].slip.reset();
    paths.push_back(accepted->pairs[p].slip ? accepted->pairs[p].slip->paths : std::vector<double>());
    for (std::size_t s = 0; s < model.multiplier_of[p].size(); ++s) {
      const LocalOrdinal first = model.multiplier_of[p][s];
      if (first < 0) carried.states[p].states[s] = ContactState::open;
      const SpatialVector of_node = other.z_of(from, p, s);
      for (int i = 0; i < model.dimension && first >= 0; ++i) to(first + i, 0) = of_node[i];
    }
  }
  carried.multipliers = z;
  carried.layout = model.layout;
  const auto normals = model.evaluate(model_, accepted->positions, ContactHistory(carried), nullptr, false);
  for (std::size_t p = 0; p < model.pairs.size(); ++p) carried.pairs[p].axes = normals->pairs[p].choose_axes();
  const auto contact = normals->with(ContactHistory(carried));
  std::vector<std::vector<detail::NodeMultiplier>> multipliers;
  for (std::size_t p = 0; p < model.pairs.size(); ++p) {
    multipliers.push_back(contact->multipliers_of(*z, p));
    for (std::size_t s = 0; s < carried.states[p].covered.size(); ++s) carried.states[p].covered[s] = contact->pairs[p].covered(s);
  }
  return ContactHistory(detail::accepted_state(*contact, z, multipliers, carried.states, std::move(paths)));
}

ContactHistory ContactSystem::commit(const ContactLaws& laws) const {
  const detail::EvaluatedLaws& at = detail::evaluated(laws);
  detail::require_own(*model_, *at.contact->model, "commit");
  const ContactStates states = laws.states();
  AcceptedContact turned = *at.contact->history;
  std::vector<std::vector<double>> paths(at.contact->pairs.size());
  for (std::size_t p = 0; p < at.contact->pairs.size(); ++p) {
    const detail::PairEvaluation& pair = at.contact->pairs[p];
    if (model_->dimension > 2) turned.pairs[p].axes = pair.choose_axes();
    if (pair.pair().friction() == nullptr) continue;
    for (std::size_t s = 0; s < states[p].states.size(); ++s) paths[p].push_back(pair.slip_path(s, states[p].states[s]));
  }
  const auto contact = at.contact->with(ContactHistory(std::move(turned)));
  AcceptedContact result = detail::accepted_state(*contact, at.z, at.multipliers, states, std::move(paths));
  for (std::size_t p = 0; p < contact->pairs.size(); ++p)
    for (std::size_t s = 0; s < result.pairs[p].starts.size(); ++s)
      result.pairs[p].starts[s] = contact->pairs[p].start_from(s, at.multipliers[p][s].z);
  for (PairHistory& pair : result.pairs) pair.constant_share = 1.0;
  return ContactHistory(std::move(result));
}

ContactHistory ContactSystem::allow_overlap(const ContactHistory& history, std::size_t pair, double depth) const {
  detail::require_pair(*model_, pair);
  detail::Arguments(*model_, "allow_overlap").history(history).number(depth, "depth", depth >= 0.0, "0 or more").agree();
  AcceptedContact changed = *history;
  changed.pairs[pair].allowed_overlap = depth;
  if (const auto other = second_pass(pair)) changed.pairs[*other].allowed_overlap = depth;
  return ContactHistory(std::move(changed));
}

ContactHistory ContactSystem::weigh_gaps(const ContactHistory& history, double share) const {
  detail::Arguments(*model_, "weigh_gaps").history(history).number(share, "share", share > 0.0, "above 0").agree();
  AcceptedContact changed = *history;
  for (std::size_t p = 0; p < model_->pairs.size(); ++p)
    if (model_->pairs[p]->enforcement().holds_exactly()) changed.pairs[p].constant_share = share;
  return ContactHistory(std::move(changed));
}

ContactHistory ContactSystem::with_clearances(const ContactHistory& history, double time) const {
  detail::Arguments(*model_, "with_clearances").history(history).agree();
  const auto has_one = [](const auto& pair) { return pair->has_clearances(); };
  if (std::none_of(model_->pairs.begin(), model_->pairs.end(), has_one)) return history;
  AcceptedContact changed = *history;
  std::vector<Diagnostic> diagnostics;
  const auto reference = model_->reference->getLocalViewHost(Tpetra::Access::ReadOnly);
  const auto x = [&](const SlaveNode& node, std::size_t i) { return i < reference.extent(1) ? reference(node.owned_node, i) : 0.0; };
  for (std::size_t p = 0; p < model_->pairs.size(); ++p) {
    if (!has_one(model_->pairs[p])) continue;
    const auto& clearance = model_->pairs[p]->definition().options.clearance;
    const auto& of_facets = model_->pairs[p]->definition().facet_gaps;
    std::vector<double>& values = changed.pairs[p].clearances;
    values.clear();
    try {
      for (const SlaveNode& node : model_->pairs[p]->slave_nodes()) {
        values.push_back(clearance ? (*clearance)(time, x(node, 0), x(node, 1), x(node, 2)) : 0.0);
        if (of_facets) values.back() += (*of_facets)[static_cast<std::size_t>(node.owned_node)];
      }
    } catch (const InputError& error) {
      diagnostics.insert(diagnostics.end(), error.diagnostics().begin(), error.diagnostics().end());
    }
    const auto least = std::min_element(values.begin(), values.end());
    const double reach = model_->pairs[p]->interface().reach();
    if (least == values.end() || -*least <= reach) continue;
    const SlaveNode& node = model_->pairs[p]->slave_nodes()[static_cast<std::size_t>(least - values.begin())];
    diagnostics.push_back(
        {model_->pairs[p]->definition().place,
         fmt::format("the clearance at node {} is {:.6g} at t = {:.6g}: surfaces act on one another from a distance of {:.6g} on, beyond "
                     "the search reach {:.6g}, where nothing is looked for; please give a \"search reach\" above {:.6g}",
                     node.id, *least, time, -*least, reach, -*least)});
  }
  throw_if_any(model_->comm(), diagnostics);
  return ContactHistory(std::move(changed));
}

ContactHistory ContactSystem::with_temperatures(const ContactHistory& history, std::size_t pair, std::vector<double> temperatures) const {
  detail::require_pair(*model_, pair);
  const std::size_t slaves = model_->pairs[pair]->slave_nodes().size();
  if (temperatures.size() != slaves)
    throw std::invalid_argument(fmt::format("contact: with_temperatures() with {} values for the {} slave nodes of pair '{}' on this rank",
                                            temperatures.size(), slaves, pair_name(pair)));
  AcceptedContact changed = *history;
  changed.pairs[pair].temperatures = std::move(temperatures);
  return ContactHistory(std::move(changed));
}

long friction_bytes(const ContactHistory& history) {
  std::size_t bytes = 0;
  for (const PairHistory& pair : history->pairs) {
    if (pair.slip == nullptr) continue;
    const SlipReferences& slip = *pair.slip;
    const std::size_t per_node = sizeof(slip.nodes[0]) + sizeof(slip.coefficients[0]) + sizeof(slip.positions[0]) + sizeof(slip.ties[0]) +
                                 sizeof(slip.tractions[0]) + 2 * sizeof(double);
    bytes += slip.nodes.capacity() * per_node;
    for (std::size_t s = 0; s < slip.nodes.size(); ++s)
      bytes += slip.nodes[s].capacity() * sizeof(GlobalOrdinal) + slip.coefficients[s].capacity() * sizeof(double);
  }
  const double mine = static_cast<double>(bytes);
  double all = 0.0;
  Teuchos::reduceAll(*history->positions->getMap()->getComm(), Teuchos::REDUCE_SUM, mine, Teuchos::outArg(all));
  return static_cast<long>(all);
}

}  // namespace mortise
