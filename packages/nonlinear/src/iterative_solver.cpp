#include "iterative_solver.hpp"

#include <fmt/format.h>

#include <BelosConfigDefs.hpp>
#include <BelosLinearProblem.hpp>
#include <BelosSolverFactory_Tpetra.hpp>
#include <BelosTpetraAdapter.hpp>
#include <MueLu_CreateTpetraPreconditioner.hpp>
#include <MueLu_ParameterListInterpreter.hpp>
#include <MueLu_TpetraOperator.hpp>
#include <algorithm>
#include <cmath>

#include "decoupled_multigrid.hpp"
#include "linear_system_checks.hpp"

namespace mortise::detail {
namespace {

using LinearProblem = Belos::LinearProblem<Scalar, MultiVector, Operator>;

// Smoothed aggregation. Aggregates do not cross where the coordinates say that two bodies are far apart ("cut"), whatever contact couples;
// the matrix that smooths the prolongator is the whole one all the same.
Teuchos::ParameterList muelu_defaults(int equations, GlobalOrdinal rows, int ranks) {
  Teuchos::ParameterList list("MueLu");
  list.set("verbosity", "none");
  list.set("problem: type", "unknown");
  list.set("number of equations", equations);
  list.set("max levels", 8);
  list.set("multigrid algorithm", "sa");
  list.set("sa: use filtered matrix", false);
  list.set("rap: fix zero diagonals", true);  // of coarse dofs beyond those of an aggregate of a single node
  list.set("aggregation: drop scheme", "distance laplacian");
  list.set("aggregation: drop tol", 1e-8);
  list.set("smoother: type", "RELAXATION");
  list.sublist("smoother: params").set("relaxation: type", "Symmetric Gauss-Seidel");
  list.sublist("smoother: params").set("relaxation: sweeps", 1);
  // The coarse solver is KLU2, which is right on one rank only: all coarse levels but very large ones go to one rank, and there is always
  // one.
  list.set("coarse: max size", static_cast<int>(ranks == 1 ? 2000 : std::clamp<GlobalOrdinal>(rows / 5, 1, 2000)));
  if (ranks == 1) {
    list.set("transpose: use implicit", true);  // no restriction is stored beside the prolongator; repartitioning needs it
  } else {
    list.set("repartition: enable", true);
    list.set("repartition: partitioner", "zoltan2");
    list.set("repartition: start level", 1);
    list.set("repartition: min rows per proc", 100000);
  }
  return list;
}

Teuchos::ParameterList belos_defaults(const LinearSolverOptions& options, double tolerance, int basis) {
  Teuchos::ParameterList list("Belos");
  list.set("Convergence Tolerance", tolerance);
  list.set("Maximum Iterations", options.maximum_iterations);
  list.set("Num Blocks", std::min(options.maximum_iterations, basis));
  list.set("Verbosity", 0);
  return list;
}

/// Vectors that GMRES keeps, allocated at its start, before it restarts: for the first systems, and from one on that took more.
constexpr int small_basis = 50, large_basis = 200;

/// What stands for 0 in a rigid body mode, as a share of its largest entry.
constexpr double vanishing = 1e-14;

/// Iterations beyond those of a fresh hierarchy after which an earlier one is given up within a solve, and for the next one.
constexpr int most_extra_iterations = 10, fewest_extra_iterations = 3;

class IterativeSolver : public LinearSolver {
 public:
  IterativeSolver(const LinearSolverOptions& options, const Timers& timers, std::string name)
      : options_(options), timers_(timers), name_(std::move(name)) {}

  std::string name() const override { return name_; }
  int symbolic_setups() const override { return setups_; }

  void set_matrix(const RCP<const Matrix>& matrix, bool, const std::function<NearNullSpace()>& near_null_space) override {
    matrix_ = matrix;
    near_null_space_ = near_null_space;
    is_fresh_ = false;
    if (is_worn_ || preconditioner_.is_null() || !preconditioner_->getDomainMap()->isSameAs(*matrix->getDomainMap())) forget();
  }

  std::optional<Tolerances> tolerances() const override {
    return Tolerances{options_.tolerance, std::max(options_.tolerance, options_.largest_tolerance)};
  }

  LinearSolveReport solve(const Vector& b, Vector& x, double tolerance) override {
    tolerance_ = std::max(tolerance, options_.tolerance);
    const double size = check_finite(*matrix_, b, name());
    x.putScalar(0.0);
    if (size == 0.0) return {};
    LinearSolveReport report;
    std::optional<StepFailure> failure;
    try {
      if (preconditioner_.is_null()) set_up();
      report.iterations = iterate(b, x);
      // Once more from anew where an earlier matrix's hierarchy does not do.
      if (!is_fresh_ && !converged_) {
        set_up();
        report.iterations += iterate(b, x);
      }
    } catch (const std::exception& error) {
      forget();
      failure = StepFailure(FailureKind::linear_solver, name() + ": " + error.what());
    }
    throw_if_any(*matrix_->getComm(), failure);

    Vector r(b.getMap());
    report.relative_residual = true_residual(*matrix_, b, x, r) / size;
    if (!(report.relative_residual <= 10.0 * tolerance_))
      throw StepFailure(FailureKind::linear_solver, fmt::format("{}: the true relative residual is {:.1e} after {} iterations (tolerance {:.1e})",
                                                                name(), report.relative_residual, report.iterations, tolerance_));
    return report;
  }

 private:
  void forget() {
    preconditioner_ = Teuchos::null;
    decoupled_.reset();
    is_worn_ = false;
  }

  void set_up() {
    const auto scope = timers_.scope("linear setup");
    forget();
    const NearNullSpace near_null_space = near_null_space_ ? near_null_space_() : NearNullSpace{};
    auto matrix = Teuchos::rcp_const_cast<Matrix>(matrix_);
    const auto rows = static_cast<GlobalOrdinal>(matrix->getGlobalNumRows());
    int equations = 1;
    if (!near_null_space.coordinates.is_null())
      equations = static_cast<int>(rows / static_cast<GlobalOrdinal>(near_null_space.coordinates->getGlobalLength()));
    if (near_null_space.decoupling) {
      decoupled_ = std::make_shared<DecoupledSystem>(*matrix_, *near_null_space.decoupling, equations);
      matrix = decoupled_->matrix();
    }

    Teuchos::ParameterList list = muelu_defaults(equations, rows, matrix->getComm()->getSize());
    auto& user_data = list.sublist("user data");
    if (near_null_space.coordinates.is_null()) {
      list.set("aggregation: drop scheme", "classical");
      list.set("aggregation: drop tol", 0.0);
      const auto line = rcp(new MultiVector(matrix->getRowMap(), 1));  // the partitioner of coarse levels asks for coordinates
      for (std::size_t row = 0; row < line->getLocalLength(); ++row)
        line->replaceLocalValue(static_cast<LocalOrdinal>(row), 0, static_cast<double>(matrix->getRowMap()->getGlobalElement(row)));
      user_data.set("Coordinates", line);
    } else {
      user_data.set("Coordinates", rcp(new MultiVector(*near_null_space.coordinates, Teuchos::Copy)));
    }
    if (!near_null_space.rigid_body_modes.is_null()) user_data.set("Nullspace", modes_without_fixed_rows(*near_null_space.rigid_body_modes));
    list.setParameters(options_.muelu.value);

    const RCP<Operator> as_operator = matrix;
    preconditioner_ = MueLu::CreateTpetraPreconditioner<Scalar, LocalOrdinal, GlobalOrdinal, NodeType>(as_operator, list);
    ++setups_;
    is_fresh_ = true;
    fresh_iterations_per_digit_ = 0.0;
  }

  // A row that is a multiple of the identity's (Dirichlet) takes no part in a rigid motion. Elsewhere no entry is 0 exactly: MueLu ends, on one rank
  // alone, where a mode vanishes on an aggregate of a single node, as a rotation does on its axis and a translation at a node that slips across it.
  RCP<MultiVector> modes_without_fixed_rows(const MultiVector& rigid_body_modes) const {
    const auto modes = rcp(new MultiVector(rigid_body_modes, Teuchos::Copy));
    if (decoupled_) decoupled_->take_out_eliminated(*modes);
    Teuchos::Array<double> largest(modes->getNumVectors());
    modes->normInf(largest());
    const auto view = modes->getLocalViewHost(Tpetra::Access::ReadWrite);
    const auto local = matrix_->getLocalMatrixHost();
    const auto local_columns = matrix_->getColMap()->getLocalMap();
    const auto local_rows = matrix_->getRowMap()->getLocalMap();
    for (LocalOrdinal row = 0; row < local.numRows(); ++row) {
      const auto entries = local.rowConst(row);
      bool fixed = true;
      for (LocalOrdinal k = 0; k < entries.length && fixed; ++k)
        fixed = entries.value(k) == 0.0 || local_columns.getGlobalElement(entries.colidx(k)) == local_rows.getGlobalElement(row);
      for (std::size_t mode = 0; mode < view.extent(1); ++mode)
        if (fixed || view(row, mode) == 0.0) view(row, mode) = fixed ? 0.0 : vanishing * largest[mode];
    }
    return modes;
  }

  // A hierarchy serves the matrices that follow, those of the next Newton steps, until they take half as many iterations for a digit again as the one
  // that it was made for.
  int iterate(const Vector& b, Vector& x) {
    const auto scope = timers_.scope("linear solve");
    x.putScalar(0.0);
    RCP<const Operator> preconditioner = preconditioner_;
    if (decoupled_) preconditioner = rcp(new DecoupledPreconditioner(*matrix_, decoupled_, preconditioner_));
    const auto problem = rcp(new LinearProblem(matrix_, rcp(&x, false), rcp(&b, false)));
    problem->setRightPrec(preconditioner);
    if (!problem->setProblem()) throw std::runtime_error("Belos refuses the linear problem");
    const auto list = rcp(new Teuchos::ParameterList(belos_defaults(options_, tolerance_, basis_)));
    list->setParameters(options_.belos.value);
    const double digits = -std::log10(tolerance_), expected = digits * fresh_iterations_per_digit_;
    if (!is_fresh_)
      list->set("Maximum Iterations", std::min(list->get<int>("Maximum Iterations"), static_cast<int>(2.0 * expected) + most_extra_iterations));
    Belos::TpetraSolverFactory<Scalar, MultiVector, Operator> factory;
    const auto gmres = factory.create("GMRES", list);
    gmres->setProblem(problem);
    converged_ = gmres->solve() == Belos::Converged;
    const int iterations = gmres->getNumIters();
    if (iterations > basis_) basis_ = large_basis;
    if (is_fresh_) fresh_iterations_per_digit_ = std::max(fresh_iterations_per_digit_, iterations / digits);
    is_worn_ = iterations > 1.5 * digits * fresh_iterations_per_digit_ + fewest_extra_iterations;
    return iterations;
  }

  LinearSolverOptions options_;
  double tolerance_ = 0.0;  ///< of this solve
  Timers timers_;
  std::string name_;
  RCP<const Matrix> matrix_;
  std::function<NearNullSpace()> near_null_space_;
  RCP<const Operator> preconditioner_;
  std::shared_ptr<const DecoupledSystem> decoupled_;  ///< null: the matrix is taken as it is
  int setups_ = 0, basis_ = small_basis;
  bool is_fresh_ = false, is_worn_ = false, converged_ = false;  ///< the hierarchy: made for this matrix, not to be kept for the next; the last solve
  double fresh_iterations_per_digit_ = 0.0;                      ///< of the residual, with the matrix that the hierarchy was made for
};

// Both packages check names and types; asked here, with no matrix at hand, so that a misspelt name is found before the mesh is made.
void check_lists(const LinearSolverOptions& options, const RCP<const Communicator>& comm) {
  std::vector<Diagnostic> found;
  try {
    Teuchos::ParameterList list = muelu_defaults(2, 1000, comm->getSize());
    list.setParameters(options.muelu.value);
    MueLu::ParameterListInterpreter<Scalar, LocalOrdinal, GlobalOrdinal, NodeType>(list, comm);
  } catch (const std::exception& error) {
    found.push_back({options.muelu.place, error.what()});
  }
  try {
    const auto list = rcp(new Teuchos::ParameterList(belos_defaults(options, options.tolerance, small_basis)));
    list->setParameters(options.belos.value);
    Belos::TpetraSolverFactory<Scalar, MultiVector, Operator> factory;
    const auto gmres = factory.create("GMRES", Teuchos::null);
    list->validateParameters(*gmres->getValidParameters());
  } catch (const std::exception& error) {
    found.push_back({options.belos.place, error.what()});
  }
  if (!found.empty()) throw InputError(std::move(found));
}

}  // namespace

std::unique_ptr<LinearSolver> make_iterative_solver(const LinearSolverOptions& options, const RCP<const Communicator>& comm, const Timers& timers,
                                                    const std::string& chosen) {
  check_lists(options, comm);
  return std::make_unique<IterativeSolver>(options, timers, chosen + "GMRES + MueLu smoothed aggregation");
}

}  // namespace mortise::detail
