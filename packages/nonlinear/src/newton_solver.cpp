#include "mortise/nonlinear/newton_solver.hpp"

#include <NOX_Solver_Factory.H>
#include <NOX_Solver_Generic.H>
#include <NOX_StatusTest_Combo.H>

#include <Tpetra_Vector.hpp>

#include "newton_status_tests.hpp"
#include "semi_smooth_newton_group.hpp"

namespace mortise {

void NewtonOptions::describe(Parameters& parameters) {
  parameters.add("maximum iterations", maximum_iterations, Says("Newton iterations after which the step is undone").at_least(1));
  parameters.add("momentum tolerance", momentum_tolerance,
                 Says("bound on |r| of the free dofs over the largest of |f_int|, |f_ext| and |f_c|, reactions included").unit("-").above(0.0));
  parameters.add("gap tolerance", gap_tolerance,
                 Says("bound on the gap of closed nodes over the length of the shortest slave facet").unit("-").above(0.0));
  parameters.add("complementarity tolerance", complementarity_tolerance,
                 Says("bound on the residual of the contact conditions over the largest contact traction").unit("-").above(0.0));
  parameters.add("increment tolerance", increment_tolerance,
                 Says("bound on the last correction of a displacement over the size of the model").unit("-").above(0.0));
  parameters.add("divergence", divergence,
                 Says("growth of |r| over its first values (or the force of the first correction) at which the step is undone").unit("-").above(1.0));
  parameters.add("cycle length", cycle_length,
                 Says("longest cycle of active sets that is looked for; a step that cycles is undone; 0 or 1: none").at_least(0));
}

void solve_newton(SemiSmoothSystem& system, double time, const NewtonOptions& options, Vector& x, NewtonReport& report,
                  const std::function<void(const NewtonIteration&)>& observer) {
  using NOX::StatusTest::Combo;
  system.set_time(time);
  detail::NewtonHistory history(report);
  const auto group = rcp(new detail::SemiSmoothNewtonGroup(system, detail::nox_vector(rcp(&x, false))));

  const auto criteria = detail::convergence_criteria(options, system.parts().length);
  const auto converged = rcp(new Combo(Combo::AND));
  for (const auto& criterion : criteria) converged->addStatusTest(rcp(new detail::ConvergenceTest(history, criterion)));
  const auto give_up = rcp(new detail::GiveUpTest(history, system, options, criteria));
  const auto test = rcp(new Combo(Combo::OR));
  test->addStatusTest(converged);
  test->addStatusTest(give_up);

  const auto list = rcp(new Teuchos::ParameterList);
  list->set("Nonlinear Solver", "Line Search Based");
  list->sublist("Line Search").set("Method", "Full Step");
  list->sublist("Direction").set("Method", "Newton");
  list->sublist("Printing").set("Output Information", 0);
  list->sublist("Printing").set("MyPID", system.map()->getComm()->getRank());

  // NOX looks at the starting point only within its first step; here it is an iterate like the others, so it is evaluated and tested first.
  group->computeF();
  const auto solver = NOX::Solver::buildSolver(group, test, list);
  const auto observe = [&] {
    if (observer) observer(report.iterations.back());
  };
  NOX::StatusTest::StatusType status = test->checkStatus(*solver, NOX::StatusTest::Minimal);
  observe();
  while (status == NOX::StatusTest::Unconverged) {
    status = solver->step();
    observe();
  }
  if (status != NOX::StatusTest::Converged) {
    if (give_up->reason()) throw *give_up->reason();
    throw StepFailure(FailureKind::diverged, "NOX gave up");
  }
  Tpetra::deep_copy(x, *detail::tpetra_vector(solver->getSolutionGroup().getX()));
}

}  // namespace mortise
