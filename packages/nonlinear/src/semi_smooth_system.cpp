#include "mortise/nonlinear/semi_smooth_system.hpp"

#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_CrsGraph.hpp>
#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Import.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <cmath>
#include <limits>

#include "active_set_hash.hpp"
#include "matrix_values.hpp"
#include "reduction.hpp"

namespace mortise {
namespace {

// Forces below this, relative to stiffness times displacement, are what round-off leaves of f_int: the momentum of a body that only moved
// rigidly is measured against it instead of against nothing.
constexpr double round_off_floor = 1e-6;

RCP<const Map> map_of_both(const Map& dofs, const Map& multipliers) {
  std::vector<GlobalOrdinal> ids;
  for (const GlobalOrdinal id : dofs.getNodeElementList()) ids.push_back(id);
  for (const GlobalOrdinal id : multipliers.getNodeElementList()) ids.push_back(id);
  const auto invalid = Teuchos::OrdinalTraits<Tpetra::global_size_t>::invalid();
  return rcp(new Map(invalid, ids.data(), static_cast<LocalOrdinal>(ids.size()), 0, dofs.getComm()));
}

}  // namespace

struct SemiSmoothSystem::Implementation {
  SystemParts parts;
  Timers timers;
  double time = 0.0;
  RCP<const Map> map, multipliers;
  Import to_local;
  std::vector<LocalOrdinal> fixed;  // prescribed dofs
  Vector internal, external, contact_force, local_displacement;
  double stiffness_scale = 0.0;  // s; 0: not known yet

  RCP<Matrix> bulk;                         // K; without contact it is the system's matrix as well
  bool bulk_is_eliminated = false;          // its prescribed rows and columns are those of the linear system
  RCP<Matrix> system;                       // K + C~, condensed
  std::unique_ptr<detail::ValueCopy> copy;  // bulk -> system
  std::unique_ptr<detail::DirichletElimination> elimination;
  bool graph_changed = true;  // since the linear solver saw it

  std::unique_ptr<detail::Reduction> reduction;  // null: nothing follows
  RCP<const Graph> reduced_graph;                // of the last reduced matrix

  RCP<Vector> contact_at;   // displacement at which the contact holds integrals and their derivatives; null: unknown
  RCP<Vector> jacobian_at;  // x of the last jacobian()

  Implementation(SystemParts given, Timers given_timers)
      : parts(std::move(given)),
        timers(std::move(given_timers)),
        to_local(parts.dofs, parts.local_dofs),
        internal(parts.dofs),
        external(parts.dofs),
        contact_force(parts.dofs),
        local_displacement(parts.local_dofs) {
    multipliers = rcp(new const Map(0, 0, parts.dofs->getComm()));
    map = parts.dofs;
    if (parts.contact) {
      multipliers = parts.contact->multiplier_map();
      map = map_of_both(*parts.dofs, *multipliers);
    }
    if (parts.prescribed) fixed = parts.prescribed->dofs();
    bulk = rcp(new Matrix(parts.bulk_graph));
    bulk->fillComplete(parts.dofs, parts.dofs);
    if (parts.dependent) reduction = std::make_unique<detail::Reduction>(parts.dependent, parts.dofs, parts.local_dofs);
    if (!parts.contact && !reduction) elimination = std::make_unique<detail::DirichletElimination>(*parts.bulk_graph, fixed);
  }

  const Communicator& comm() const { return *parts.dofs->getComm(); }
  RCP<const Vector> d(const Vector& x) const { return x.offsetView(parts.dofs, 0); }
  RCP<const Vector> z(const Vector& x) const { return x.offsetView(multipliers, parts.dofs->getNodeNumElements()); }

  Configuration configuration(const Vector& displacement) {
    local_displacement.doImport(displacement, to_local, Tpetra::REPLACE);
    return {time, displacement, local_displacement};
  }

  // internal = f_int, external = -f_ext
  void evaluate_bulk(const Vector& displacement) {
    const Configuration at = configuration(displacement);
    internal.putScalar(0.0);
    external.putScalar(0.0);
    std::optional<StepFailure> failure;
    for (const auto& contribution : parts.contributions)
      contribution->add_residual(at, contribution->kind() == Contribution::Kind::internal ? internal : external, failure);
    throw_if_any(comm(), failure);
  }

  // r = f_int - f_ext + f_c on all dofs. The contact is evaluated at `displacement`; the reduction is made for it.
  void sum_forces(const Vector& displacement, const Vector& z, Vector& r) {
    r.update(1.0, internal, 1.0, external, 0.0);
    if (parts.contact) {
      contact_force.putScalar(0.0);
      parts.contact->add_contact_force(z, contact_force);
      r.update(1.0, contact_force, 1.0);
    }
    if (!reduction) return;
    configuration(displacement);
    reduction->update(local_displacement);
  }

  void evaluate_contact(const Vector& displacement, bool derivatives) {
    if (derivatives && !contact_at.is_null() && detail::same_values(displacement, *contact_at)) return;
    contact_at = Teuchos::null;
    std::optional<StepFailure> failure;
    parts.contact->evaluate(displacement, derivatives, failure);
    throw_if_any(comm(), failure);
    if (derivatives) contact_at = rcp(new Vector(displacement, Teuchos::Copy));
  }

  void assemble_bulk(const Vector& displacement) {
    const Configuration at = configuration(displacement);
    bulk->resumeFill();
    bulk->setAllToScalar(0.0);
    std::optional<StepFailure> failure;
    for (const auto& contribution : parts.contributions) contribution->add_jacobian(at, *bulk, failure);
    bulk->fillComplete(parts.dofs, parts.dofs);
    bulk_is_eliminated = false;
    throw_if_any(comm(), failure);
    if (stiffness_scale > 0.0) return;
    Vector diagonal(parts.dofs);
    bulk->getLocalDiagCopy(diagonal);
    const double mean = diagonal.norm1() / std::max<double>(1.0, static_cast<double>(diagonal.getGlobalLength()));
    stiffness_scale = mean > 0.0 && std::isfinite(mean) ? mean : 1.0;
  }

  // The graph of the condensed system at the current candidates of contact.
  void prepare_system() {
    bool changed = false;
    const RCP<const Graph> graph = parts.contact->system_graph(parts.bulk_graph, changed);
    if (changed || system.is_null()) {
      system = rcp(new Matrix(graph));
      copy = std::make_unique<detail::ValueCopy>(*parts.bulk_graph, *graph);
      if (!reduction) elimination = std::make_unique<detail::DirichletElimination>(*graph, fixed);
      graph_changed = true;
    } else {
      system->resumeFill();
    }
    copy->apply(*bulk, *system);
  }

  // Solves matrix x = rhs, x = increment on the rows `prescribed`. The matrix is open for changes, rhs is overwritten.
  LinearSolveReport solve(const RCP<Matrix>& matrix, const std::vector<LocalOrdinal>& prescribed, const Vector& increment, Vector& rhs,
                          const NearNullSpace& near_null_space, Vector& x) {
    elimination->impose(*matrix, increment, stiffness_scale, rhs);
    matrix->fillComplete(matrix->getRowMap(), matrix->getRowMap());
    parts.linear_solver->set_matrix(matrix, graph_changed, near_null_space);
    graph_changed = false;
    Vector solution(matrix->getRowMap());
    const LinearSolveReport report = parts.linear_solver->solve(rhs, solution);
    Tpetra::deep_copy(x, solution);
    const auto from = increment.getLocalViewHost(Tpetra::Access::ReadOnly);
    const auto to = x.getLocalViewHost(Tpetra::Access::ReadWrite);
    for (const LocalOrdinal row : prescribed) to(row, 0) = from(row, 0);
    return report;
  }

  // The same where displacements follow others: see Reduction. r is the whole residual, followers' forces not gathered.
  LinearSolveReport solve_reduced(const RCP<Matrix>& matrix, const Vector& d, const Vector& r, const Vector& increment, Vector& rhs, Vector& dd) {
    if (matrix->isFillActive()) matrix->fillComplete(parts.dofs, parts.dofs);
    Vector start(parts.dofs), force(parts.dofs);
    reduction->deviation(d, -1.0, start);
    matrix->apply(start, force);
    rhs.update(-1.0, force, 1.0);
    const RCP<Matrix> reduced = reduction->reduced(*matrix, r);
    const std::vector<LocalOrdinal> prescribed = reduction->places(fixed);
    const RCP<const Graph> graph = reduced->getCrsGraph();
    if (reduced_graph.is_null() || !detail::same_entries(*graph, *reduced_graph)) {
      elimination = std::make_unique<detail::DirichletElimination>(*graph, prescribed);
      reduced_graph = graph;
      graph_changed = true;
    }
    reduced->resumeFill();
    const RCP<Vector> q_increment = reduction->unknown_part(increment), q_rhs = reduction->reduced(rhs);
    Vector dq(reduction->unknowns());
    const LinearSolveReport report = solve(reduced, prescribed, *q_increment, *q_rhs, {}, dq);
    dd.update(1.0, *reduction->expanded(dq), 1.0, start, 0.0);
    return report;
  }

  void evaluate_at_jacobian() {
    if (jacobian_at.is_null()) throw std::logic_error("SemiSmoothSystem: jacobian() comes first");
    const auto displacement = d(*jacobian_at);
    if (bulk_is_eliminated) assemble_bulk(*displacement);
    if (parts.contact) evaluate_contact(*displacement, true);
  }
};

SemiSmoothSystem::SemiSmoothSystem(SystemParts parts, Timers timers)
    : implementation_(std::make_unique<Implementation>(std::move(parts), std::move(timers))) {}
SemiSmoothSystem::~SemiSmoothSystem() = default;

const SystemParts& SemiSmoothSystem::parts() const { return implementation_->parts; }
const RCP<const Map>& SemiSmoothSystem::map() const { return implementation_->map; }
RCP<const Vector> SemiSmoothSystem::displacement(const Vector& x) const { return implementation_->d(x); }
RCP<Vector> SemiSmoothSystem::displacement(Vector& x) const { return x.offsetViewNonConst(implementation_->parts.dofs, 0); }
RCP<const Vector> SemiSmoothSystem::multipliers(const Vector& x) const { return implementation_->z(x); }
RCP<Vector> SemiSmoothSystem::multipliers(Vector& x) const {
  return x.offsetViewNonConst(implementation_->multipliers, implementation_->parts.dofs->getNodeNumElements());
}
double SemiSmoothSystem::time() const { return implementation_->time; }
double SemiSmoothSystem::stiffness_scale() const { return implementation_->stiffness_scale; }

// Whoever changes time may have used the contact for itself: nothing that it holds is relied upon any more.
void SemiSmoothSystem::set_time(double time) {
  implementation_->time = time;
  implementation_->contact_at = Teuchos::null;
}

// r = f_int - f_ext + f_c; rows of prescribed dofs: s (d - prescribed); C.
void SemiSmoothSystem::residual(const Vector& x, Vector& F, ResidualNorms& norms) {
  Implementation& self = *implementation_;
  const RCP<const Vector> d = displacement(x), z = multipliers(x);
  if (self.stiffness_scale == 0.0) self.assemble_bulk(*d);
  self.evaluate_bulk(*d);
  norms = {};
  const RCP<Vector> r = displacement(F);
  if (self.parts.contact) self.evaluate_contact(*d, true);
  self.sum_forces(*d, *z, *r);
  double force = std::max(self.internal.norm2(), self.external.norm2());
  double other = 0.0, violation = 0.0;
  if (self.parts.contact) {
    const RCP<Vector> C = multipliers(F);
    self.parts.contact->complementarity(*z, *C);
    other = C->norm2();
    const ContactNorms contact = self.parts.contact->norms(*z);
    norms.gap = contact.gap;
    norms.complementarity = contact.complementarity;
    violation = contact.violation;
    norms.active = contact.active;
    norms.sticking = contact.sticking;
    norms.changed = contact.changed;
    norms.active_set = detail::active_set_hash(*self.parts.contact, *z, self.comm());
    force = std::max(force, contact.force);
  }

  // Momentum on the free rows alone, then the prescribed ones and those of followers.
  if (self.reduction) self.reduction->gather(*r);
  std::vector<double> deviation;  // d - prescribed
  double largest = 0.0;
  if (self.parts.prescribed) deviation = self.parts.prescribed->values(self.time);
  {
    if (self.reduction) largest = self.reduction->deviation(*d, 0.0, *r);
    const auto displacements = d->getLocalViewHost(Tpetra::Access::ReadOnly);
    const auto rows = r->getLocalViewHost(Tpetra::Access::ReadWrite);
    for (std::size_t i = 0; i < self.fixed.size(); ++i) {
      deviation[i] = displacements(self.fixed[i], 0) - deviation[i];
      largest = std::max(largest, std::abs(deviation[i]));
      rows(self.fixed[i], 0) = 0.0;
    }
  }
  norms.momentum_absolute = r->norm2();
  force = std::max(force, round_off_floor * self.stiffness_scale * d->norm2());
  norms.momentum = norms.momentum_absolute == 0.0 ? 0.0 : norms.momentum_absolute / force;
  // F = I + grad u is known to eps, and so are stresses, to eps E; contact forces come from positions, known to eps |x| at each closed node.
  norms.round_off = 4.0 * std::numeric_limits<double>::epsilon() * self.stiffness_scale * self.parts.length * std::sqrt(1.0 + norms.active);
  Teuchos::reduceAll(self.comm(), Teuchos::REDUCE_MAX, largest / self.parts.length, Teuchos::outArg(norms.prescribed));
  {
    const auto rows = r->getLocalViewHost(Tpetra::Access::ReadWrite);
    for (std::size_t i = 0; i < self.fixed.size(); ++i) rows(self.fixed[i], 0) = self.stiffness_scale * deviation[i];
  }
  if (self.reduction) self.reduction->deviation(*d, self.stiffness_scale, *r);
  const double rows = r->norm2();
  norms.finite = std::isfinite(rows) && std::isfinite(force) && std::isfinite(other);
  norms.merit = norms.finite ? std::hypot(rows, violation) : std::numeric_limits<double>::infinity();
}

void SemiSmoothSystem::forces(const Vector& x, Vector& r) {
  Implementation& self = *implementation_;
  const RCP<const Vector> d = displacement(x);
  self.evaluate_bulk(*d);
  if (self.parts.contact) self.evaluate_contact(*d, false);
  self.sum_forces(*d, *multipliers(x), r);
  if (self.reduction) self.reduction->gather(r);
}

void SemiSmoothSystem::commit(const Vector& x) {
  const RCP<const Vector> d = displacement(x);
  const Configuration at = implementation_->configuration(*d);
  for (const auto& contribution : implementation_->parts.contributions) contribution->commit(at);
  if (!implementation_->parts.contact) return;
  implementation_->evaluate_contact(*d, true);
  implementation_->parts.contact->accept_states(*multipliers(x));
}

void SemiSmoothSystem::jacobian(const Vector& x) {
  Implementation& self = *implementation_;
  const RCP<const Vector> d = displacement(x);
  self.jacobian_at = Teuchos::null;
  self.assemble_bulk(*d);
  if (self.parts.contact) {
    self.evaluate_contact(*d, true);
    self.parts.contact->mark_states(*multipliers(x));
  }
  self.jacobian_at = rcp(new Vector(x, Teuchos::Copy));
}

// y_d = (K + C~) v_d + B v_z,  y_z = C_d v_d + C_z v_z;  s v on prescribed rows
void SemiSmoothSystem::apply(const Vector& v, Vector& y) const {
  Implementation& self = *implementation_;
  self.evaluate_at_jacobian();
  const RCP<const Vector> v_d = displacement(v), v_z = multipliers(v);
  const RCP<Vector> y_d = displacement(y);
  if (self.parts.contact) {
    const RCP<const Vector> z = multipliers(*self.jacobian_at);
    self.prepare_system();
    self.parts.contact->add_stiffness(*z, *self.system);
    self.system->fillComplete(self.parts.dofs, self.parts.dofs);
    const auto blocks = self.parts.contact->saddle_point_blocks(*z);
    const RCP<Vector> y_z = multipliers(y);
    self.system->apply(*v_d, *y_d);
    blocks.B->apply(*v_z, *y_d, Teuchos::NO_TRANS, 1.0, 1.0);
    blocks.C_d->apply(*v_d, *y_z);
    blocks.C_z->apply(*v_z, *y_z, Teuchos::NO_TRANS, 1.0, 1.0);
  } else {
    self.bulk->apply(*v_d, *y_d);
  }
  if (self.reduction) {
    const RCP<const Vector> d = displacement(*self.jacobian_at);
    Vector r(self.parts.dofs);
    self.evaluate_bulk(*d);
    self.sum_forces(*d, *multipliers(*self.jacobian_at), r);
    self.reduction->gather(*y_d);
    self.reduction->add_curvature(r, *v_d, *y_d);
    // s (v_i - sum_k dg_i/dq_k v_k)
    const RCP<Vector> followed = self.reduction->expanded(*self.reduction->unknown_part(*v_d));
    const auto change = v_d->getLocalViewHost(Tpetra::Access::ReadOnly), follows = followed->getLocalViewHost(Tpetra::Access::ReadOnly);
    const auto rows = y_d->getLocalViewHost(Tpetra::Access::ReadWrite);
    for (const LocalOrdinal row : self.parts.dependent->dofs()) rows(row, 0) = self.stiffness_scale * (change(row, 0) - follows(row, 0));
  }
  const auto step = v_d->getLocalViewHost(Tpetra::Access::ReadOnly);
  const auto rows = y_d->getLocalViewHost(Tpetra::Access::ReadWrite);
  for (const LocalOrdinal row : self.fixed) rows(row, 0) = self.stiffness_scale * step(row, 0);
}

// The free rows of J dx = -F condensed to (K~ condensed) dd = rhs, then reduced to the unknowns if some displacements follow others. The
// prescribed rows s dd = -s (d - prescribed) are solved at once, their columns go to the right-hand side; contact's recovery needs the whole dd.
LinearSolveReport SemiSmoothSystem::newton_direction(const Vector& F, Vector& direction) {
  Implementation& self = *implementation_;
  self.evaluate_at_jacobian();
  const RCP<const Vector> residual = displacement(F), d = displacement(*self.jacobian_at), z = multipliers(*self.jacobian_at);
  const RCP<Vector> dd = displacement(direction);
  const SystemParts& parts = self.parts;
  Vector r(*residual, Teuchos::Copy);
  if (self.reduction) {  // F holds what is gathered from followers
    self.evaluate_bulk(*d);
    self.sum_forces(*d, *z, r);
  }
  Vector rhs(r, Teuchos::Copy);
  rhs.scale(-1.0);

  RCP<Matrix> matrix = self.bulk;
  if (parts.contact) {  // -r without f_c
    self.contact_force.putScalar(0.0);
    parts.contact->add_contact_force(*z, self.contact_force);
    rhs.update(1.0, self.contact_force, 1.0);
    self.prepare_system();
    parts.contact->add_stiffness(*z, *self.system);
    parts.contact->condense(*z, *self.system, rhs);
    matrix = self.system;
  } else if (!self.reduction) {
    matrix->resumeFill();
    self.bulk_is_eliminated = true;
  }

  Vector prescribed_increment(parts.dofs);
  {
    const auto step = prescribed_increment.getLocalViewHost(Tpetra::Access::ReadWrite);
    const auto rows = residual->getLocalViewHost(Tpetra::Access::ReadOnly);
    for (const LocalOrdinal row : self.fixed) step(row, 0) = -rows(row, 0) / self.stiffness_scale;
  }
  NearNullSpace near_null_space;
  if (parts.linear_solver->uses_near_null_space() && parts.near_null_space) near_null_space = parts.near_null_space(*d);
  const LinearSolveReport report = self.reduction ? self.solve_reduced(matrix, *d, r, prescribed_increment, rhs, *dd)
                                                  : self.solve(matrix, self.fixed, prescribed_increment, rhs, near_null_space, *dd);
  if (parts.contact) {
    const RCP<Vector> dz = multipliers(direction);
    Vector z_new(self.multipliers);
    parts.contact->recover(*dd, z_new);
    dz->update(1.0, z_new, -1.0, *z, 0.0);
  }
  return report;
}

}  // namespace mortise
