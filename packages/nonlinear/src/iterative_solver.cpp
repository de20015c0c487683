#include "iterative_solver.hpp"

#include <fmt/format.h>

#include <BelosConfigDefs.hpp>
#include <BelosLinearProblem.hpp>
#include <BelosSolverFactory_Tpetra.hpp>
#include <BelosTpetraAdapter.hpp>
#include <MueLu_CreateTpetraPreconditioner.hpp>
#include <MueLu_MasterList.hpp>
#include <MueLu_ParameterListInterpreter.hpp>
#include <MueLu_TpetraOperator.hpp>
#include <algorithm>
#include <cmath>

#include "decoupled_multigrid.hpp"
#include "interface_correction.hpp"
#include "linear_system_checks.hpp"
#include "reuse_policy.hpp"
#include "solver_parameters.hpp"
#include "sparse_parts.hpp"

namespace mortise::detail {
namespace {

using LinearProblem = Belos::LinearProblem<Scalar, MultiVector, Operator>;

/// At most.
constexpr int levels = 8;

std::string name_of_level(int level) { return fmt::format("level {}", level); }

/// Rows of the coarsest level, at most: KLU2 takes seconds for a few thousand in 3D.
constexpr int rows_of_coarsest = 1000;

/// Rows of any coarse level on each of several ranks, at least.
constexpr int rows_on_one_rank = 5000;

/// What smooths within a cycle. With Chebyshev polynomials an iteration takes half of the time that it takes with Gauss-Seidel sweeps, which a
/// processor cannot stream, but they want eigenvalues that are nearly real.
enum class Smoother { chebyshev, gauss_seidel };

/// Iterations after which another smoother is tried, with a hierarchy for the matrix at hand.
constexpr int most_with_chebyshev = 100;

// Coarse levels are small but hard. With Chebyshev polynomials they are passed twice. Their aggregates follow the order of the graph and are half as
// large as in that of the rows: level k holds the aggregates of level k - 1. Where aggregates are cut at the border of ranks, twice the degree pays.
void set_smoother(Teuchos::ParameterList& list, Smoother smoother, int ranks) {
  if (smoother == Smoother::chebyshev) {
    const auto set_polynomial = [](Teuchos::ParameterList& of_level, int degree) {
      of_level.set("smoother: type", "CHEBYSHEV");
      of_level.sublist("smoother: params").set("chebyshev: degree", degree);
      of_level.sublist("smoother: params").set("chebyshev: ratio eigenvalue", 8.0);
    };
    set_polynomial(list, 2);
    for (int level = 1; level < levels; ++level) set_polynomial(list.sublist(name_of_level(level)), ranks == 1 ? 2 : 4);
    for (int level = 2; level < levels; ++level) list.sublist(name_of_level(level)).set("aggregation: ordering", "graph");
    list.set("cycle type", "W");
    return;
  }
  const auto set_sweeps = [](Teuchos::ParameterList& of_level, int sweeps) {
    of_level.set("smoother: type", "RELAXATION");
    of_level.sublist("smoother: params").set("relaxation: type", "Symmetric Gauss-Seidel");
    of_level.sublist("smoother: params").set("relaxation: sweeps", sweeps);
  };
  set_sweeps(list, 1);
  for (int level = 1; level < levels; ++level) set_sweeps(list.sublist(name_of_level(level)), 2);
}

// Smoothed aggregation. Aggregates do not cross where the coordinates say that two bodies are far apart ("cut"), whatever contact couples. The matrix
// that smooths the prolongator is the whole one all the same. It is scaled with the sums of rows. Scaled with the diagonal, its largest eigenvalue,
// by which the smoothing is damped everywhere, would be that of the few rows in contact. The smoother is scaled likewise, but its eigenvalue is that
// of prescribed rows, so the prolongator's has to be estimated separately.
Teuchos::ParameterList muelu_defaults(int equations, GlobalOrdinal rows, int ranks) {
  Teuchos::ParameterList list("MueLu");
  list.set("verbosity", "none");
  list.set("problem: type", "unknown");
  list.set("number of equations", equations);
  list.set("max levels", levels);
  list.set("multigrid algorithm", "sa");
  list.set("sa: use filtered matrix", false);
  list.set("sa: use rowsumabs diagonal scaling", true);
  list.set("sa: calculate eigenvalue estimate", true);
  list.set("rap: fix zero diagonals", true);  // of coarse dofs beyond those of an aggregate of a single node
  list.set("aggregation: drop scheme", "distance laplacian");
  list.set("aggregation: drop tol", 1e-8);
  // The coarse solver is KLU2, which is right on one rank only: what is small enough for it is moved to one rank, and there is always a coarse level.
  list.set("coarse: max size", ranks == 1 ? rows_of_coarsest : static_cast<int>(std::clamp<GlobalOrdinal>(rows / 5, 1, rows_of_coarsest)));
  if (ranks == 1) {
    list.set("transpose: use implicit", true);  // no restriction is stored beside the prolongator; repartitioning needs it
  } else {
    list.set("repartition: enable", true);
    list.set("repartition: partitioner", "zoltan2");
    list.set("repartition: start level", 1);
    list.set("repartition: min rows per proc", rows_on_one_rank);
  }
  return list;
}

/// Whether a scene says how to smooth, on one level at least. Parameters of a level's smoother alone are those of the default one.
bool gives_smoother(const Teuchos::ParameterList& muelu) {
  return std::any_of(muelu.begin(), muelu.end(), [&](const auto& item) {
    return item.first.rfind("smoother:", 0) == 0 || (item.second.isList() && muelu.sublist(item.first).isParameter("smoother: type"));
  });
}

/// The defaults with what a scene gives. A smoother that it gives, be it of one level, stands in place of the default one and all that goes with it.
Teuchos::ParameterList muelu_list(const LinearSolverOptions& options, Smoother smoother, int equations, GlobalOrdinal rows, int ranks) {
  Teuchos::ParameterList list = muelu_defaults(equations, rows, ranks);
  if (!gives_smoother(options.muelu.value)) set_smoother(list, smoother, ranks);
  list.setParameters(options.muelu.value);
  return list;
}

Teuchos::ParameterList belos_defaults(const LinearSolverOptions& options, double tolerance, int basis) {
  Teuchos::ParameterList list("Belos");
  list.set("Convergence Tolerance", tolerance);
  list.set("Implicit Residual Scaling", "Norm of RHS");
  list.set("Explicit Residual Scaling", "Norm of RHS");
  list.set("Maximum Iterations", options.maximum_iterations);
  list.set("Num Blocks", std::min(options.maximum_iterations, basis));
  list.set("Verbosity", 0);
  return list;
}

/// Vectors that GMRES keeps, allocated at its start, before it restarts: for the first systems, and from one on that took more.
constexpr int small_basis = 50, large_basis = 200;

/// True residuals up to so many times the tolerance do.
constexpr double accepted = 10.0;

/// What stands for 0 in a rigid body mode, as a share of its largest entry.
constexpr double vanishing = 1e-14;

/// Moves the marked nodes, each of as many dofs as it has coordinates, away from all others, so that aggregates are made of them alone.
void move_marked(MultiVector& coordinates, const Vector& marks, double distance) {
  const auto x = coordinates.getLocalViewHost(Tpetra::Access::ReadWrite);
  const auto mark = marks.getLocalViewHost(Tpetra::Access::ReadOnly);
  for (std::size_t node = 0; node < x.extent(0); ++node)
    if (mark(node * x.extent(1), 0) != 0.0) x(node, 1) += distance;
}

class IterativeSolver : public LinearSolver {
 public:
  IterativeSolver(const LinearSolverOptions& options, const Timers& timers, std::string name)
      : options_(options), timers_(timers), name_(std::move(name)) {}

  std::string name() const override { return name_; }
  int symbolic_setups() const override { return setups_; }

  void set_matrix(const RCP<const Matrix>& matrix, bool, const MultigridInput& multigrid) override {
    matrix_ = matrix;
    multigrid_ = multigrid;
    preconditioner_ = start_ = Teuchos::null;
    is_fresh_ = false;
    if (reuse_.is_stale() || cycle_.is_null() || !cycle_->getDomainMap()->isSameAs(*matrix->getDomainMap())) forget();
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
      if (preconditioner_.is_null()) prepare();
      if (!start_.is_null()) {
        const auto scope = timers_.scope("linear solve");
        start_->apply(b, x);
      }
      report.iterations = iterate(b, x);
      // A hierarchy of an earlier matrix that fails is replaced during the solve; a smoother that fails is replaced for good.
      if (!is_fresh_ && !converged_) {
        forget();
        prepare();
        report.iterations += iterate(b, x);
      }
      if (!converged_ && has_other_smoother()) {
        smoother_ = Smoother::gauss_seidel;
        forget();
        prepare();
        x.putScalar(0.0);
        report.iterations += iterate(b, x);
      }
    } catch (const std::exception& error) {
      forget();
      failure = StepFailure(FailureKind::linear_solver, name() + ": " + error.what());
    }
    throw_if_any(*matrix_->getComm(), failure);

    Vector r(b.getMap());
    report.relative_residual = true_residual(*matrix_, b, x, r) / size;
    if (report.relative_residual <= accepted * tolerance_) return report;
    forget();
    throw StepFailure(FailureKind::linear_solver, fmt::format("{}: the true relative residual is {:.1e} after {} iterations (tolerance {:.1e})",
                                                              name(), report.relative_residual, report.iterations, tolerance_));
  }

 private:
  bool has_other_smoother() const { return smoother_ == Smoother::chebyshev && !gives_smoother(options_.muelu.value); }

  void forget() {
    cycle_ = preconditioner_ = start_ = Teuchos::null;
    reuse_ = {};
  }

  // Contact is decoupled and corrected with the matrix and the states of its nodes as they are, whatever matrix the hierarchy was made for.
  void prepare() {
    const auto scope = timers_.scope("linear setup");
    if (!multigrid_.decoupling) {
      if (cycle_.is_null()) set_up(nullptr);
      preconditioner_ = cycle_;
      return;
    }
    const auto decoupled = std::make_shared<const DecoupledSystem>(matrix_, multigrid_.decoupling());
    if (cycle_.is_null()) {
      contact_dofs_ = decoupled->contact_dofs();
      set_up(decoupled.get());
    }
    preconditioner_ = cycle_;
    // With the contact when the hierarchy was made: but for the tangents of the bodies C has not changed elsewhere.
    Vector now_or_then(*decoupled->contact_dofs(), Teuchos::Copy);
    now_or_then.update(1.0, *contact_dofs_, 1.0);
    const RCP<const Map> m = marked_ids(marked_and_neighbours(*matrix_, now_or_then, decoupled->dimension()));
    if (m->getGlobalNumElements() > 0) {
      const auto rows = rcp(new RowsOfDecoupled(decoupled->rows(m)));
      const auto solution = rcp(new InterfaceSolution(rows->block(), matrix_->getRowMap()));
      start_ = rcp(new DecoupledPreconditioner(decoupled, solution));
      preconditioner_ = rcp(new InterfaceCorrection(rows, solution, cycle_));
    }
    preconditioner_ = rcp(new DecoupledPreconditioner(decoupled, preconditioner_));
  }

  void set_up(const DecoupledSystem* decoupled) {
    const NearNullSpace near_null_space = multigrid_.near_null_space ? multigrid_.near_null_space() : NearNullSpace{};
    int equations = 1;
    if (!near_null_space.coordinates.is_null())
      equations = static_cast<int>(matrix_->getGlobalNumRows() / near_null_space.coordinates->getGlobalLength());
    const RCP<Matrix> matrix = decoupled != nullptr ? decoupled->matrix() : Teuchos::rcp_const_cast<Matrix>(matrix_);
    const auto rows = static_cast<GlobalOrdinal>(matrix->getGlobalNumRows());
    Teuchos::ParameterList list = muelu_list(options_, smoother_, equations, rows, matrix->getComm()->getSize());
    auto& user_data = list.sublist("user data");
    if (near_null_space.coordinates.is_null()) {
      list.set("aggregation: drop scheme", "classical");
      list.set("aggregation: drop tol", 0.0);
      const auto line = rcp(new MultiVector(matrix->getRowMap(), 1));  // the partitioner of coarse levels asks for coordinates
      for (std::size_t row = 0; row < line->getLocalLength(); ++row)
        line->replaceLocalValue(static_cast<LocalOrdinal>(row), 0, static_cast<double>(matrix->getRowMap()->getGlobalElement(row)));
      user_data.set("Coordinates", line);
    } else {
      const auto coordinates = rcp(new MultiVector(*near_null_space.coordinates, Teuchos::Copy));
      if (decoupled != nullptr) move_marked(*coordinates, decoupled->master_dofs(), near_null_space.separation);
      user_data.set("Coordinates", coordinates);
    }
    if (!near_null_space.rigid_body_modes.is_null())
      user_data.set("Nullspace", modes_without_fixed_rows(*near_null_space.rigid_body_modes, decoupled));

    const RCP<Operator> as_operator = matrix;
    cycle_ = MueLu::CreateTpetraPreconditioner<Scalar, LocalOrdinal, GlobalOrdinal, NodeType>(as_operator, list);
    ++setups_;
    is_fresh_ = true;
  }

  // A row that is a multiple of the identity's (Dirichlet) takes no part in a rigid motion. Elsewhere no entry is exactly 0. MueLu ends, on one rank
  // alone, where a mode vanishes on an aggregate of a single node. A rotation does so on its axis, a translation at a node that slips across it.
  RCP<MultiVector> modes_without_fixed_rows(const MultiVector& rigid_body_modes, const DecoupledSystem* decoupled) const {
    const auto modes = rcp(new MultiVector(rigid_body_modes, Teuchos::Copy));
    if (decoupled != nullptr) decoupled->take_out_eliminated(*modes);
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

  // A hierarchy serves the matrices that follow, those of the next Newton steps, until it is stale.
  int iterate(const Vector& b, Vector& x) {
    const auto scope = timers_.scope("linear solve");
    Vector r(b.getMap());
    const double digits = std::max(1.0, std::log10(true_residual(*matrix_, b, x, r) / (tolerance_ * b.norm2())));
    const auto problem = rcp(new LinearProblem(matrix_, rcp(&x, false), rcp(&b, false)));
    problem->setRightPrec(preconditioner_);
    if (!problem->setProblem()) throw std::runtime_error("Belos refuses the linear problem");
    const auto list = rcp(new Teuchos::ParameterList(belos_defaults(options_, tolerance_, basis_)));
    list->setParameters(options_.belos.value);
    double most = list->get<int>("Maximum Iterations");
    if (!is_fresh_) most = std::min(most, std::ceil(reuse_.most_iterations(digits)));
    if (has_other_smoother()) most = std::min<double>(most, most_with_chebyshev);
    list->set("Maximum Iterations", static_cast<int>(most));
    Belos::TpetraSolverFactory<Scalar, MultiVector, Operator> factory;
    const auto gmres = factory.create("GMRES", list);
    gmres->setProblem(problem);
    // Near round-off GMRES ends on its own residual, and Belos finds the true one a trifle above the tolerance: no fault of the hierarchy.
    try {
      converged_ = gmres->solve() == Belos::Converged || true_residual(*matrix_, b, x, r) <= accepted * tolerance_ * b.norm2();
    } catch (const std::exception&) {  // overflow
      if (!has_other_smoother()) throw;
      converged_ = false;
    }
    const int iterations = gmres->getNumIters();
    if (iterations > basis_) basis_ = large_basis;
    reuse_.record(iterations, digits);
    return iterations;
  }

  LinearSolverOptions options_;
  double tolerance_ = 0.0;  ///< of this solve
  Timers timers_;
  std::string name_;
  RCP<const Matrix> matrix_;
  MultigridInput multigrid_;
  RCP<const Vector> contact_dofs_;              ///< those when the hierarchy was made
  RCP<const Operator> cycle_, preconditioner_;  ///< of a hierarchy; with contact around it
  RCP<const Operator> start_;                   ///< of the nodes in contact alone: where a solve starts
  int setups_ = 0, basis_ = small_basis;
  Smoother smoother_ = Smoother::chebyshev;
  bool is_fresh_ = false, converged_ = false;  ///< the hierarchy: made for this matrix; the last solve
  ReusePolicy reuse_;                          ///< of the hierarchy
};

// Names and types, with no matrix at hand. Names first: on a wrong one MueLu prints all that it has.
void check_lists(const LinearSolverOptions& options, const RCP<const Communicator>& comm) {
  const auto& muelu = options.muelu;
  std::vector<Diagnostic> found;
  const bool has_factories = muelu.value.isSublist("Hierarchy");  // MueLu's other interface, with names of one's own
  if (!has_factories)
    found =
        unknown_parameters(muelu.value, *MueLu::MasterList::List(), muelu.place, "MueLu", "the MueLu User's Guide (trilinos.github.io)", "level ");
  try {
    Teuchos::ParameterList list = muelu_list(options, Smoother::chebyshev, 2, 1000, comm->getSize());
    if (found.empty()) MueLu::ParameterListInterpreter<Scalar, LocalOrdinal, GlobalOrdinal, NodeType>(list, comm);
  } catch (const std::exception& error) {
    found.push_back({muelu.place, in_one_line(error.what())});
  }
  try {
    const auto list = rcp(new Teuchos::ParameterList(belos_defaults(options, options.tolerance, small_basis)));
    list->setParameters(options.belos.value);
    Belos::TpetraSolverFactory<Scalar, MultiVector, Operator> factory;
    const auto gmres = factory.create("GMRES", Teuchos::null);
    const auto valid = gmres->getValidParameters();
    const auto unknown = unknown_parameters(options.belos.value, *valid, options.belos.place, "Belos' GMRES",
                                            "the documentation of Belos::BlockGmresSolMgr (trilinos.github.io)");
    found.insert(found.end(), unknown.begin(), unknown.end());
    if (unknown.empty()) list->validateParameters(*valid);
  } catch (const std::exception& error) {
    found.push_back({options.belos.place, in_one_line(error.what())});
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
