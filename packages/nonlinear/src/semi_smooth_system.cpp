#include "mortise/nonlinear/semi_smooth_system.hpp"

#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Import.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <cmath>

#include "matrix_copy.hpp"

namespace mortise {
namespace {

// Forces below this share of (stiffness scale) x (length of the model) are taken for zero when the momentum residual is measured.
constexpr double force_floor = 1e-10;

RCP<const Map> combined_map(const Map& dofs, const Map& multipliers) {
  std::vector<GlobalOrdinal> ids(dofs.getNodeElementList().begin(), dofs.getNodeElementList().end());
  ids.insert(ids.end(), multipliers.getNodeElementList().begin(), multipliers.getNodeElementList().end());
  const auto invalid = Teuchos::OrdinalTraits<Tpetra::global_size_t>::invalid();
  return rcp(new Map(invalid, ids.data(), static_cast<LocalOrdinal>(ids.size()), 0, dofs.getComm()));
}

}  // namespace

struct SemiSmoothSystem::Implementation {
  SystemParts parts;
  Timers timers;
  RCP<const Map> map;
  double time = 0.0;
  RCP<const Import> ghosts;
  RCP<Vector> local_displacement, internal, external, contact_force;
  RCP<Matrix> K;  ///< of the contributions, on the bulk's graph
  RCP<Matrix> A;  ///< the condensed system; K itself without contact
  std::vector<std::size_t> place_of_K_in_A;
  RCP<Vector> z;                 ///< multipliers at the last jacobian()
  bool graph_is_new = true;      ///< the linear solver has not seen A's graph
  std::vector<char> prescribed;  ///< [owned dofs]
  double stiffness = 0.0;        ///< scale s of the Dirichlet rows; 0: not known yet

  Configuration import_ghosts(const Vector& d) {
    local_displacement->doImport(d, *ghosts, Tpetra::REPLACE);
    return {time, d, *local_displacement};
  }

  void sum_forces(const Vector& d, std::optional<StepFailure>& failure) {
    const auto scope = timers.scope("bulk residual");
    const Configuration at = import_ghosts(d);
    internal->putScalar(0.0);
    external->putScalar(0.0);
    for (const auto& one : parts.contributions) one->add_residual(at, one->kind() == Contribution::Kind::internal ? *internal : *external, failure);
  }

  void assemble(const Vector& d) {
    const auto scope = timers.scope("bulk jacobian");
    std::optional<StepFailure> failure;
    const Configuration at = import_ghosts(d);
    K->resumeFill();
    K->setAllToScalar(0.0);
    for (const auto& one : parts.contributions) one->add_jacobian(at, *K, failure);
    K->fillComplete(parts.dofs, parts.dofs);
    throw_if_any(*map->getComm(), failure);
  }

  // s: mean |K_ii| where the model starts, so that Dirichlet rows are forces in any system of units.
  void set_stiffness_scale(const Vector& d) {
    if (stiffness > 0.0) return;
    assemble(d);
    Vector diagonal(parts.dofs);
    K->getLocalDiagCopy(diagonal);
    stiffness = diagonal.norm1() / static_cast<double>(parts.dofs->getGlobalNumElements());
    if (!(stiffness > 0.0) || !std::isfinite(stiffness)) stiffness = 1.0;
  }

  void eliminate_prescribed(const Vector& F_d, Vector& rhs);
};

SemiSmoothSystem::SemiSmoothSystem(SystemParts parts, Timers timers) : implementation_(std::make_unique<Implementation>()) {
  Implementation& self = *implementation_;
  self.parts = std::move(parts);
  self.timers = timers;
  const SystemParts& p = self.parts;
  self.map = p.contact ? combined_map(*p.dofs, *p.contact->multiplier_map()) : p.dofs;
  self.ghosts = rcp(new Import(p.dofs, p.local_dofs));
  self.local_displacement = rcp(new Vector(p.local_dofs));
  self.internal = rcp(new Vector(p.dofs));
  self.external = rcp(new Vector(p.dofs));
  self.contact_force = rcp(new Vector(p.dofs));
  self.K = rcp(new Matrix(p.bulk_graph));
  self.K->fillComplete(p.dofs, p.dofs);
  self.prescribed.assign(p.dofs->getNodeNumElements(), 0);
  if (p.prescribed)
    for (const LocalOrdinal dof : p.prescribed->dofs()) self.prescribed[dof] = 1;
  if (p.contact) self.z = rcp(new Vector(p.contact->multiplier_map()));
}

SemiSmoothSystem::~SemiSmoothSystem() = default;

const SystemParts& SemiSmoothSystem::parts() const { return implementation_->parts; }
const RCP<const Map>& SemiSmoothSystem::map() const { return implementation_->map; }
void SemiSmoothSystem::set_time(double time) { implementation_->time = time; }
double SemiSmoothSystem::time() const { return implementation_->time; }

RCP<const Vector> SemiSmoothSystem::displacement(const Vector& x) const { return x.offsetView(implementation_->parts.dofs, 0); }
RCP<Vector> SemiSmoothSystem::displacement(Vector& x) const { return x.offsetViewNonConst(implementation_->parts.dofs, 0); }
RCP<const Vector> SemiSmoothSystem::multipliers(const Vector& x) const {
  return x.offsetView(implementation_->parts.contact->multiplier_map(), implementation_->parts.dofs->getNodeNumElements());
}
RCP<Vector> SemiSmoothSystem::multipliers(Vector& x) const {
  return x.offsetViewNonConst(implementation_->parts.contact->multiplier_map(), implementation_->parts.dofs->getNodeNumElements());
}

void SemiSmoothSystem::residual(const Vector& x, Vector& F, ResidualNorms& norms) {
  Implementation& self = *implementation_;
  const SystemParts& p = self.parts;
  const RCP<const Vector> d = displacement(x);
  self.set_stiffness_scale(*d);

  std::optional<StepFailure> failure;
  self.sum_forces(*d, failure);
  if (p.contact) p.contact->evaluate(*d, false, failure);
  throw_if_any(*self.map->getComm(), failure);

  norms = ResidualNorms();
  double force = std::max({self.internal->norm2(), self.external->norm2(), force_floor * self.stiffness * p.length});
  const RCP<Vector> F_d = displacement(F);
  F_d->update(1.0, *self.internal, 1.0, *self.external, 0.0);
  if (p.contact) {
    const RCP<const Vector> z = multipliers(x);
    self.contact_force->putScalar(0.0);
    p.contact->add_contact_force(*z, *self.contact_force);
    F_d->update(1.0, *self.contact_force, 1.0);
    p.contact->complementarity(*z, *multipliers(F));
    const ContactNorms contact = p.contact->norms(*z);
    norms.gap = contact.gap;
    norms.complementarity = contact.complementarity;
    norms.active = contact.active;
    norms.changed = contact.changed;
    force = std::max(force, contact.force);
  }

  double mine[2] = {0.0, 0.0}, all[2];  // squared momentum of free dofs is summed, the largest miss of a prescribed one is reduced below
  {
    const auto r = F_d->getLocalViewHost(Tpetra::Access::ReadWrite);
    for (std::size_t i = 0; i < self.prescribed.size(); ++i)
      if (!self.prescribed[i]) mine[0] += r(i, 0) * r(i, 0);
    if (p.prescribed) {
      const auto u = d->getLocalViewHost(Tpetra::Access::ReadOnly);
      const std::vector<double> values = p.prescribed->values(self.time);
      const std::vector<LocalOrdinal>& dofs = p.prescribed->dofs();
      for (std::size_t k = 0; k < dofs.size(); ++k) {
        const double miss = u(dofs[k], 0) - values[k];
        mine[1] = std::max(mine[1], std::abs(miss));
        r(dofs[k], 0) = self.stiffness * miss;
      }
    }
  }
  Teuchos::reduceAll(*self.map->getComm(), Teuchos::REDUCE_SUM, 1, &mine[0], &all[0]);
  Teuchos::reduceAll(*self.map->getComm(), Teuchos::REDUCE_MAX, 1, &mine[1], &all[1]);
  norms.momentum_absolute = std::sqrt(all[0]);
  norms.momentum = norms.momentum_absolute / force;
  norms.prescribed = all[1] / p.length;
  norms.finite = std::isfinite(norms.momentum) && std::isfinite(norms.prescribed) && std::isfinite(norms.gap) && std::isfinite(norms.complementarity);
}

void SemiSmoothSystem::jacobian(const Vector& x) {
  Implementation& self = *implementation_;
  const SystemParts& p = self.parts;
  const RCP<const Vector> d = displacement(x);
  self.assemble(*d);
  if (!p.contact) {
    self.A = self.K;
    return;
  }
  std::optional<StepFailure> failure;
  p.contact->evaluate(*d, true, failure);
  throw_if_any(*self.map->getComm(), failure);
  Tpetra::deep_copy(*self.z, *multipliers(x));
  bool changed = false;
  const RCP<const Graph> graph = p.contact->system_graph(p.bulk_graph, changed);
  if (changed || self.A.is_null()) {
    self.A = rcp(new Matrix(graph));
    self.A->fillComplete(p.dofs, p.dofs);
    self.place_of_K_in_A = places_of_entries(*self.K, *self.A);
    self.graph_is_new = true;
  }
}

void SemiSmoothSystem::apply(const Vector& v, Vector& y) const {
  const Implementation& self = *implementation_;
  const SystemParts& p = self.parts;
  const RCP<const Vector> v_d = displacement(v);
  const RCP<Vector> y_d = displacement(y);
  if (p.contact) {
    copy_entries(*self.K, self.place_of_K_in_A, *self.A);
    p.contact->add_stiffness(*self.z, *self.A);
    self.A->fillComplete(p.dofs, p.dofs);
    const auto blocks = p.contact->saddle_point_blocks(*self.z);
    const RCP<const Vector> v_z = multipliers(v);
    self.A->apply(*v_d, *y_d);
    blocks.B->apply(*v_z, *y_d, Teuchos::NO_TRANS, 1.0, 1.0);
    const RCP<Vector> y_z = multipliers(y);
    blocks.C_d->apply(*v_d, *y_z);
    blocks.C_z->apply(*v_z, *y_z, Teuchos::NO_TRANS, 1.0, 1.0);
  } else {
    self.K->apply(*v_d, *y_d);
  }
  const auto out = y_d->getLocalViewHost(Tpetra::Access::ReadWrite);
  const auto in = v_d->getLocalViewHost(Tpetra::Access::ReadOnly);
  for (std::size_t i = 0; i < self.prescribed.size(); ++i)
    if (self.prescribed[i]) out(i, 0) = self.stiffness * in(i, 0);
}

// Rows of prescribed dofs: s dd = -F. Their columns go to the right-hand side, which keeps a symmetric matrix symmetric.
void SemiSmoothSystem::Implementation::eliminate_prescribed(const Vector& F_d, Vector& rhs) {
  const Graph& graph = *A->getCrsGraph();
  Vector value(parts.dofs), flag(parts.dofs);
  {
    const auto F_view = F_d.getLocalViewHost(Tpetra::Access::ReadOnly);
    const auto value_view = value.getLocalViewHost(Tpetra::Access::OverwriteAll);
    const auto flag_view = flag.getLocalViewHost(Tpetra::Access::OverwriteAll);
    for (std::size_t i = 0; i < prescribed.size(); ++i) {
      value_view(i, 0) = prescribed[i] ? -F_view(i, 0) / stiffness : 0.0;
      flag_view(i, 0) = prescribed[i];
    }
  }
  Vector column_value(graph.getColMap()), column_flag(graph.getColMap());
  if (graph.getImporter().is_null()) {
    Tpetra::deep_copy(column_value, value);
    Tpetra::deep_copy(column_flag, flag);
  } else {
    column_value.doImport(value, *graph.getImporter(), Tpetra::REPLACE);
    column_flag.doImport(flag, *graph.getImporter(), Tpetra::REPLACE);
  }
  const auto values = column_value.getLocalViewHost(Tpetra::Access::ReadOnly);
  const auto flags = column_flag.getLocalViewHost(Tpetra::Access::ReadOnly);
  const auto right = rhs.getLocalViewHost(Tpetra::Access::ReadWrite);
  const auto matrix = A->getLocalMatrixHost();
  const Map &rows = *A->getRowMap(), &columns = *A->getColMap();
  for (LocalOrdinal i = 0; i < matrix.numRows(); ++i) {
    auto row = matrix.row(i);
    if (prescribed[i]) {
      const LocalOrdinal diagonal = columns.getLocalElement(rows.getGlobalElement(i));
      for (LocalOrdinal k = 0; k < row.length; ++k) row.value(k) = row.colidx(k) == diagonal ? stiffness : 0.0;
      right(i, 0) = stiffness * values(diagonal, 0);
      continue;
    }
    for (LocalOrdinal k = 0; k < row.length; ++k) {
      if (flags(row.colidx(k), 0) == 0.0) continue;
      right(i, 0) -= row.value(k) * values(row.colidx(k), 0);
      row.value(k) = 0.0;
    }
  }
}

LinearSolveReport SemiSmoothSystem::newton_direction(const Vector& F, Vector& direction) {
  Implementation& self = *implementation_;
  const SystemParts& p = self.parts;
  const RCP<const Vector> F_d = displacement(F);
  Vector rhs(*F_d, Teuchos::Copy);
  rhs.scale(-1.0);
  if (p.contact) {
    copy_entries(*self.K, self.place_of_K_in_A, *self.A);
    self.contact_force->putScalar(0.0);
    p.contact->add_contact_force(*self.z, *self.contact_force);
    rhs.update(1.0, *self.contact_force, 1.0);  // the condensation wants -r without f_c
    p.contact->add_stiffness(*self.z, *self.A);
    p.contact->condense(*self.z, *self.A, rhs);
    self.A->fillComplete(p.dofs, p.dofs);
  }
  {
    const auto scope = self.timers.scope("boundary conditions");
    self.eliminate_prescribed(*F_d, rhs);
  }
  const RCP<Vector> step = displacement(direction);
  LinearSolveReport report;
  {
    const auto scope = self.timers.scope("linear setup");
    NearNullSpace near_null_space;
    if (p.near_null_space) near_null_space = p.near_null_space(*self.local_displacement);
    p.linear_solver->set_matrix(self.A, self.graph_is_new, near_null_space);
    self.graph_is_new = false;
  }
  {
    const auto scope = self.timers.scope("linear solve");
    step->putScalar(0.0);
    report = p.linear_solver->solve(rhs, *step);
  }
  if (p.contact) {
    const RCP<Vector> z_step = multipliers(direction);
    p.contact->recover(*step, *z_step);
    z_step->update(-1.0, *self.z, 1.0);
  }
  return report;
}

void SemiSmoothSystem::forces(const Vector& x, Vector& r) {
  Implementation& self = *implementation_;
  const RCP<const Vector> d = displacement(x);
  std::optional<StepFailure> failure;
  self.sum_forces(*d, failure);
  if (self.parts.contact) self.parts.contact->evaluate(*d, false, failure);
  throw_if_any(*self.map->getComm(), failure);
  r.update(1.0, *self.internal, 1.0, *self.external, 0.0);
  if (self.parts.contact) self.parts.contact->add_contact_force(*multipliers(x), r);
}

}  // namespace mortise
