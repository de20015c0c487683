// Two boxes pressed onto one another and drawn along, by Piro. The line that gives the model contact is marked.
//   embed_host steps FILE [FORMULATION [OFFSET]]
//                              equal steps; writes positions, displacements and multipliers of this rank's nodes to FILE.<rank>. FORMULATION is dual,
//                              penalty or augmented; the upper box reaches over the lower one by OFFSET, 0.28 if it is not given
//   embed_host rejects         steps of time, some of which fail and are taken again; compares with the steps that were accepted alone
//   embed_host cost N...       the cost of W with contact, over that of W without it, at N cells along an edge

// Optimisation is not needed, and the headers of ROL are a package of their own.
#include <Piro_config.hpp>
#undef HAVE_PIRO_ROL
#include <Piro_NOXSolver.hpp>
#include <Piro_NOXSolver_Def.hpp>  // Debian's library has no instance of it

// The rest in any order.
#include <Ifpack2_AdditiveSchwarz.hpp>
#include <Stratimikos_DefaultLinearSolverBuilder.hpp>
#include <Teuchos_AbstractFactoryStd.hpp>
#include <Teuchos_CommHelpers.hpp>
#include <Teuchos_XMLParameterListHelpers.hpp>
#include <Thyra_Ifpack2PreconditionerFactory.hpp>
#include <Thyra_TpetraThyraWrappers.hpp>
#include <Thyra_VectorStdOps.hpp>
#include <Tpetra_Core.hpp>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <functional>
#include <iomanip>
#include <string>

#include "Elasticity.hpp"
#include "mortise/contact/contact_report.hpp"
#include "mortise/contact/formulation/augmented_lagrange.hpp"
#include "mortise/contact/formulation/dual_mortar.hpp"
#include "mortise/contact/formulation/penalty.hpp"
#include "mortise/thyra/piro_observer.hpp"

namespace {

using Teuchos::RCP;
using Convert = Thyra::TpetraOperatorVectorExtraction<double, embed::LO, embed::GO, embed::Node>;

RCP<const Thyra::LinearOpWithSolveFactoryBase<double>> linearSolver() {
  Stratimikos::DefaultLinearSolverBuilder builder;
  builder.setPreconditioningStrategyFactory(
      Teuchos::abstractFactoryStd<Thyra::PreconditionerFactoryBase<double>, Thyra::Ifpack2PreconditionerFactory<embed::Matrix>>(), "Ifpack2");
  const auto list = Teuchos::getParametersFromXmlString(R"(
    <ParameterList>
      <Parameter name="Linear Solver Type" type="string" value="Belos"/>
      <Parameter name="Preconditioner Type" type="string" value="Ifpack2"/>
      <ParameterList name="Linear Solver Types">
        <ParameterList name="Belos">
          <Parameter name="Solver Type" type="string" value="Block GMRES"/>
          <ParameterList name="Solver Types">
            <ParameterList name="Block GMRES">
              <Parameter name="Convergence Tolerance" type="double" value="1e-13"/>
              <Parameter name="Maximum Iterations" type="int" value="600"/>
              <Parameter name="Num Blocks" type="int" value="600"/>
              <Parameter name="Verbosity" type="int" value="0"/>
            </ParameterList>
          </ParameterList>
        </ParameterList>
      </ParameterList>
      <ParameterList name="Preconditioner Types">
        <ParameterList name="Ifpack2">
          <Parameter name="Prec Type" type="string" value="ILUT"/>
          <Parameter name="Overlap" type="int" value="1"/>
          <ParameterList name="Ifpack2 Settings">
            <Parameter name="fact: ilut level-of-fill" type="double" value="4.0"/>
          </ParameterList>
        </ParameterList>
      </ParameterList>
    </ParameterList>)");
  builder.setParameterList(list);
  return builder.createLinearSolveStrategy("");
}

RCP<Teuchos::ParameterList> piroParameters(int maxIterations) {
  const auto list = Teuchos::getParametersFromXmlString(R"(
    <ParameterList>
      <ParameterList name="NOX">
        <Parameter name="Nonlinear Solver" type="string" value="Line Search Based"/>
        <ParameterList name="Line Search"><Parameter name="Method" type="string" value="Backtrack"/></ParameterList>
        <ParameterList name="Direction">
          <Parameter name="Method" type="string" value="Newton"/>
          <ParameterList name="Newton">
            <ParameterList name="Linear Solver"><Parameter name="Tolerance" type="double" value="1e-13"/></ParameterList>
          </ParameterList>
        </ParameterList>
        <ParameterList name="Printing"><Parameter name="Output Information" type="int" value="0"/></ParameterList>
        <ParameterList name="Status Tests">
          <Parameter name="Test Type" type="string" value="Combo"/>
          <Parameter name="Combo Type" type="string" value="OR"/>
          <Parameter name="Number of Tests" type="int" value="3"/>
          <ParameterList name="Test 0">
            <Parameter name="Test Type" type="string" value="NormF"/>
            <Parameter name="Scale Type" type="string" value="Unscaled"/>
            <Parameter name="Tolerance" type="double" value="1e-11"/>
          </ParameterList>
          <ParameterList name="Test 1"><Parameter name="Test Type" type="string" value="MaxIters"/></ParameterList>
          <ParameterList name="Test 2"><Parameter name="Test Type" type="string" value="FiniteValue"/></ParameterList>
        </ParameterList>
      </ParameterList>
    </ParameterList>)");
  list->sublist("NOX").sublist("Status Tests").sublist("Test 1").set("Maximum Iterations", maxIterations);
  return list;
}

// What contact is told of the mesh.
mortise::HostDisplacements displacements(const embed::Elasticity& elasticity) {
  const embed::Mesh& mesh = elasticity.mesh();
  std::vector<embed::GO> nodes, ids;
  for (long node = 0; node < static_cast<long>(mesh.points.size()); ++node) {
    if (!elasticity.mine(node)) continue;
    nodes.push_back(node);
    for (int i = 0; i < 3; ++i) ids.push_back(elasticity.row(node, embed::Elasticity::slot[i]));
  }
  const RCP<const embed::Map> map =
      Teuchos::rcp(new embed::Map(mesh.points.size(), nodes.data(), static_cast<embed::LO>(nodes.size()), 0, elasticity.rows()->getComm()));
  const auto reference = Teuchos::rcp(new mortise::MultiVector(map, 3)), fixed = Teuchos::rcp(new mortise::MultiVector(map, 3));
  for (const embed::GO node : nodes)
    for (int i = 0; i < 3; ++i) {
      reference->replaceGlobalValue(node, i, mesh.points[node][i]);
      fixed->replaceGlobalValue(node, i, mesh.isClamped(node) || mesh.isDriven(node) ? 1.0 : 0.0);
    }
  return {mortise::NodalField("displacement", map, 3, ids), reference, fixed, {}, {}};
}

mortise::Choice<mortise::Formulation> formulation(const std::string& name) {
  if (name == "penalty") return {name, std::make_shared<mortise::Penalty>(), {}};
  if (name == "augmented") return {name, std::make_shared<mortise::AugmentedLagrange>(), {}};
  if (name == "dual") return {name, std::make_shared<mortise::DualMortar>(), {}};
  throw std::invalid_argument("there is no formulation " + name);
}

std::vector<mortise::ContactPair> pairs(const embed::Elasticity& elasticity, const std::string& name) {
  mortise::ContactPair pair;
  pair.name = "joint";
  pair.youngs_modulus = 1000.0;
  pair.options.formulation = formulation(name);
  const auto coulomb = std::make_shared<mortise::CoulombFriction>();
  coulomb->coefficient = mortise::ScalarFunction(0.3);
  pair.options.friction = {"coulomb", coulomb, {}};
  for (const auto& quad : elasticity.mesh().upper_bottom.quads)
    for (const long node : quad)
      if (elasticity.mine(node)) {
        pair.slave.emplace_back(quad.begin(), quad.end());
        break;
      }
  for (const auto& quad : elasticity.mesh().lower_top.quads)
    if (elasticity.mine(quad[0])) pair.master.emplace_back(quad.begin(), quad.end());
  return {pair};
}

// Remembers what Piro says is a solution.
struct Solution : Piro::ObserverBase<double> {
  using Piro::ObserverBase<double>::observeSolution;
  void observeSolution(const Thyra::VectorBase<double>& solution) override { x = solution.clone_v(); }
  RCP<Thyra::VectorBase<double>> x;
};

struct Application {
  Application(int nLower, int nUpper, int maxIterations, const std::string& name = "dual", double offset = 0.28) {
    const auto mesh = std::make_shared<embed::Mesh>(nLower, nUpper, offset);
    elasticity = Teuchos::rcp(new embed::Elasticity(mesh, Tpetra::getDefaultComm(), linearSolver()));
    RCP<Thyra::ModelEvaluator<double>> model = elasticity;
    model = contact = mortise::with_contact(model, displacements(*elasticity), pairs(*elasticity, name));  // the line
    // Multipliers of augmented Lagrange are updated until they are exact, before a step is accepted.
    const RCP<Piro::ObserverBase<double>> accepts = Teuchos::rcp(new mortise::PiroObserver(contact, solution));
    const RCP<Piro::ObserverBase<double>> observer = name == "augmented" ? RCP<Piro::ObserverBase<double>>(solution) : accepts;
    updates = name == "augmented";
    solver = Teuchos::rcp(new Piro::NOXSolver<double>(piroParameters(maxIterations), model, observer));
  }

  // Pressed until t = 1, drawn until t = 2.
  bool solve(double t) {
    elasticity->setMotion(0.005 * std::min(1.0, t), 0.02 * std::max(0.0, t - 1.0));
    if (!solveOnce()) return false;
    while (updates && contact->update_multipliers(*solution->x))
      if (!solveOnce()) return false;
    if (updates) contact->accept_step(*solution->x);
    return true;
  }
  bool solveOnce() {
    solution->x = Teuchos::null;
    auto out = solver->createOutArgs();
    const auto x = Thyra::createMember(*elasticity->get_x_space());
    out.set_g(out.Ng() - 1, x);
    solver->evalModel(solver->createInArgs(), out);
    if (solution->x.is_null()) return false;
    elasticity->setInitialGuess(*solution->x);
    iterations += solver->getSolver()->getNOXSolver()->getNumIterations();
    return true;
  }
  RCP<const embed::Vector> x() const { return Convert::getConstTpetraVector(elasticity->getNominalValues().get_x()); }

  RCP<embed::Elasticity> elasticity;
  RCP<mortise::ModelWithContact> contact;
  RCP<Solution> solution = Teuchos::rcp(new Solution);
  RCP<Piro::NOXSolver<double>> solver;
  int iterations = 0;
  bool updates = false;
};

int runSteps(const std::string& file, const std::string& name, double offset) {
  Application app(4, 3, 20, name, offset);
  for (int step = 1; step <= 8; ++step)
    if (!app.solve(0.25 * step)) {
      std::fprintf(stderr, "step %d does not converge: %s\n", step, app.contact->failure() ? app.contact->failure()->what() : "");
      return 1;
    }
  std::ofstream out(file + "." + std::to_string(Tpetra::getDefaultComm()->getRank()));
  out << std::setprecision(17);
  const auto x = app.x()->getData();
  const auto& mesh = app.elasticity->mesh();
  std::vector<std::array<double, 3>> tractions(mesh.points.size());
  for (const auto& node : mortise::node_states(*app.contact->accepted_laws(), 0)) tractions[node.node] = node.traction;
  for (long node = 0; node < static_cast<long>(mesh.points.size()); ++node) {
    if (!app.elasticity->mine(node)) continue;
    for (const double place : mesh.points[node]) out << place << ' ';
    for (const int slot : embed::Elasticity::slot) out << x[app.elasticity->rows()->getLocalElement(app.elasticity->row(node, slot))] << ' ';
    for (const double z : tractions[node]) out << z << ' ';
    out << '\n';
  }
  if (Tpetra::getDefaultComm()->getRank() == 0) std::printf("%d iterations\n", app.iterations);
  return 0;
}

int runRejects() {
  Application app(4, 3, 4);
  std::vector<double> accepted;
  int failed = 0;
  double t = 0.0, dt = 2.0;
  while (t < 2.0) {
    if (app.solve(std::min(2.0, t + dt))) {
      t = std::min(2.0, t + dt);
      accepted.push_back(t);
      dt *= 2.0;
    } else {
      ++failed;
      dt /= 2.0;
      if (dt < 1e-3) return 1;
    }
  }
  Application again(4, 3, 4);
  for (const double time : accepted)
    if (!again.solve(time)) return 1;
  embed::Vector difference(*app.x(), Teuchos::Copy);
  difference.update(-1.0, *again.x(), 1.0);
  const double apart = difference.normInf();
  if (Tpetra::getDefaultComm()->getRank() == 0) std::printf("%zu steps, %d failed, %g apart\n", accepted.size(), failed, apart);
  return failed > 0 && apart == 0.0 ? 0 : 1;
}

double seconds(const std::function<void()>& work) {
  const std::clock_t start = std::clock();
  work();
  return double(std::clock() - start) / CLOCKS_PER_SEC;
}

int runCost(int n) {
  Application app(n, n - 1, 20);
  app.elasticity->setMotion(0.0005, 0.0);
  const auto evaluate = [](const Thyra::ModelEvaluator<double>& model, const RCP<Thyra::VectorBase<double>>& f,
                           const RCP<Thyra::LinearOpBase<double>>& W) {
    auto out = model.createOutArgs();
    out.set_f(f);
    out.set_W_op(W);
    model.evalModel(model.getNominalValues(), out);
  };
  // Pressed as a whole by a thousandth of a facet: all of the slave that faces the master is closed.
  const auto start = Thyra::createMember(*app.elasticity->get_x_space());
  const auto values = Convert::getTpetraVector(start);
  values->putScalar(0.0);
  const auto& mesh = app.elasticity->mesh();
  for (long node = mesh.first_upper; node < static_cast<long>(mesh.points.size()); ++node)
    if (app.elasticity->mine(node)) values->replaceGlobalValue(app.elasticity->row(node, 3), -1e-3 / n);
  app.elasticity->setInitialGuess(*start);
  app.contact->start_step(*start);
  const auto f = Thyra::createMember(*app.elasticity->get_f_space());
  const auto own = app.elasticity->create_W_op(), W = app.contact->create_W_op();
  std::array<double, 4> times{};
  for (int round = 0; round < 3; ++round) {  // the last one: all graphs are there
    times[0] = seconds([&] { evaluate(*app.elasticity, Teuchos::null, own); });
    times[1] = seconds([&] { evaluate(*app.elasticity, f, Teuchos::null); });
    app.contact->start_step(*start);
    times[2] = seconds([&] { evaluate(*app.contact, f, Teuchos::null); });
    times[3] = seconds([&] { evaluate(*app.contact, Teuchos::null, W); });
  }
  if (Tpetra::getDefaultComm()->getRank() == 0)
    std::printf("%zu dofs: W %.3f s, f %.3f s; with contact f %.3f s, then W %.3f s: %.2f of W and f alone\n", 4 * mesh.points.size(), times[0],
                times[1], times[2], times[3], (times[2] + times[3]) / (times[0] + times[1]));
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  Tpetra::ScopeGuard scope(&argc, &argv);
  const std::string mode = argc > 1 ? argv[1] : "";
  try {
    if (mode == "steps" && argc >= 3) return runSteps(argv[2], argc > 3 ? argv[3] : "dual", argc > 4 ? std::stod(argv[4]) : 0.28);
    if (mode == "rejects") return runRejects();
    int result = mode == "cost" ? 0 : 2;
    for (int i = 2; mode == "cost" && i < argc; ++i) result |= runCost(std::stoi(argv[i]));
    return result;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
