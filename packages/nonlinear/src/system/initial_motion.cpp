#include "system/initial_motion.hpp"

#include <TpetraExt_MatrixMatrix.hpp>
#include <algorithm>

#include "system/system_model.hpp"

namespace mortise::detail {
namespace {

/// Of contributions with time derivatives, closed.
RCP<Matrix> mass_matrix(const SystemModel& model, const Configuration& at) {
  const auto mass = rcp(new Matrix(model.parts().bulk_graph()));
  mass->setAllToScalar(0.0);
  std::optional<StepFailure> failure;
  for (const auto& contribution : model.parts().contributions)
    if (contribution->uses().time_derivatives > 0) contribution->add_jacobian(at, {1.0, 0.0, 0.0}, *mass, failure);
  mass->fillComplete(model.parts().dofs, model.parts().dofs);
  throw_if_any(model.comm(), failure);
  return mass;
}

/// A with a diagonal, 0 where there was none.
RCP<Matrix> with_diagonal(const Matrix& A) {
  Matrix zeros(A.getRowMap(), 1);
  for (const GlobalOrdinal id : local_ids(*A.getRowMap())) {
    const double zero = 0.0;
    zeros.insertGlobalValues(id, 1, &zero, &id);
  }
  zeros.fillComplete();
  return Tpetra::MatrixMatrix::add(1.0, false, A, 1.0, false, zeros, A.getDomainMap(), A.getRangeMap());
}

/// Solves M u = b with u = 0 in some rows and in those without mass.
RCP<Vector> solve(LinearSolver& solver, const Matrix& M, Vector& b, std::vector<LocalOrdinal> rows) {
  const RCP<Matrix> A = with_diagonal(M);
  Vector diagonal(A->getRowMap());
  A->getLocalDiagCopy(diagonal);
  {
    const auto entries = diagonal.getLocalViewHost(Tpetra::Access::ReadOnly);
    for (std::size_t row = 0; row < entries.extent(0); ++row)
      if (entries(row, 0) == 0.0) rows.push_back(static_cast<LocalOrdinal>(row));
  }
  std::sort(rows.begin(), rows.end());
  rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
  const double scale = diagonal.normInf();
  const auto u = rcp(new Vector(A->getRowMap()));
  if (scale == 0.0) return u;
  A->resumeFill();
  DirichletElimination(*A->getCrsGraph(), rows).impose(*A, *u, scale, b);
  A->fillComplete(A->getRowMap(), A->getRowMap());
  solver.set_matrix(A, true, {});
  solver.solve(b, *u);
  solver.forget();
  return u;
}

}  // namespace

void begin_motion(const SystemModel& model, const Vector& velocity, bool at_rest, AcceptedState& state) {
  const TimeIntegration& integration = *model.parts().time;
  const auto at = model.begin_evaluation(*state.x, state.context);
  model.add_forces(*at);
  state.internal_forces = at->internal;
  if (model.reduction() != nullptr) {
    const Configuration configuration = model.configuration(state.context.time, *at->d);
    at->follow = std::make_shared<const FollowedUnknowns>(model.shared_reduction(), state.context.time, configuration.local_unknowns);
  }
  RCP<Vector> v = rcp(new Vector(velocity, Teuchos::Copy));
  const auto a = rcp(new Vector(model.parts().dofs));
  if (at->follow) v = at->follow->expanded(*model.reduction()->unknown_part(velocity));
  if (!at_rest) {
    const Configuration configuration = model.configuration(state.context.time, *at->d, BlendedRates{v, a});
    const RCP<Matrix> mass = mass_matrix(model, configuration);
    std::optional<StepFailure> failure;
    for (const auto& contribution : model.parts().contributions)
      if (contribution->uses().time_derivatives > 0) contribution->add_residual(configuration, at->forces, failure);
    throw_if_any(model.comm(), failure);
    Vector rhs(at->forces, Teuchos::Copy);
    rhs.scale(-1.0);
    LinearSolver& solver = *model.parts().linear_solver;
    if (at->follow) {
      const RCP<Vector> convected = at->follow->convected(*model.reduction()->unknown_part(*v));
      mass->apply(*convected, rhs, Teuchos::NO_TRANS, -1.0, 1.0);
      const RCP<Vector> b = at->follow->reduced(rhs);
      const Vector none(model.parts().dofs);
      const RCP<Vector> of_unknowns = solve(solver, *at->follow->reduced(*mass, none), *b, model.reduction()->held_places(model.prescribed()));
      a->update(1.0, *at->follow->expanded(*of_unknowns), 1.0, *convected, 0.0);
    } else {
      Tpetra::deep_copy(*a, *solve(solver, *mass, rhs, model.prescribed()));
    }
    if (!integration.extension.is_null()) {
      const Vector massive(*a, Teuchos::Copy);
      integration.extension->apply(massive, *a);
    }
  }
  AcceptedRates rates;
  rates.velocity = v;
  rates.acceleration = a;
  if (integration.scheme.has_balanced_acceleration()) rates.balanced_acceleration = a;
  if (integration.scheme.blends_forces()) rates.external_forces = rcp(new Vector(at->external, Teuchos::Copy));
  state.rates = rates;
}

}  // namespace mortise::detail
