#include "mortise/nonlinear/newton_solver.hpp"

#include <NOX_Solver_Factory.H>
#include <NOX_Solver_Generic.H>
#include <NOX_StatusTest_Combo.H>
#include <fmt/format.h>

#include <Teuchos_oblackholestream.hpp>
#include <Tpetra_Vector.hpp>

#include "newton/backtracking.hpp"
#include "newton/newton_status_tests.hpp"
#include "newton/semi_smooth_newton_group.hpp"

namespace mortise {

void NewtonOptions::describe(Parameters& parameters) {
  parameters.add(
      "maximum iterations", maximum_iterations,
      Says("Newton iterations without progress after which the step is undone; one that leads to new states of contact and to the smallest "
           "residual so far is progress")
          .at_least(1));
  parameters.add("momentum tolerance", momentum_tolerance,
                 Says("bound on |r| of the free dofs over the largest of |f_int|, |f_ext| and |f_c|, reactions included; round-off is 1e-15 at best")
                     .unit("-")
                     .at_least(1e-15));
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
  parameters.add("line search", line_search, {{"none", LineSearch::none}, {"backtrack", LineSearch::backtrack}},
                 "backtrack: a step that does not make the residual fall is halved until it does; none: full Newton steps");
  parameters.add(
      "fields", fields, {{"monolithic", FieldSolution::monolithic}, {"staggered", FieldSolution::staggered}},
      "of several fields. monolithic: displacements and temperatures at once. staggered: displacements at fixed temperatures, temperatures "
      "at fixed displacements, in turn until both are in balance: smaller systems, more iterations");
  parameters.add("most turns", most_turns, Says("turns of a staggered step after which it is undone").at_least(1));
  parameters.add(
      "largest increment", largest_increment,
      Says("a correction that moves a node by more is shortened as a whole; default: corrections are taken as they are").unit("length").above(0.0));
}

namespace {

// Eisenstat and Walker's second choice (SIAM J. Sci. Comput. 17, 1996): relative residuals that fall with the square of Newton's, so that it
// stays quadratic.
void set_forcing_term(const LinearSolver::Tolerances& tolerances, Teuchos::ParameterList& newton) {
  newton.set("Forcing Term Method", "Type 2");
  newton.set("Forcing Term Alpha", 2.0);
  newton.set("Forcing Term Initial Tolerance", tolerances.largest);
  newton.set("Forcing Term Minimum Tolerance", tolerances.least);
  newton.set("Forcing Term Maximum Tolerance", tolerances.largest);
}

}  // namespace

SystemEvaluation solve_newton(const SemiSmoothSystem& system, SystemEvaluation start, const NewtonOptions& options, NewtonReport& report,
                              const std::function<void(const NewtonIteration&)>& observer, std::optional<LinearisedIterate>* linearised) {
  using NOX::StatusTest::Combo;
  detail::NewtonHistory history(report);
  const bool backtrack = options.line_search == LineSearch::backtrack;
  const detail::StepControl control{options.largest_increment, backtrack, options.momentum_tolerance,
                                    options.increment_tolerance * system.parts().length};
  const auto group = rcp(new detail::SemiSmoothNewtonGroup(system, std::move(start), control));
  const auto keep_linearised = [&] {
    if (linearised != nullptr && group->linearised()) *linearised = group->linearised();
  };

  const auto criteria = detail::convergence_criteria(options, system.parts().length);
  const auto converged = rcp(new Combo(Combo::AND));
  for (const auto& criterion : criteria) converged->addStatusTest(rcp(new detail::ConvergenceTest(history, criterion)));
  const auto give_up = rcp(new detail::GiveUpTest(history, system, options, criteria));
  const auto test = rcp(new Combo(Combo::OR));
  test->addStatusTest(converged);
  test->addStatusTest(give_up);

  const auto list = rcp(new Teuchos::ParameterList);
  list->set("Nonlinear Solver", "Line Search Based");
  list->sublist("Line Search").set("Method", backtrack ? "User Defined" : "Full Step");
  if (backtrack) {
    const RCP<NOX::LineSearch::UserDefinedFactory> factory = rcp(new detail::BacktrackingFactory(options, system.parts().length));
    list->sublist("Line Search").set("User Defined Line Search Factory", factory);
  }
  list->sublist("Direction").set("Method", "Newton");
  if (const auto tolerances = system.parts().linear_solver->tolerances()) set_forcing_term(*tolerances, list->sublist("Direction").sublist("Newton"));
  list->sublist("Printing").set("Output Information", 0);
  const RCP<std::ostream> nowhere = rcp(new Teuchos::oblackholestream);  // what fails is thrown
  list->sublist("Printing").set("Output Stream", nowhere);
  list->sublist("Printing").set("Error Stream", nowhere);
  list->sublist("Printing").set("MyPID", system.map()->getComm()->getRank());

  // NOX looks at the starting point only within its first step; here it is an iterate like the others, so it is evaluated and tested first.
  group->computeF();
  const auto solver = NOX::Solver::buildSolver(group, test, list);
  std::size_t observed = 0;
  const auto observe = [&] {  // a step that fails leads to no new iterate
    if (observer && report.iterations.size() > observed) observer(report.iterations.back());
    observed = report.iterations.size();
  };
  NOX::StatusTest::StatusType status = test->checkStatus(*solver, NOX::StatusTest::Minimal);
  observe();
  try {
    while (status == NOX::StatusTest::Unconverged) {
      status = solver->step();
      observe();
    }
  } catch (const StepFailure&) {  // on every rank
    keep_linearised();
    throw;
  }
  keep_linearised();
  if (status != NOX::StatusTest::Converged) {
    if (give_up->reason()) throw *give_up->reason();
    throw StepFailure(FailureKind::line_search,
                      fmt::format("no step of {:g} or more along the Newton direction makes the residual fall in Newton iteration {}",
                                  detail::smallest_step_length, report.newton_steps() + 1));
  }
  return group->evaluation();
}

}  // namespace mortise
