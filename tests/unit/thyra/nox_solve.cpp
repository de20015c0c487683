#include "nox_solve.hpp"

#include <NOX_Solver_Generic.H>

#include <NOX_Observer.hpp>
#include <Thyra_NonlinearSolver_NOX.hpp>

namespace mortise::test {

std::optional<int> solve_by_nox(const RCP<ModelWithContact>& model, ThyraVector& x, const RCP<NOX::Observer>& observer) {
  ::Thyra::NOXNonlinearSolver nox;
  const auto list = Teuchos::parameterList();
  list->set("Nonlinear Solver", "Line Search Based");
  list->sublist("Line Search").set("Method", "Backtrack");
  list->sublist("Direction").set("Method", "Newton");
  list->sublist("Direction").sublist("Newton").sublist("Linear Solver").set("Tolerance", 1e-12);
  list->sublist("Printing").set("Output Information", 0);
  auto& tests = list->sublist("Status Tests");
  tests.set("Test Type", "Combo").set("Combo Type", "OR").set("Number of Tests", 3);
  tests.sublist("Test 0").set("Test Type", "NormF").set("Tolerance", 1e-11).set("Scale Type", "Unscaled");
  tests.sublist("Test 1").set("Test Type", "MaxIters").set("Maximum Iterations", 30);
  tests.sublist("Test 2").set("Test Type", "FiniteValue");
  if (!observer.is_null()) list->sublist("Solver Options").set("User Defined Pre/Post Operator", observer);
  nox.setParameterList(list);
  nox.setModel(model);
  nox.setBasePoint(model->getNominalValues());
  const auto status = nox.solve(&x, nullptr, nullptr);
  if (status.solveStatus != ::Thyra::SOLVE_STATUS_CONVERGED) return std::nullopt;
  return nox.getNOXSolver()->getNumIterations();
}

}  // namespace mortise::test
