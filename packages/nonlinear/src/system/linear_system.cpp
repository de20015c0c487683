#include "system/linear_system.hpp"

#include <TpetraExt_MatrixMatrix.hpp>
#include <algorithm>
#include <stdexcept>

#include "mortise/core/matrix_sum.hpp"

namespace mortise::detail {
namespace {

void close(Matrix& matrix) {
  if (matrix.isFillActive()) matrix.fillComplete(matrix.getRowMap(), matrix.getRowMap());
}

void add_further(const Matrix& rows, Matrix& matrix) {
  if (!add_entries(rows, matrix))
    throw std::logic_error("a contact contribution has an entry without place in the graph of the system; contact has to know its field");
}

RCP<Matrix> with_further_rows(const Matrix& B, const Matrix& further) {
  return Tpetra::MatrixMatrix::add(1.0, false, B, 1.0, false, further, B.getDomainMap(), B.getRangeMap());
}

// The owned dofs of other fields than the one that is solved for, but those that follow.
std::vector<LocalOrdinal> dofs_of_other_fields(const SystemModel& model, std::size_t field) {
  std::vector<char> follows(local_id_count(*model.parts().dofs), 0);
  if (model.reduction())
    for (const LocalOrdinal row : model.reduction()->dependents()) follows[static_cast<std::size_t>(row)] = 1;
  std::vector<LocalOrdinal> rows;
  for (LocalOrdinal row = 0; row < static_cast<LocalOrdinal>(follows.size()); ++row)
    if (follows[static_cast<std::size_t>(row)] == 0 && model.sizes().field(row) != field) rows.push_back(row);
  return rows;
}

}  // namespace

// With followers F holds what is gathered from them; their own forces are wanted.
LinearSystem assembled(const SystemModel& model, const std::shared_ptr<const EvaluatedSystem>& at, const Vector& F,
                       const std::vector<LocalOrdinal>& held) {
  LinearSystem system;
  system.matrix = model.take_stiffness(at);
  const RCP<const Vector> residual = model.d(F);
  system.rhs = rcp(new Vector(at->follow ? at->forces : *residual, Teuchos::Copy));
  system.rhs->scale(-1.0);
  system.prescribed = model.prescribed();
  system.increment = rcp(new Vector(model.parts().dofs));
  {
    const auto step = system.increment->getLocalViewHost(Tpetra::Access::ReadWrite);
    const auto rows = residual->getLocalViewHost(Tpetra::Access::ReadOnly);
    for (const LocalOrdinal row : system.prescribed) step(row, 0) = -rows(row, 0) / model.stiffness_scale_of(row);
  }
  const auto hold = [&](const std::vector<LocalOrdinal>& dofs) {
    system.prescribed.insert(system.prescribed.end(), dofs.begin(), dofs.end());
    std::sort(system.prescribed.begin(), system.prescribed.end());
    system.prescribed.erase(std::unique(system.prescribed.begin(), system.prescribed.end()), system.prescribed.end());
  };
  if (!held.empty()) hold(held);
  if (at->context.field) hold(dofs_of_other_fields(model, *at->context.field));
  system.multigrid.alone = at->context.field;
  if (model.parts().near_null_space) system.multigrid.near_null_space = [&model, d = at->d] { return model.parts().near_null_space(*d); };
  if (model.sizes().fields() > 1) system.multigrid.fields = [&model] { return model.field_rows(); };
  system.recover = [](const Vector& u, Vector& dd, Vector&) { Tpetra::deep_copy(dd, u); };
  system.restricted = system.prolonged = [](const Vector& v) { return rcp(new Vector(v, Teuchos::Copy)); };
  return system;
}

LinearSystem with_contact(const SystemModel& model, const EvaluatedSystem& at, const Vector& F, GeometricContactStiffness geometric_stiffness,
                          LinearSystem system) {
  if (!at.contact) return system;
  const ContactLinearisation linearised = at.contact->linearise(*at.laws);
  if (geometric_stiffness == GeometricContactStiffness::included) linearised.add_stiffness(*system.matrix);
  const ContactContribution::Derivatives further = model.derivatives_of_contact_contributions(at, linearised);
  if (!further.of_unknowns.is_null()) add_further(*further.of_unknowns, *system.matrix);
  if (at.context.field && *at.context.field != 0) {  // multipliers keep their values
    system.recover = [inner = system.recover](const Vector& u, Vector& dd, Vector& dz) {
      inner(u, dd, dz);
      dz.putScalar(0.0);
    };
    return system;
  }
  if (model.parts().contact->keeps_multipliers()) {
    const auto rhs = rcp(new Vector(*model.z(F), Teuchos::Copy));
    rhs->elementWiseMultiply(-1.0, *model.parts().contact->weights(), *model.z(F), 0.0);
    system.kept = KeptMultipliers{linearised.saddle_point_blocks(), rhs};
    if (!further.of_multipliers.is_null()) system.kept->blocks.B = with_further_rows(*system.kept->blocks.B, *further.of_multipliers);
    system.multigrid = {};
    return system;
  }
  Vector contact_force(model.parts().dofs);
  at.laws->add_force(contact_force);
  system.rhs->update(1.0, contact_force, 1.0);  // -r without f_c
  system.condensed = std::make_shared<const NodeElimination>(linearised.condense(*system.matrix, *system.rhs));
  if (!further.of_multipliers.is_null()) {  // G z = G (b + S dd), beside G z^k in r
    system.further = further.of_multipliers;
    const SubstitutedRows substituted = system.condensed->substitute(*system.further);
    add_further(*substituted.of_dofs, *system.matrix);
    system.further->apply(*at.z, *system.rhs, Teuchos::NO_TRANS, 1.0, 1.0);
    system.rhs->update(-1.0, *substituted.constant, 1.0);
  }
  // The linear solver keeps the function until its next matrix, but what it asks must not stay as long.
  system.multigrid.decoupling = [condensed = std::weak_ptr<const NodeElimination>(system.condensed)] { return condensed.lock()->decoupling(); };
  return system;
}

LinearSystem reduced(const SystemModel& model, const EvaluatedSystem& at, LinearSystem system) {
  if (!at.follow) return system;
  const FollowedUnknowns& follow = *at.follow;
  const Reduction& reduction = *model.reduction();
  close(*system.matrix);
  const auto start = rcp(new Vector(model.parts().dofs));  // d0
  follow.deviation(*at.d, -1.0, *start);
  Vector force(model.parts().dofs);
  system.matrix->apply(*start, force);
  system.rhs->update(-1.0, force, 1.0);
  if (system.kept) {
    SaddlePointBlocks& blocks = system.kept->blocks;
    Vector change(model.multipliers());
    blocks.C_d->apply(*start, change);
    system.kept->rhs->elementWiseMultiply(-1.0, *model.parts().contact->weights(), change, 1.0);
    blocks.B = follow.reduced_rows(*blocks.B);
    blocks.C_d = follow.reduced_columns(*blocks.C_d);
  }
  system.matrix = follow.reduced(*system.matrix, at.forces);
  system.rhs = follow.reduced(*system.rhs);
  system.prescribed = reduction.held_places(system.prescribed);
  system.increment = reduction.unknown_part(*system.increment);
  const MultigridInput of_dofs = system.multigrid;
  if (of_dofs.near_null_space) system.multigrid.near_null_space = [&reduction, of_dofs] { return reduction.reduced(of_dofs.near_null_space()); };
  if (of_dofs.fields) system.multigrid.fields = [&reduction, of_dofs] { return reduction.reduced(of_dofs.fields()); };
  if (of_dofs.decoupling) system.multigrid.decoupling = [&reduction, of_dofs] { return reduction.reduced(of_dofs.decoupling()); };
  system.restricted = [&follow](const Vector& rows) { return follow.reduced(rows); };
  system.prolonged = [&follow](const Vector& dq) { return follow.expanded(dq); };
  system.recover = [&model, &follow, start, inner = system.recover](const Vector& dq, Vector& dd, Vector& dz) {
    Vector u(model.parts().dofs);
    u.update(1.0, *follow.expanded(dq), 1.0, *start, 0.0);
    inner(u, dd, dz);
  };
  return system;
}

LinearSystem merged(const SystemModel& model, LinearSystem system) {
  if (!system.kept) return system;
  close(*system.matrix);
  const SaddlePointBlocks& blocks = system.kept->blocks;
  const RCP<const Map> rows = system.matrix->getRowMap();
  SaddlePointMatrix& saddle_point = model.saddle_point();
  system.matrix = saddle_point.merged(*system.matrix, *blocks.B, *blocks.C_d, *blocks.C_z, *model.parts().contact->weights());
  system.rhs = saddle_point.merged(*system.rhs, *system.kept->rhs);
  system.increment = saddle_point.merged(*system.increment, Vector(model.multipliers()));
  system.kept.reset();
  system.recover = [&model, &saddle_point, rows, inner = system.recover](const Vector& both, Vector& dd, Vector& dz) {
    Vector u(rows);
    saddle_point.split(both, u, dz);
    inner(u, dd, dz);
  };
  return system;
}

LinearSystem constrained(const SystemModel& model, LinearSystem system) {
  const auto [elimination, is_new] = model.constraints().match(system.matrix->getCrsGraph(), system.prescribed);
  system.has_new_pattern = is_new;
  if (!system.matrix->isFillActive()) system.matrix->resumeFill();
  elimination.impose(*system.matrix, *system.increment, model.stiffness_scale(), *system.rhs);
  close(*system.matrix);
  system.restricted = [rows = system.prescribed, inner = system.restricted](const Vector& of_dofs) {
    const RCP<Vector> result = inner(of_dofs);
    const auto view = result->getLocalViewHost(Tpetra::Access::ReadWrite);
    for (const LocalOrdinal row : rows) view(row, 0) = 0.0;
    return result;
  };
  system.recover = [rows = system.prescribed, increment = system.increment, inner = system.recover](const Vector& u, Vector& dd, Vector& dz) {
    Vector whole(u, Teuchos::Copy);
    {
      const auto from = increment->getLocalViewHost(Tpetra::Access::ReadOnly);
      const auto to = whole.getLocalViewHost(Tpetra::Access::ReadWrite);
      for (const LocalOrdinal row : rows) to(row, 0) = from(row, 0);
    }
    inner(whole, dd, dz);
  };
  return system;
}

}  // namespace mortise::detail
