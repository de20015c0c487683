#include "multigrid/gmres.hpp"

#include <BelosConfigDefs.hpp>
#include <BelosLinearProblem.hpp>
#include <BelosSolverFactory_Tpetra.hpp>
#include <BelosTpetraAdapter.hpp>
#include <algorithm>

#include "linear/linear_system_checks.hpp"
#include "multigrid/solver_parameters.hpp"

namespace mortise::detail {
namespace {

using LinearProblem = Belos::LinearProblem<Scalar, MultiVector, Operator>;
using SolverFactory = Belos::TpetraSolverFactory<Scalar, MultiVector, Operator>;

/// Vectors that GMRES keeps, allocated at its start, before it restarts: for the first systems, and from one on that took more.
constexpr int small_basis = 50, large_basis = 200;

/// Mortise's parameters of Belos, and over them those that are given.
RCP<Teuchos::ParameterList> belos_parameters(const LinearSolverOptions& options, double tolerance, int basis) {
  const auto list = rcp(new Teuchos::ParameterList("Belos"));
  list->set("Convergence Tolerance", tolerance);
  list->set("Implicit Residual Scaling", "Norm of RHS");
  list->set("Explicit Residual Scaling", "Norm of RHS");
  list->set("Maximum Iterations", options.maximum_iterations);
  list->set("Num Blocks", std::min(options.maximum_iterations, basis));
  list->set("Verbosity", 0);
  list->setParameters(options.belos.value);
  return list;
}

}  // namespace

GmresReport Gmres::solve(const RCP<const Operator>& A, const RCP<const Operator>& preconditioner, const Vector& b, Vector& x, double tolerance,
                         double most_iterations) {
  const auto problem = rcp(new LinearProblem(A, rcp(&x, false), rcp(&b, false)));
  problem->setRightPrec(preconditioner);
  if (!problem->setProblem()) throw std::runtime_error("Belos refuses the linear problem");
  const int basis = has_large_basis_ ? large_basis : small_basis;
  const RCP<Teuchos::ParameterList> list = belos_parameters(options_, tolerance, basis);
  list->set("Maximum Iterations", static_cast<int>(std::min<double>(list->get<int>("Maximum Iterations"), most_iterations)));
  SolverFactory factory;
  const auto gmres = factory.create("GMRES", list);
  gmres->setProblem(problem);
  GmresReport report;
  try {
    report.converged = gmres->solve() == Belos::Converged;
    // Near round-off GMRES ends on its own residual, and Belos finds the true one a trifle above the tolerance: no fault of the preconditioner.
    if (!report.converged) {
      Vector r(b.getMap());
      report.converged = true_residual(*A, b, x, r) <= accepted_residual * tolerance * b.norm2();
    }
  } catch (const std::exception&) {
    report.converged = false;
    report.error = std::current_exception();
  }
  report.iterations = gmres->getNumIters();
  if (report.iterations > basis) has_large_basis_ = true;
  return report;
}

std::vector<Diagnostic> gmres_parameter_errors(const LinearSolverOptions& options) {
  const Place& place = options.belos.place;
  try {
    const RCP<Teuchos::ParameterList> list = belos_parameters(options, options.tolerance, small_basis);
    SolverFactory factory;
    const auto valid = factory.create("GMRES", Teuchos::null)->getValidParameters();
    std::vector<Diagnostic> unknown =
        unknown_parameters(options.belos.value, *valid, place, "Belos' GMRES", "the documentation of Belos::BlockGmresSolMgr (trilinos.github.io)");
    if (unknown.empty()) list->validateParameters(*valid);
    return unknown;
  } catch (const std::exception& error) {
    return {{place, in_one_line(error.what())}};
  }
}

}  // namespace mortise::detail
