#include <Teuchos_CommHelpers.hpp>
#include <algorithm>
#include <cmath>
#include <limits>

#include "system/active_set_hash.hpp"
#include "system/system_model.hpp"

namespace mortise::detail {
namespace {

// Forces below this, relative to stiffness times displacement, are the round-off of f_int. The momentum of a body that only moved rigidly is measured
// against it instead of against nothing.
constexpr double round_off_floor = 1e-6;

// Of a row sum K_ij x_j with some tens of terms, over the diagonal times x.
constexpr double row_round_off = 16.0 * std::numeric_limits<double>::epsilon();

}  // namespace

// F: r = f_int - f_ext + f_c; rows of prescribed dofs: s (d - prescribed); C.
void SystemModel::add_norms(EvaluatedSystem& at) const {
  const RCP<Vector> r = d(at.residual);
  Tpetra::deep_copy(*r, at.forces);
  ResidualNorms& norms = at.norms;
  std::vector<double> force = sizes_.norms(*at.internal);  // [fields]
  const std::vector<double> external_force = sizes_.norms(at.external), displacement = sizes_.norms(*at.d);
  for (std::size_t field = 0; field < force.size(); ++field) force[field] = std::max(force[field], external_force[field]);
  if (!at.of_rates.is_null()) {
    const std::vector<double> rate_force = sizes_.norms(*at.of_rates);
    for (std::size_t field = 0; field < force.size(); ++field) force[field] = std::max(force[field], rate_force[field]);
  }
  if (!at.of_contact.is_null()) {
    const std::vector<double> contact_flow = sizes_.norms(*at.of_contact);
    for (std::size_t field = 0; field < force.size(); ++field) force[field] = std::max(force[field], contact_flow[field]);
  }
  const std::optional<std::size_t>& alone = at.context.field;
  const auto is_solved_for = [&](std::size_t field) { return !alone || *alone == field; };
  double other = 0.0, violation = 0.0;
  std::optional<StepFailure> failure;  // why something is not finite
  if (parts_.contact) {
    const RCP<Vector> C = z(at.residual);
    at.laws->complementarity(*C);
    other = C->norm2();
    if (!std::isfinite(other)) failure = at.laws->friction_failure();
    const ContactNorms contact = at.laws->norms(at.context.states);
    norms.active = contact.active;
    norms.sticking = contact.sticking;
    if (is_solved_for(0)) {
      norms.gap = contact.gap;
      norms.complementarity = contact.complementarity;
      violation = contact.violation;
      norms.changed = contact.changed;
    } else {
      C->putScalar(0.0);
    }
    norms.active_set = active_set_hash(*parts_.contact, at.laws->states(), comm());
    force[0] = std::max(force[0], contact.force);
  }

  // Momentum on the free rows alone, then the prescribed ones and those of followers.
  if (at.follow) at.follow->gather(*r);
  std::vector<double> deviation;  // d - prescribed
  double largest = 0.0;
  if (parts_.constraints) deviation = parts_.constraints->prescribed_values(at.context.time, failure);
  if (at.follow && !failure) failure = at.follow->failure();
  {
    if (at.follow) {
      const double of_followers = at.follow->deviation(*at.d, 0.0, *r);
      if (!alone) largest = of_followers;
    }
    const auto unknowns = at.d->getLocalViewHost(Tpetra::Access::ReadOnly);
    const auto rows = r->getLocalViewHost(Tpetra::Access::ReadWrite);
    for (std::size_t i = 0; i < prescribed_.size(); ++i) {
      deviation[i] = is_solved_for(sizes_.field(prescribed_[i])) ? unknowns(prescribed_[i], 0) - deviation[i] : 0.0;
      largest = std::max(largest, std::abs(deviation[i]) * parts_.length / sizes_.size(sizes_.field(prescribed_[i])));
      rows(prescribed_[i], 0) = 0.0;
    }
    for (std::size_t row = 0; alone && row < rows.extent(0); ++row)
      if (!is_solved_for(sizes_.field(static_cast<LocalOrdinal>(row)))) rows(row, 0) = 0.0;
  }
  const auto total = [&](const std::vector<double>& of_fields) {
    if (of_fields.size() == 1) return of_fields[0];
    double squares = 0.0;
    for (std::size_t field = 0; field < of_fields.size(); ++field) squares += std::pow(weight(field) * of_fields[field], 2);
    return std::sqrt(squares);
  };
  const std::vector<double> out_of_balance = sizes_.norms(*r);
  norms.momentum_absolute = total(out_of_balance);
  bool finite = std::isfinite(other);
  for (std::size_t field = 0; field < force.size(); ++field) {
    force[field] = std::max(force[field], round_off_floor * diagonal_scale(field, at.context.step.get()) * displacement[field]);
    finite = finite && std::isfinite(force[field]);
    // Rows of further fields sum up to nothing where the field is uniform, however large: of a temperature of 300 K and 1 mK of difference, round-off
    // of its value is left.
    // Of a displacement it is that of positions. Where a temperature is, all forces may be nothing beside it: bodies that expand freely bear none.
    const double size = field == 0 ? position_norm() : displacement[field];
    const double round_off = row_round_off * diagonal_scale(field, at.context.step.get()) * size;
    if (out_of_balance[field] > round_off) norms.momentum = std::max(norms.momentum, out_of_balance[field] / force[field]);
  }
  if (!std::isfinite(norms.momentum_absolute)) norms.momentum = norms.momentum_absolute;  // a maximum passes over what is no number
  // F = I + grad u is known to eps, and so are stresses, to eps E; contact forces come from positions, known to eps |x| at each closed node.
  norms.round_off =
      4.0 * std::numeric_limits<double>::epsilon() * diagonal_scale(0, at.context.step.get()) * parts_.length * std::sqrt(1.0 + norms.active);
  Teuchos::reduceAll(comm(), Teuchos::REDUCE_MAX, largest / parts_.length, Teuchos::outArg(norms.prescribed));
  {
    const auto rows = r->getLocalViewHost(Tpetra::Access::ReadWrite);
    for (std::size_t i = 0; i < prescribed_.size(); ++i) rows(prescribed_[i], 0) = stiffness_scale_of(prescribed_[i]) * deviation[i];
  }
  if (at.follow && !alone) at.follow->deviation(*at.d, stiffness_scale(), *r);
  const std::vector<double> of_rows = sizes_.norms(*r);
  const double rows = total(of_rows);
  if (force.size() > 1)
    for (std::size_t field = 0; field < force.size(); ++field)
      norms.fields.push_back({field == 0 ? std::hypot(of_rows[field], violation) : of_rows[field], force[field]});
  norms.finite = finite && std::isfinite(rows);
  if (!norms.finite) throw_if_any(comm(), failure);  // all ranks have the same norms
  norms.merit = norms.finite ? std::hypot(rows, violation) : std::numeric_limits<double>::infinity();
}

double SystemModel::position_norm() const {
  if (sizes_.fields() == 1) return 0.0;
  if (!position_norm_) {
    Vector ones(parts_.dofs);
    ones.putScalar(1.0);
    position_norm_ = parts_.length * sizes_.norms(ones)[0];
  }
  return *position_norm_;
}

double SystemModel::diagonal_scale(std::size_t field, const TimeStep* step) const {
  if (step == nullptr || static_scales_.empty()) return stiffness_scale(field);
  return step->integration->scheme.force_share() * static_scales_[field] + step->weights().acceleration * mass_scales_[field];
}

}  // namespace mortise::detail
