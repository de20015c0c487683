#include "mortise/nonlinear/semi_smooth_system.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "active_set_hash.hpp"
#include "semi_smooth_system_parts.hpp"

namespace mortise {
namespace {

// Forces below this, relative to stiffness times displacement, are the round-off of f_int. The momentum of a body that only moved rigidly is measured
// against it instead of against nothing.
constexpr double round_off_floor = 1e-6;

}  // namespace

RCP<const Map> detail::map_of_both(const Map& dofs, const Map& multipliers) {
  std::vector<GlobalOrdinal> ids;
  for (const GlobalOrdinal id : dofs.getNodeElementList()) ids.push_back(id);
  for (const GlobalOrdinal id : multipliers.getNodeElementList()) ids.push_back(id);
  const auto invalid = Teuchos::OrdinalTraits<Tpetra::global_size_t>::invalid();
  return rcp(new Map(invalid, ids.data(), static_cast<LocalOrdinal>(ids.size()), 0, dofs.getComm()));
}

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
RCP<const Vector> SemiSmoothSystem::linearised_at() const { return implementation_->jacobian_at; }
double SemiSmoothSystem::stiffness_scale() const { return implementation_->stiffness_scale; }

// Jacobians belong to a time.
void SemiSmoothSystem::set_time(double time) {
  implementation_->time = time;
  implementation_->jacobian_at = Teuchos::null;
}

// r = f_int - f_ext + f_c; rows of prescribed dofs: s (d - prescribed); C.
void SemiSmoothSystem::residual(const Vector& x, Vector& F, ResidualNorms& norms) {
  Implementation& self = *implementation_;
  const RCP<const Vector> d = displacement(x), z = multipliers(x);
  self.evaluate_bulk(*d);
  norms = {};
  const RCP<Vector> r = displacement(F);
  if (self.parts.contact) self.evaluate_contact(*d);
  if (self.stiffness_scale == 0.0) self.assemble_bulk(*d);
  self.sum_forces(*d, *z, *r);
  double force = std::max(self.internal.norm2(), self.external.norm2());
  double other = 0.0, violation = 0.0;
  std::optional<StepFailure> failure;  // why something is not finite
  if (self.parts.contact) {
    const RCP<Vector> C = multipliers(F);
    const ContactLaws& laws = self.laws_at(*d, *z);
    laws.complementarity(*C);
    other = C->norm2();
    if (!std::isfinite(other)) failure = laws.friction_failure();
    const ContactNorms contact = laws.norms(self.last_states);
    norms.gap = contact.gap;
    norms.complementarity = contact.complementarity;
    violation = contact.violation;
    norms.active = contact.active;
    norms.sticking = contact.sticking;
    norms.changed = contact.changed;
    norms.active_set = detail::active_set_hash(*self.parts.contact, laws.states(), self.comm());
    force = std::max(force, contact.force);
  }

  // Momentum on the free rows alone, then the prescribed ones and those of followers.
  if (self.reduction) self.reduction->gather(*r);
  std::vector<double> deviation;  // d - prescribed
  double largest = 0.0;
  if (self.parts.prescribed) deviation = self.parts.prescribed->values(self.time, failure);
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
  if (!norms.finite) throw_if_any(self.comm(), failure);  // all ranks have the same norms
  norms.merit = norms.finite ? std::hypot(rows, violation) : std::numeric_limits<double>::infinity();
}

double SemiSmoothSystem::prescribed_deviation(const Vector& x) const {
  const Implementation& self = *implementation_;
  double mine = 0.0, largest = 0.0;
  if (self.parts.prescribed) {
    std::optional<StepFailure> failure;  // residual() says it
    const std::vector<double> values = self.parts.prescribed->values(self.time, failure);
    const RCP<const Vector> d = displacement(x);
    const auto displacements = d->getLocalViewHost(Tpetra::Access::ReadOnly);
    for (std::size_t i = 0; i < self.fixed.size(); ++i) mine = std::max(mine, std::abs(displacements(self.fixed[i], 0) - values[i]));
  }
  Teuchos::reduceAll(self.comm(), Teuchos::REDUCE_MAX, mine / self.parts.length, Teuchos::outArg(largest));
  return largest;
}

bool SemiSmoothSystem::follow_cover(Vector& x) {
  Implementation& self = *implementation_;
  if (!self.parts.contact) return false;
  self.evaluate_contact(*displacement(x));
  return self.contact->follow_cover(self.last_states, *multipliers(x));
}

void SemiSmoothSystem::start_step(Vector& x, const std::vector<char>& unconstrained) {
  Implementation& self = *implementation_;
  if (!self.parts.contact) return;
  const ContactSystem& contact = *self.parts.contact;
  const RCP<Vector> d = displacement(x);
  self.committed.reset();
  self.have_history(*d);
  for (const auto& [pair, depth] : self.allowed_overlaps)
    if ((*self.accepted)->pairs[pair].allowed_overlap != depth) self.accepted = contact.allow_overlap(*self.accepted, pair, depth);
  self.take_history(contact.start_step(*self.accepted, *d, unconstrained, *multipliers(x)));
}

void SemiSmoothSystem::allow_overlap(std::size_t pair, double depth) { implementation_->allowed_overlaps[pair] = depth; }

ContactLaws SemiSmoothSystem::contact_laws(const Vector& x) {
  Implementation& self = *implementation_;
  const RCP<const Vector> d = displacement(x), z = multipliers(x);
  if (self.committed && !self.committed_at.is_null() && detail::same_values(x, *self.committed_at)) return *self.committed;
  return self.laws_at(*d, *z);
}

const std::optional<ContactHistory>& SemiSmoothSystem::contact_history() const { return implementation_->accepted; }

void SemiSmoothSystem::forces(const Vector& x, Vector& r) {
  Implementation& self = *implementation_;
  const RCP<const Vector> d = displacement(x);
  self.evaluate_bulk(*d);
  if (self.parts.contact) self.have_history(*d);
  self.sum_forces(*d, *multipliers(x), r);
  if (self.reduction) self.reduction->gather(r);
}

void SemiSmoothSystem::commit(const Vector& x) {
  const RCP<const Vector> d = displacement(x);
  const Configuration at = implementation_->configuration(*d);
  for (const auto& contribution : implementation_->parts.contributions) contribution->commit(at);
  // The forces of the committed state are those that it was found with; at any other displacement they depend on what has been committed.
  RCP<Vector>& internal_at = implementation_->internal_at;
  if (!internal_at.is_null() && !detail::same_values(*d, *internal_at)) internal_at = Teuchos::null;
  Implementation& self = *implementation_;
  if (!self.parts.contact) return;
  self.committed = self.laws_at(*d, *multipliers(x));
  self.committed_at = rcp(new Vector(x, Teuchos::Copy));
  self.accepted = self.parts.contact->commit(*self.committed);
  self.take_history(*self.accepted);
}

bool SemiSmoothSystem::augment(const Vector& x, int round) {
  Implementation& self = *implementation_;
  if (!self.parts.contact) return false;
  const Augmentation result = self.parts.contact->augment(self.laws_at(*displacement(x), *multipliers(x)), round);
  if (result.exhausted)
    throw StepFailure(
        FailureKind::augmentation,
        fmt::format("contact \"{}\": after {} updates of the multipliers, one more would change them by {:.2e} of the largest one, {}; allowed "
                    "is an error of {:.0e}; please allow more \"augmentations\", or take smaller steps",
                    result.pair, round - 1, result.change,
                    std::isfinite(result.error) ? fmt::format("and they are wrong by about {:.2e} of it", result.error)
                                                : std::string("and they have not fallen once"),
                    result.tolerance));
  if (result.history) {
    self.history = result.history;
    self.contact = self.contact->with(*result.history);
    self.laws.reset();
  }
  return result.more;
}

void SemiSmoothSystem::jacobian(const Vector& x) {
  Implementation& self = *implementation_;
  const RCP<const Vector> d = displacement(x);
  self.jacobian_at = Teuchos::null;
  if (self.parts.contact) {
    self.last_states = self.laws_at(*d, *multipliers(x)).states();
  }
  self.assemble_bulk(*d);
  self.jacobian_at = rcp(new Vector(x, Teuchos::Copy));
}

// y_d = (K + C~) v_d + B v_z,  y_z = C_d v_d + C_z v_z;  s v on prescribed rows
void SemiSmoothSystem::apply(const Vector& v, Vector& y) const {
  Implementation& self = *implementation_;
  self.evaluate_at_jacobian();
  const RCP<const Vector> v_d = displacement(v), v_z = multipliers(v);
  const RCP<Vector> y_d = displacement(y);
  if (self.parts.contact) {
    const ContactLinearisation linearised = self.linearised_contact();
    self.open_matrix();
    linearised.add_stiffness(*self.matrix);
    self.matrix->fillComplete(self.parts.dofs, self.parts.dofs);
    const SaddlePointBlocks blocks = linearised.saddle_point_blocks();
    const RCP<Vector> y_z = multipliers(y);
    self.matrix->apply(*v_d, *y_d);
    blocks.B->apply(*v_z, *y_d, Teuchos::NO_TRANS, 1.0, 1.0);
    blocks.C_d->apply(*v_d, *y_z);
    blocks.C_z->apply(*v_z, *y_z, Teuchos::NO_TRANS, 1.0, 1.0);
  } else {
    self.matrix->apply(*v_d, *y_d);
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

}  // namespace mortise
