#include "mortise/contact/contact_system.hpp"

#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_Import.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_MultiVector.hpp>
#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "checks.hpp"
#include "implementation.hpp"
#include "mortise/core/dof_map.hpp"

namespace mortise {

namespace {
/// The list "formulation" of a pair.
struct FormulationList {
  Choice<Formulation>& formulation;
  void describe(Parameters& parameters) { parameters.choose(formulation, formulation_registry(), "how contact is discretised and enforced"); }
};
/// The list "friction" of a pair.
struct FrictionList {
  Choice<FrictionLaw>& friction;
  void describe(Parameters& parameters) { parameters.choose(friction, friction_registry(), "the friction law"); }
};
}  // namespace

void ContactOptions::describe(Parameters& parameters) {
  parameters.add("geometry", geometry, {{"current", ContactGeometry::current}, {"reference", ContactGeometry::reference}},
                 "configuration that carries the contact geometry: current, or reference for small displacements");
  parameters.add("full cover", full_cover,
                 Says("covered share of a facet below which the multiplier of a slave node is tied to those of its neighbours, so that a sliver "
                      "of contact bears no peak; 0: none is tied, as in most published computations; penalty ties none")
                     .unit("-")
                     .at_least(0.0)
                     .at_most(1.0));
  parameters.add("complementarity constant", complementarity_constant,
                 Says("c_n times A_j: weighs gap against pressure in the choice of the active set; changes no solution; default: Young's modulus "
                      "of the softer side over the shortest slave facet, of penalty and augmented Lagrange a tenth of that; allowed: 1e-4 to 1e4 "
                      "times that ratio")
                     .unit("stress / length")
                     .above(0.0));
  mortar.describe(parameters);
  FormulationList formulation_list{formulation};
  parameters.list("formulation", formulation_list, "how contact is discretised and enforced");
  FrictionList list{friction};
  parameters.list("friction", list, "shear tractions of closed nodes");
}

RCP<MultiVector> ContactSystem::Implementation::positions(const Vector& d) const {
  const auto x = rcp(new MultiVector(*reference, Teuchos::Copy));
  const auto u = d.getLocalViewHost(Tpetra::Access::ReadOnly);
  const auto view = x->getLocalViewHost(Tpetra::Access::ReadWrite);
  for (std::size_t node = 0; node < view.extent(0); ++node)
    for (std::size_t i = 0; i < view.extent(1); ++i) view(node, i) += u(view.extent(1) * node + i, 0);
  return x;
}

double ContactSystem::Implementation::sum(double value) const {
  double all = 0.0;
  Teuchos::reduceAll(*dofs->getComm(), Teuchos::REDUCE_SUM, value, Teuchos::outArg(all));
  return all;
}

double ContactSystem::Implementation::maximum(double value) const {
  double all = 0.0;
  Teuchos::reduceAll(*dofs->getComm(), Teuchos::REDUCE_MAX, value, Teuchos::outArg(all));
  return all;
}

ContactSystem::ContactSystem(RCP<const Map> owned_nodes, RCP<const Map> dofs, RCP<const MultiVector> reference, RCP<const MultiVector> fixed,
                             const InterfaceMeasure& measure, std::vector<ContactPair> pairs, const Timers& timers)
    : implementation_(std::make_unique<Implementation>()) {
  detail::refuse_unfit_maps(*owned_nodes, *dofs, *reference, *fixed);
  for (ContactPair& pair : pairs)
    if (pair.place.path.empty()) pair.place.path = "contact/" + pair.name;
  detail::refuse_incomplete_pairs(*owned_nodes->getComm(), pairs);
  Implementation& self = *implementation_;
  self.owned_nodes = std::move(owned_nodes);
  self.dofs = std::move(dofs);
  self.reference = std::move(reference);
  self.fixed = fixed;
  self.timers = timers;
  self.dimension = static_cast<int>(self.reference->getNumVectors());
  self.extent = 0.0;
  for (std::size_t i = 0; i < self.reference->getNumVectors(); ++i) self.extent = std::max(self.extent, self.reference->getVector(i)->normInf());
  detail::refuse_shared_nodes(*self.owned_nodes, *self.reference, pairs);
  for (ContactPair& pair : pairs) {
    const Formulation& formulation = *pair.options.formulation.options;
    pair.options.mortar.coupling = formulation.coupling();
    pair.options.mortar.share = formulation.two_pass() ? 0.5 : 1.0;
    self.pairs.push_back(std::make_unique<detail::PairCoupling>(self.owned_nodes, self.reference, fixed, measure, std::move(pair)));
  }

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
    self.marked.emplace_back(pair->slave_nodes().size(), ContactState::open);
    self.accepted.emplace_back(pair->slave_nodes().size(), ContactState::open);
  }
  for (const auto& pair : self.pairs)
    for (std::size_t s = 0; s < pair->slave_nodes().size(); ++s) self.middles_first |= pair->before_corners(s);
  self.middles_first = self.maximum(self.middles_first) > 0.0;
  const auto invalid = Teuchos::OrdinalTraits<Tpetra::global_size_t>::invalid();
  self.multipliers = rcp(new Map(invalid, ids.data(), static_cast<LocalOrdinal>(ids.size()), 0, self.dofs->getComm()));
}

ContactSystem::~ContactSystem() = default;

std::size_t ContactSystem::pairs() const { return implementation_->pairs.size(); }
const std::string& ContactSystem::pair_name(std::size_t pair) const { return implementation_->pairs[pair]->definition().name; }
std::optional<std::size_t> ContactSystem::second_pass(std::size_t pair) const {
  const auto& pairs = implementation_->pairs;
  for (std::size_t p = 0; p < pairs.size(); ++p)
    if (pairs[p]->definition().second_pass_of == pair) return p;
  return std::nullopt;
}
ContactGeometry ContactSystem::geometry(std::size_t pair) const { return implementation_->pairs[pair]->definition().options.geometry; }
bool ContactSystem::keeps_multipliers() const {
  const auto& pairs = implementation_->pairs;
  return std::any_of(pairs.begin(), pairs.end(), [](const auto& pair) { return pair->formulation().elimination() == Elimination::none; });
}
void ContactSystem::allow_overlap(std::size_t pair, double depth) {
  implementation_->pairs[pair]->allow_overlap(depth);
  if (const auto other = second_pass(pair)) implementation_->pairs[*other]->allow_overlap(depth);
}
const RCP<const Map>& ContactSystem::multiplier_map() const { return implementation_->multipliers; }

void ContactSystem::evaluate(const Vector& d, bool derivatives, std::optional<StepFailure>& failure) {
  implementation_->evaluate(implementation_->positions(d), derivatives, failure);
}

void ContactSystem::Implementation::evaluate(const RCP<const MultiVector>& x, bool derivatives, std::optional<StepFailure>& failure) {
  const auto scope = timers.scope("contact");
  evaluated_at = x;
  has_derivatives = derivatives;
  for (const auto& pair : pairs) {
    {
      const auto part = timers.scope("search");
      pattern_changed |= pair->search(*x);
    }
    const auto part = timers.scope("contact integrals");
    pair->evaluate(*x, derivatives, failure);
  }
  const auto part = timers.scope("search");
  find_lost_contact(*x, failure);
}

RCP<const Graph> ContactSystem::system_graph(const std::function<RCP<const Graph>()>& bulk, bool& changed) {
  Implementation& self = *implementation_;
  changed = self.pattern_changed || !self.scatter;
  if (changed) {
    const auto scope = self.timers.scope("contact");
    const auto part = self.timers.scope("contact graph");
    std::vector<detail::PairCoupling*> pairs;
    for (const auto& pair : self.pairs) pairs.push_back(pair.get());
    self.scatter = std::make_unique<detail::SystemScatter>(self.owned_nodes, *bulk(), pairs, self.middles_first);
    self.pattern_changed = false;
  }
  return self.scatter->graph();
}

// f_c = sum_j c_jm z_j at each node m that slave node j is coupled to, D_jj z_j at j itself; with variational mortar see coupled_part().
void ContactSystem::Implementation::add_contact_force(const Vector& z, Vector& r) const {
  const auto values = z.getLocalViewHost(Tpetra::Access::ReadOnly);
  for (std::size_t p = 0; p < pairs.size(); ++p) {
    const detail::PairCoupling& pair = *pairs[p];
    const RCP<const Map> force_map = make_dof_map(*pair.interface().local_nodes(), dimension);
    Vector force(force_map);
    {
      const auto view = force.getLocalViewHost(Tpetra::Access::ReadWrite);
      for (std::size_t s = 0; s < pair.slave_nodes().size(); ++s) {
        const SpatialVector zs = z_of(values, p, s);
        if (zs.isZero(0.0)) continue;
        const SpatialVector through = pair.coupled_part(s, zs);
        const double pressure = pair.gap_pressure(s, zs);
        const detail::NodeRow& row = pair.rows()[s];
        const std::vector<LocalOrdinal>& coupled = pair.interface().coupled_nodes(s);
        for (int i = 0; i < dimension; ++i) {
          view(dimension * pair.slave_nodes()[s].local_node + i, 0) += row.D * through[i];
          for (std::size_t c = 0; c < coupled.size(); ++c) view(dimension * coupled[c] + i, 0) += row.coefficients[c] * through[i];
          if (pressure != 0.0)
            for (std::size_t c = 0; c < coupled.size(); ++c) view(dimension * coupled[c] + i, 0) -= pressure * row.dgap[dimension * c + i];
        }
      }
    }
    // An export with ADD replaces what the rank itself sends to itself: hence a vector in between that starts at zero.
    Vector on_dofs(dofs);
    on_dofs.doExport(force, Export(force_map, dofs), Tpetra::ADD);
    r.update(1.0, on_dofs, 1.0);
  }
}

void ContactSystem::add_contact_force(const Vector& z, Vector& r) const {
  const auto scope = implementation_->timers.scope("contact");
  const auto part = implementation_->timers.scope("contact residual");
  implementation_->add_contact_force(z, r);
}

RCP<Vector> ContactSystem::shear_tractions(const Vector& z) const {
  const Implementation& self = *implementation_;
  const auto shear = rcp(new Vector(self.multipliers));
  const auto values = z.getLocalViewHost(Tpetra::Access::ReadOnly);
  const auto result = shear->getLocalViewHost(Tpetra::Access::ReadWrite);
  for (std::size_t p = 0; p < self.pairs.size(); ++p) {
    if (self.pairs[p]->friction() == nullptr) continue;
    for (std::size_t s = 0; s < self.multiplier_of[p].size(); ++s) {
      const LocalOrdinal first = self.multiplier_of[p][s];
      if (first < 0) continue;
      const SpatialVector zs = self.z_of(values, p, s), &normal = self.pairs[p]->rows()[s].normal, across = zs - zs.dot(normal) * normal;
      for (int i = 0; i < self.dimension; ++i) result(first + i, 0) = across[i];
    }
  }
  return shear;
}

void ContactSystem::complementarity(const Vector& z, Vector& C) const {
  const Implementation& self = *implementation_;
  const auto scope = self.timers.scope("contact");
  const auto part = self.timers.scope("contact residual");
  const auto values = z.getLocalViewHost(Tpetra::Access::ReadOnly);
  const auto result = C.getLocalViewHost(Tpetra::Access::OverwriteAll);
  for (std::size_t p = 0; p < self.pairs.size(); ++p) {
    const std::vector<detail::NodeMultiplier> multipliers = self.multipliers_of(values, p);
    for (std::size_t s = 0; s < self.multiplier_of[p].size(); ++s) {
      const LocalOrdinal first = self.multiplier_of[p][s];
      if (first < 0) continue;
      const SpatialVector value = self.pairs[p]->complementarity(s, multipliers[s]).C;
      for (int i = 0; i < self.dimension; ++i) result(first + i, 0) = value[i];
    }
  }
}

RCP<Vector> ContactSystem::weights() const {
  const Implementation& self = *implementation_;
  const auto result = rcp(new Vector(self.multipliers));
  const auto view = result->getLocalViewHost(Tpetra::Access::OverwriteAll);
  for (std::size_t p = 0; p < self.pairs.size(); ++p)
    for (std::size_t s = 0; s < self.multiplier_of[p].size(); ++s)
      for (int i = 0; i < self.dimension; ++i)
        if (const LocalOrdinal first = self.multiplier_of[p][s]; first >= 0) view(first + i, 0) = self.pairs[p]->slave_nodes()[s].weight;
  return result;
}

ContactNorms ContactSystem::norms(const Vector& z) const {
  const Implementation& self = *implementation_;
  const auto scope = self.timers.scope("contact");
  const auto part = self.timers.scope("contact residual");
  const auto values = z.getLocalViewHost(Tpetra::Access::ReadOnly);
  double gap = 0.0, violation = 0.0, traction = 0.0, floor = 0.0, round_off = 0.0;
  double active = 0.0, sticking = 0.0, changed = 0.0, squares = 0.0;
  for (std::size_t p = 0; p < self.pairs.size(); ++p) {
    const detail::PairCoupling& pair = *self.pairs[p];
    floor = std::max(floor, 1e-9 * pair.definition().youngs_modulus);
    // What the round-off of positions leaves of c g and c u; penalty weighs them with less, c eps / (c + eps). Augmented Lagrange is judged by the
    // return map, not by its C, in which gaps count for 1 + eps/c times less. By C, multipliers would be updated from gaps that Newton's method let
    // be.
    const bool is_augmented = pair.regularisation() && pair.regularisation()->augmentations > 0;
    round_off = std::max(round_off, is_augmented ? pair.mismatch_of(self.position_round_off())
                                                 : self.position_round_off() * pair.definition().youngs_modulus / pair.size());
    const std::vector<detail::NodeMultiplier> multipliers = self.multipliers_of(values, p);
    for (std::size_t s = 0; s < self.multiplier_of[p].size(); ++s) {
      if (self.multiplier_of[p][s] < 0) continue;
      const SpatialVector& zs = multipliers[s].z;
      const Complementarity law = pair.complementarity(s, multipliers[s]);
      const bool closed = law.state != ContactState::open;
      const SpatialVector& C = law.C;
      squares += std::pow(pair.slave_nodes()[s].weight, 2) * C.squaredNorm();
      traction = std::max(traction, zs.norm());
      const bool exactly_closed = closed && !pair.regularisation();  // then C_n is the gap
      violation = std::max(violation, is_augmented     ? std::max(pair.mismatch(s, multipliers[s]), C.norm())
                                      : exactly_closed ? C.tail(self.dimension - 1).norm()
                                                       : C.norm());
      if (exactly_closed) gap = std::max(gap, std::abs(pair.gap(s, multipliers[s])) / (pair.slave_nodes()[s].weight * pair.size()));
      active += closed;
      sticking += law.state == ContactState::stick;
      changed += law.state != self.marked[p][s];
    }
  }
  ContactNorms norms;
  norms.gap = self.maximum(gap);
  violation = self.maximum(violation);
  norms.complementarity = violation <= self.maximum(round_off) ? 0.0 : violation / std::max(self.maximum(traction), self.maximum(floor));
  norms.violation = std::sqrt(self.sum(squares));
  norms.active = static_cast<int>(self.sum(active));
  norms.sticking = static_cast<int>(self.sum(sticking));
  norms.changed = static_cast<int>(self.sum(changed));
  Vector force(self.dofs);
  self.add_contact_force(z, force);
  norms.force = force.norm2();
  return norms;
}

std::vector<std::vector<ContactState>> ContactSystem::Implementation::states(const Vector& z) const {
  const auto values = z.getLocalViewHost(Tpetra::Access::ReadOnly);
  std::vector<std::vector<ContactState>> states;
  for (std::size_t p = 0; p < pairs.size(); ++p) {
    states.emplace_back(multiplier_of[p].size(), ContactState::open);
    const std::vector<detail::NodeMultiplier> of_nodes = multipliers_of(values, p);
    for (std::size_t s = 0; s < multiplier_of[p].size(); ++s)
      if (multiplier_of[p][s] >= 0) states[p][s] = pairs[p]->complementarity(s, of_nodes[s]).state;
  }
  return states;
}

void ContactSystem::Implementation::take_slip_references() {
  const RCP<const Vector> z = accepted_multipliers.is_null() ? RCP<const Vector>(rcp(new Vector(multipliers))) : accepted_multipliers;
  const auto values = z->getLocalViewHost(Tpetra::Access::ReadOnly);
  for (std::size_t p = 0; p < pairs.size(); ++p)
    if (pairs[p]->friction() != nullptr) pairs[p]->take_slip_reference(multipliers_of(values, p), accepted[p]);
}

void ContactSystem::mark_states(const Vector& z) {
  implementation_->marked = implementation_->states(z);
  for (const auto& pair : implementation_->pairs) pair->mark_cover();
}

void ContactSystem::accept_states(const Vector& z) {
  Implementation& self = *implementation_;
  self.accepted = self.states(z);
  const auto values = z.getLocalViewHost(Tpetra::Access::ReadOnly);
  for (std::size_t p = 0; p < self.pairs.size(); ++p) {
    if (self.dimension > 2) self.pairs[p]->choose_axes();
    self.pairs[p]->accept_multipliers([&](std::size_t s) { return self.z_of(values, p, s); });
    if (self.pairs[p]->friction() != nullptr)
      for (std::size_t s = 0; s < self.accepted[p].size(); ++s) self.pairs[p]->accept_slip(s, self.accepted[p][s]);
  }
  self.accepted_multipliers = rcp(new Vector(z, Teuchos::Copy));
  self.take_slip_references();
  self.accept_cover();
}

void ContactSystem::Implementation::accept_cover() {
  accepted_at = evaluated_at;
  for (const auto& pair : pairs) pair->accept_cover();
}

long ContactSystem::friction_bytes() const {
  std::size_t bytes = 0;
  for (const auto& pair : implementation_->pairs) {
    const auto& histories = pair->slip_histories();
    bytes += histories.capacity() * sizeof(detail::SlipHistory);
    for (const detail::SlipHistory& history : histories) {
      bytes += history.places.capacity() * sizeof(LocalOrdinal);
      for (const detail::SlipReference* reference : {&history.start, &history.accepted})
        bytes += reference->nodes.capacity() * sizeof(GlobalOrdinal) + reference->coefficients.capacity() * sizeof(double);
    }
  }
  return static_cast<long>(implementation_->sum(static_cast<double>(bytes)));
}

long ContactSystem::friction_evaluations() const {
  long evaluations = 0;
  for (const auto& pair : implementation_->pairs) evaluations += pair->slip_evaluations();
  return evaluations;
}

}  // namespace mortise
