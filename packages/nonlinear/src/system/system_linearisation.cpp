#include "mortise/nonlinear/system_linearisation.hpp"

#include <algorithm>
#include <string>

#include "system/linear_system.hpp"

namespace mortise {
namespace {

using detail::SystemModel;

// The failure of the linear solver, with what the solver cannot know.
StepFailure explained(const SystemModel& model, const StepFailure& failure) {
  const ContactSystem* contact = model.parts().contact.get();
  bool two_passes = false;
  for (std::size_t pair = 0; contact != nullptr && pair < contact->pairs(); ++pair) two_passes |= contact->second_pass(pair).has_value();
  if (!two_passes) return failure;
  return StepFailure(failure.kind(), std::string(failure.what()) +
                                         "; two passes ask for contact at the nodes of both sides, which over-constrains surfaces that touch over "
                                         "more than a facet: take \"passes\" \"single\", or a mortar formulation");
}

}  // namespace

// y_d = (K + C~) v_d + B v_z,  y_z = C_d v_d + C_z v_z;  s v on prescribed rows
void SystemLinearisation::apply(const Vector& v, Vector& y) const {
  const SystemModel& model = *model_;
  const detail::EvaluatedSystem& at = detail::evaluated(evaluation_);
  const RCP<const Vector> v_d = model.d(v), v_z = model.z(v);
  const RCP<Vector> y_d = model.d(y);
  if (at.contact) {
    const RCP<Matrix> matrix = model.take_stiffness(evaluation_.evaluated_);
    const ContactLinearisation linearised = at.contact->linearise(*at.laws);
    linearised.add_stiffness(*matrix);
    const ContactContribution::Derivatives further = model.derivatives_of_contact_contributions(at, linearised);
    matrix->fillComplete(matrix->getRowMap(), matrix->getRowMap());
    const SaddlePointBlocks blocks = linearised.saddle_point_blocks();
    const RCP<Vector> y_z = model.z(y);
    matrix->apply(*v_d, *y_d);
    blocks.B->apply(*v_z, *y_d, Teuchos::NO_TRANS, 1.0, 1.0);
    if (!further.of_unknowns.is_null()) further.of_unknowns->apply(*v_d, *y_d, Teuchos::NO_TRANS, 1.0, 1.0);
    if (!further.of_multipliers.is_null()) further.of_multipliers->apply(*v_z, *y_d, Teuchos::NO_TRANS, 1.0, 1.0);
    blocks.C_d->apply(*v_d, *y_z);
    blocks.C_z->apply(*v_z, *y_z, Teuchos::NO_TRANS, 1.0, 1.0);
  } else {
    model.stiffness(evaluation_.evaluated_)->apply(*v_d, *y_d);
  }
  if (at.follow) {
    at.follow->gather(*y_d);
    at.follow->add_curvature(at.forces, *v_d, *y_d);
    // s (v_i - sum_k dg_i/dq_k v_k)
    const RCP<Vector> followed = at.follow->expanded(*model.reduction()->unknown_part(*v_d));
    const auto change = v_d->getLocalViewHost(Tpetra::Access::ReadOnly), follows = followed->getLocalViewHost(Tpetra::Access::ReadOnly);
    const auto rows = y_d->getLocalViewHost(Tpetra::Access::ReadWrite);
    for (const LocalOrdinal row : model.reduction()->dependents()) rows(row, 0) = model.stiffness_scale() * (change(row, 0) - follows(row, 0));
  }
  const auto step = v_d->getLocalViewHost(Tpetra::Access::ReadOnly);
  const auto rows = y_d->getLocalViewHost(Tpetra::Access::ReadWrite);
  for (const LocalOrdinal row : model.prescribed()) rows(row, 0) = model.stiffness_scale_of(row) * step(row, 0);
}

LinearSolveReport SystemLinearisation::newton_direction(const Vector& F, Vector& direction, double tolerance,
                                                        GeometricContactStiffness geometric_stiffness, const HeldMotions* held) const {
  const SystemModel& model = *model_;
  const detail::EvaluatedSystem& at = detail::evaluated(evaluation_);
  detail::LinearSystem system = detail::assembled(model, evaluation_.evaluated_, F, held != nullptr ? held->dofs : std::vector<LocalOrdinal>{});
  system = detail::with_contact(model, at, F, geometric_stiffness, std::move(system));
  system = detail::reduced(model, at, std::move(system));
  system = detail::merged(model, std::move(system));
  system = detail::constrained(model, std::move(system));

  LinearSolver& solver = *model.parts().linear_solver;
  solver.set_matrix(system.matrix, system.has_new_pattern, system.multigrid);
  Vector u(system.matrix->getRowMap());
  LinearSolveReport report;
  try {
    report = solver.solve(*system.rhs, u, tolerance);
  } catch (const StepFailure& failure) {  // on every rank
    throw explained(model, failure);
  }
  const RCP<Vector> dd = model.d(direction), dz = model.z(direction);
  system.recover(u, *dd, *dz);
  if (system.condensed) {
    // Where only C differs nothing prescribed moves, nor does what follows or is tied by itself.
    const auto solve = [&](const Vector& right, Vector& change) {
      const RCP<Vector> b = system.restricted(right);
      Vector q(b->getMap());
      report.iterations += solver.solve(*b, q, tolerance).iterations;
      Tpetra::deep_copy(change, *system.prolonged(q));
    };
    system.condensed->complete(solve, *dd, *dz, system.further.get(), std::max(tolerance, 1e-10));
  }
  if (held != nullptr) held->take_out(*dd);
  return report;
}

}  // namespace mortise
