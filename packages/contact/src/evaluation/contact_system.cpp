#include "mortise/contact/contact_system.hpp"

#include <fmt/format.h>

#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_CrsGraph.hpp>
#include <Tpetra_Export.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_MultiVector.hpp>
#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <cmath>
#include <set>

#include "evaluation/arguments.hpp"
#include "evaluation/checks.hpp"
#include "evaluation/crosspoints.hpp"
#include "evaluation/evaluated_contact.hpp"
#include "evaluation/option_checks.hpp"
#include "mortise/core/trilinos_versions.hpp"

namespace mortise {
namespace {

/// The error with the formulations that may replace one whose coupling is not made for the surfaces.
InputError with_other_formulations(const UnfitCoupling& unfit) {
  std::vector<Diagnostic> diagnostics = unfit.diagnostics();
  for (Diagnostic& one : diagnostics)
    one.message += "; use dual mortar, standard mortar, or penalty or augmented Lagrange with a mortar discretisation";
  return InputError(std::move(diagnostics));
}

}  // namespace

namespace detail {

std::optional<std::size_t> ContactModel::second_pass(std::size_t pair) const {
  for (std::size_t p = 0; p < pairs.size(); ++p)
    if (pairs[p]->definition().second_pass_of == pair) return p;
  return std::nullopt;
}

bool ContactModel::keeps_multipliers() const {
  return std::any_of(pairs.begin(), pairs.end(), [](const auto& pair) { return pair->enforcement().keeps_multipliers(); });
}

RCP<const MultiVector> ContactModel::positions(const NodalDisplacement& d) const {
  const auto x = rcp(new MultiVector(*reference, Teuchos::Copy));
  const auto u = d.dofs.getLocalViewHost(Tpetra::Access::ReadOnly);
  const auto view = x->getLocalViewHost(Tpetra::Access::ReadWrite);
  for (std::size_t node = 0; node < view.extent(0); ++node)
    for (std::size_t i = 0; i < view.extent(1); ++i)
      if (const LocalOrdinal row = rows[view.extent(1) * node + i]; row >= 0) view(node, i) += u(row, 0);
  if (d.nodes == nullptr) return x;
  const auto elsewhere = d.nodes->getLocalViewHost(Tpetra::Access::ReadOnly);
  for (std::size_t node = 0; node < view.extent(0); ++node)
    for (std::size_t i = 0; i < view.extent(1); ++i)
      if (rows[view.extent(1) * node + i] < 0) view(node, i) += elsewhere(node, i);
  return x;
}

std::shared_ptr<const InterfaceDofs> ContactModel::dofs_of(std::size_t pair, const std::shared_ptr<const InterfacePattern>& pattern) const {
  std::shared_ptr<const InterfaceDofs>& kept = interface_dofs[pair];
  if (kept && kept->pattern == pattern) return kept;
  const auto result = std::make_shared<InterfaceDofs>();
  result->pattern = pattern;
  result->ids = displacement.ids_on(pattern->local_nodes);
  std::vector<GlobalOrdinal> unknowns;
  for (const GlobalOrdinal id : result->ids) {
    result->places.push_back(id == NodalField::none ? -1 : static_cast<LocalOrdinal>(unknowns.size()));
    if (id != NodalField::none) unknowns.push_back(id);
  }
  const auto invalid = Teuchos::OrdinalTraits<Tpetra::global_size_t>::invalid();
  result->map = rcp(new Map(invalid, unknowns.data(), static_cast<LocalOrdinal>(unknowns.size()), 0, dofs->getComm()));
  result->to_owners = rcp(new Export(result->map, dofs));
  for (const NodalField& field : further) result->further.push_back(field.ids_on(pattern->local_nodes));
  return kept = result;
}

RCP<Vector> ContactModel::weights() const {
  const auto result = rcp(new Vector(multipliers));
  const auto view = result->getLocalViewHost(Tpetra::Access::OverwriteAll);
  for (std::size_t p = 0; p < pairs.size(); ++p)
    for (std::size_t s = 0; s < multiplier_of[p].size(); ++s)
      for (int i = 0; i < dimension; ++i)
        if (const LocalOrdinal first = multiplier_of[p][s]; first >= 0) view(first + i, 0) = pairs[p]->slave_nodes()[s].weight;
  return result;
}

double ContactModel::sum(double value) const {
  double all = 0.0;
  Teuchos::reduceAll(comm(), Teuchos::REDUCE_SUM, value, Teuchos::outArg(all));
  return all;
}

double ContactModel::maximum(double value) const {
  double all = 0.0;
  Teuchos::reduceAll(comm(), Teuchos::REDUCE_MAX, value, Teuchos::outArg(all));
  return all;
}

namespace {

/// A node of this rank whose position is no number, also away from all surfaces: a search is left out by how far all nodes have moved.
std::optional<StepFailure> find_lost_position(const Map& owned_nodes, const MultiVector& x) {
  const auto places = x.getLocalViewHost(Tpetra::Access::ReadOnly);
  for (std::size_t i = 0; i < places.extent(1); ++i)
    for (std::size_t node = 0; node < places.extent(0); ++node)
      if (!std::isfinite(places(node, i)))
        return StepFailure(FailureKind::not_finite,
                           fmt::format("the position of node {} is not finite", owned_nodes.getGlobalElement(static_cast<LocalOrdinal>(node))));
  return std::nullopt;
}

}  // namespace

std::shared_ptr<const EvaluatedContact> ContactModel::evaluate(const std::shared_ptr<const ContactModel>& self, const RCP<const MultiVector>& x,
                                                               const ContactHistory& history, const ContactStates* last, bool derivatives) const {
  const auto scope = timers.scope("contact");
  const auto result = std::make_shared<EvaluatedContact>(EvaluatedContact{self, history, x, {}, {}});
  std::optional<StepFailure> failure;
  for (std::size_t p = 0; p < pairs.size(); ++p) {
    const PairHistory& of_pair = history->pairs[p];
    {
      const auto part = timers.scope("search");
      pairs[p]->search(*x, of_pair);
    }
    const auto part = timers.scope("contact integrals");
    result->pairs.emplace_back(*pairs[p], pairs[p]->evaluate(*x, of_pair, derivatives, failure), history, p);
    result->dofs.push_back(dofs_of(p, result->pairs.back().geometry()->pattern));
  }
  {
    const auto part = timers.scope("search");
    if (!history->positions.is_null()) {
      const std::optional<StepFailure> lost = find_lost_contact(*result, last, failure.has_value());
      if (lost) failure = lost;
    }
  }
  if (!failure) failure = find_lost_position(*owned_nodes, *x);
  throw_if_any(comm(), failure);
  return result;
}

}  // namespace detail

ContactSystem::ContactSystem(const RCP<const Map>& owned_nodes, RCP<const Map> dofs, RCP<const MultiVector> reference, RCP<const MultiVector> fixed,
                             const InterfaceMeasure& measure, std::vector<ContactPair> pairs, const Timers& timers, std::vector<NodalField> further)
    : ContactSystem(numbered_by_nodes("displacement", detail::given(owned_nodes, "owned_nodes"),
                                      static_cast<int>(detail::given(reference, "reference")->getNumVectors())),
                    std::move(dofs), reference, std::move(fixed), measure, std::move(pairs), timers, std::move(further)) {}

ContactSystem::ContactSystem(const NodalField& displacement, RCP<const Map> dofs, RCP<const MultiVector> reference, RCP<const MultiVector> fixed,
                             const InterfaceMeasure& measure, std::vector<ContactPair> pairs, const Timers& timers, std::vector<NodalField> further) {
  detail::refuse_unfit_fields(displacement, *detail::given(dofs, "dofs"), *detail::given(reference, "reference"), *detail::given(fixed, "fixed"));
  if (!(measure.thickness > 0.0) || !std::isfinite(measure.thickness))
    throw std::invalid_argument(fmt::format("contact: the thickness of `measure` is {}; give a finite number above 0", measure.thickness));
  for (const NodalField& field : further) detail::refuse_unfit_field(field, *displacement.nodes(), *dofs);
  for (ContactPair& pair : pairs)
    if (pair.place.path.empty()) pair.place.path = "contact/" + pair.name;
  detail::refuse_incomplete_pairs(*displacement.nodes(), pairs);
  detail::refuse_wrong_options(*dofs->getComm(), pairs);
  const auto model = std::make_shared<detail::ContactModel>(displacement);
  detail::ContactModel& self = *model;
  self.dofs = std::move(dofs);
  self.reference = std::move(reference);
  self.fixed = detail::without_crosspoints(fixed);
  self.timers = timers;
  self.dimension = static_cast<int>(self.reference->getNumVectors());
  for (std::size_t i = 0; i < self.reference->getNumVectors(); ++i) self.extent = std::max(self.extent, self.reference->getVector(i)->normInf());
  const auto fixed_of_pairs = detail::with_crosspoints(self.owned_nodes, fixed, pairs);
  for (ContactPair& pair : pairs) {
    const Formulation& formulation = *pair.options.formulation.options;
    pair.options.mortar.coupling = formulation.coupling();
    pair.options.mortar.share = formulation.two_pass() ? 0.5 : 1.0;
    try {
      self.pairs.push_back(
          std::make_unique<detail::Pair>(self.owned_nodes, self.reference, fixed_of_pairs[self.pairs.size()], measure, std::move(pair)));
    } catch (const UnfitCoupling& unfit) {
      throw with_other_formulations(unfit);
    }
  }
  self.interface_dofs.resize(self.pairs.size());
  for (LocalOrdinal node = 0; node < static_cast<LocalOrdinal>(local_id_count(*self.owned_nodes)); ++node)
    for (int i = 0; i < self.dimension; ++i) {
      const GlobalOrdinal id = displacement.id(node, i);
      self.rows.push_back(id == NodalField::none ? -1 : self.dofs->getLocalElement(id));
    }
  self.further = std::move(further);

  // Ids of z: those of the nodes' dofs, beyond all dofs.
  const GlobalOrdinal offset = self.dofs->getMaxAllGlobalIndex() + 1;
  std::vector<GlobalOrdinal> ids;
  for (const auto& pair : self.pairs) {
    std::vector<LocalOrdinal> first;
    for (const SlaveNode& slave : pair->slave_nodes()) {
      first.push_back(slave.carries_multiplier ? static_cast<LocalOrdinal>(ids.size()) : -1);
      if (!slave.carries_multiplier) continue;
      for (int i = 0; i < self.dimension; ++i) ids.push_back(offset + self.dimension * slave.id + i);
    }
    self.multiplier_of.push_back(std::move(first));
    std::set<LocalOrdinal> masters;
    for (const auto& facet : pair->definition().master)
      for (const GlobalOrdinal node : facet)
        if (const LocalOrdinal owned = self.owned_nodes->getLocalElement(node); owned >= 0) masters.insert(owned);
    self.master_nodes.emplace_back(masters.begin(), masters.end());
  }
  for (const auto& pair : self.pairs) {
    const auto carries = [](const SlaveNode& node) { return node.carries_multiplier; };
    const bool mine = std::all_of(pair->slave_nodes().begin(), pair->slave_nodes().end(), carries);
    self.leaves_out.push_back(self.maximum(mine ? 0.0 : 1.0) > 0.0 ? 1 : 0);
  }
  for (const auto& pair : self.pairs)
    for (std::size_t s = 0; s < pair->slave_nodes().size(); ++s) self.middles_first |= pair->before_corners(s);
  self.middles_first = self.maximum(self.middles_first) > 0.0;
  const auto invalid = Teuchos::OrdinalTraits<Tpetra::global_size_t>::invalid();
  self.multipliers = rcp(new Map(invalid, ids.data(), static_cast<LocalOrdinal>(ids.size()), 0, self.dofs->getComm()));
  self.layout = detail::layout_of(self);
  model_ = model;
}

int ContactSystem::dimension() const { return model_->dimension; }
std::size_t ContactSystem::pairs() const { return model_->pairs.size(); }
const std::string& ContactSystem::pair_name(std::size_t pair) const {
  detail::require_pair(*model_, pair);
  return model_->pairs[pair]->definition().name;
}
std::optional<std::size_t> ContactSystem::second_pass(std::size_t pair) const {
  detail::require_pair(*model_, pair);
  return model_->second_pass(pair);
}
ContactGeometry ContactSystem::geometry(std::size_t pair) const {
  detail::require_pair(*model_, pair);
  return model_->pairs[pair]->definition().options.geometry;
}
bool ContactSystem::keeps_multipliers() const { return model_->keeps_multipliers(); }
const RCP<const Map>& ContactSystem::multiplier_map() const { return model_->multipliers; }
RCP<Vector> ContactSystem::weights() const { return model_->weights(); }

std::vector<GlobalOrdinal> ContactSystem::slave_ids(std::size_t pair) const {
  detail::require_pair(*model_, pair);
  std::vector<GlobalOrdinal> ids;
  for (const SlaveNode& node : model_->pairs[pair]->slave_nodes()) ids.push_back(node.id);
  return ids;
}

const SurfaceFacets& ContactSystem::slave_facets(std::size_t pair) const {
  detail::require_pair(*model_, pair);
  return model_->pairs[pair]->definition().slave;
}

ContactEvaluation ContactSystem::evaluate(const NodalDisplacement& d, const ContactHistory& history) const {
  detail::Arguments(*model_, "evaluate").displacement(d).history(history).agree();
  return ContactEvaluation(model_->evaluate(model_, model_->positions(d), history, nullptr, false));
}

DifferentiatedContact ContactSystem::differentiate(const NodalDisplacement& d, const ContactHistory& history, const ContactStates* last) const {
  detail::Arguments arguments(*model_, "differentiate");
  arguments.displacement(d).history(history);
  if (last != nullptr) arguments.states(*last);
  arguments.agree();
  return DifferentiatedContact(model_->evaluate(model_, model_->positions(d), history, last, true));
}

RCP<const Graph> ContactSystem::graph(const ContactEvaluation& evaluation, const std::function<RCP<const Graph>()>& bulk, long bulk_version) const {
  const detail::EvaluatedContact& contact = detail::evaluated(evaluation);
  detail::require_own(*model_, *contact.model, "graph");
  if (!model_->scatter || !model_->scatter->fits(contact.pairs) || model_->bulk_version != bulk_version) {
    const auto scope = model_->timers.scope("contact");
    const auto part = model_->timers.scope("contact graph");
    const RCP<const Graph> own = detail::given(bulk(), "bulk(), the graph of the application's own system,");
    if (!own->isFillComplete()) throw std::invalid_argument("contact: graph(): the graph that bulk() gives is not complete; call its fillComplete()");
    model_->scatter = std::make_shared<detail::SystemScatter>(*own, contact);
    model_->bulk_version = bulk_version;
  }
  return model_->scatter->graph();
}

long ContactSystem::friction_evaluations() const {
  long evaluations = 0;
  for (const auto& pair : model_->pairs) evaluations += pair->slip_evaluations();
  return evaluations;
}

IntegrationLoad ContactSystem::integration_load(std::size_t pair) const {
  detail::require_pair(*model_, pair);
  IntegrationLoad load;
  const auto add = [&](std::size_t p) {
    const InterfaceLoad& mine = model_->pairs[p]->interface().load();
    load.facets += mine.facets;
    load.segments += mine.segments;
    load.imbalance_as_owned = std::max(load.imbalance_as_owned, mine.imbalance_as_owned);
    load.redistributions += mine.redistributions;
  };
  add(pair);
  if (const auto other = second_pass(pair)) add(*other);
  const double largest = model_->maximum(static_cast<double>(load.segments)), sum = model_->sum(static_cast<double>(load.segments));
  load.facets = static_cast<long>(model_->sum(static_cast<double>(load.facets)));
  load.segments = static_cast<long>(sum);
  if (sum > 0.0) load.imbalance = largest * model_->comm().getSize() / sum;
  return load;
}

}  // namespace mortise
