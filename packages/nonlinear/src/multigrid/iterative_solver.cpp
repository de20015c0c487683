#include "multigrid/iterative_solver.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "linear/linear_system_checks.hpp"
#include "multigrid/contact_preconditioner.hpp"
#include "multigrid/gmres.hpp"
#include "multigrid/multigrid_parameters.hpp"
#include "multigrid/reuse_policy.hpp"

namespace mortise::detail {
namespace {

/// Puts together what solves, what preconditions, which smoother that has, and how long it is reused.
class IterativeSolver : public LinearSolver {
 public:
  IterativeSolver(const LinearSolverOptions& options, const Timers& timers, std::string name)
      : options_(options), timers_(timers), name_(std::move(name)), gmres_(options), smoother_(first_smoother(options.muelu.value)) {}

  std::string name() const override { return name_; }
  int symbolic_setups() const override { return setups_; }

  void set_matrix(const RCP<const Matrix>& matrix, bool, const MultigridInput& multigrid) override {
    matrix_ = matrix;
    multigrid_ = multigrid;
    preconditioner_.reset();
    is_fresh_ = false;
    if (reuse_.is_stale() || !hierarchy_ || !hierarchy_->cycle->getDomainMap()->isSameAs(*matrix->getDomainMap())) drop_hierarchy();
  }

  std::optional<Tolerances> tolerances() const override {
    return Tolerances{options_.tolerance, std::max(options_.tolerance, options_.largest_tolerance)};
  }

  void forget() override {
    drop_hierarchy();
    smoother_ = first_smoother(options_.muelu.value);
  }

  LinearSolveReport solve(const Vector& b, Vector& x, double tolerance) override {
    tolerance = std::max(tolerance, options_.tolerance);
    const double size = check_finite(*matrix_, b, name());
    x.putScalar(0.0);
    if (size == 0.0) return {};
    LinearSolveReport report;
    std::optional<StepFailure> failure;
    try {
      prepare();
      start(b, x);
      report.iterations = iterate_until_converged(b, x, tolerance);
    } catch (const std::exception& error) {
      drop_hierarchy();
      failure = StepFailure(FailureKind::linear_solver, name() + ": " + error.what());
    }
    throw_if_any(*matrix_->getComm(), failure);

    Vector r(b.getMap());
    report.relative_residual = true_residual(*matrix_, b, x, r) / size;
    if (report.relative_residual <= accepted_residual * tolerance) return report;
    drop_hierarchy();
    throw StepFailure(FailureKind::linear_solver, fmt::format("{}: the true relative residual is {:.1e} after {} iterations (tolerance {:.1e})",
                                                              name(), report.relative_residual, report.iterations, tolerance));
  }

 private:
  void drop_hierarchy() {
    hierarchy_.reset();
    preconditioner_.reset();
    reuse_ = {};
  }

  /// Makes the preconditioner of the matrix at hand, and its hierarchy if there is none, unless it is there.
  void prepare() {
    if (preconditioner_) return;
    const auto scope = timers_.scope("linear setup");
    const auto decoupled = multigrid_.decoupling ? std::make_shared<const DecoupledSystem>(matrix_, multigrid_.decoupling()) : nullptr;
    if (!hierarchy_) {
      const NearNullSpace near_null_space = multigrid_.near_null_space ? multigrid_.near_null_space() : NearNullSpace{};
      hierarchy_ = make_hierarchy(matrix_, decoupled.get(), near_null_space, options_.muelu.value, smoother_);
      ++setups_;
      is_fresh_ = true;
    }
    preconditioner_ = make_preconditioner(matrix_, decoupled, *hierarchy_);
  }

  void start(const Vector& b, Vector& x) const {
    if (preconditioner_->start.is_null()) return;
    const auto scope = timers_.scope("linear solve");
    preconditioner_->start->apply(b, x);
  }

  /// A hierarchy of an earlier matrix that fails is replaced during the solve. A smoother that fails is replaced for good, and the solve starts anew.
  int iterate_until_converged(const Vector& b, Vector& x, double tolerance) {
    GmresReport report = iterate(b, x, tolerance);
    int iterations = report.iterations;
    const auto try_again = [&] {
      drop_hierarchy();
      prepare();
      report = iterate(b, x, tolerance);
      iterations += report.iterations;
    };
    if (!report.converged && !is_fresh_) try_again();
    const std::optional<Smoother> next = next_smoother(smoother_);
    if (!report.converged && next) {
      smoother_ = *next;
      x.putScalar(0.0);
      try_again();
    }
    return iterations;
  }

  GmresReport iterate(const Vector& b, Vector& x, double tolerance) {
    const auto scope = timers_.scope("linear solve");
    Vector r(b.getMap());
    const double digits = std::max(1.0, std::log10(true_residual(*matrix_, b, x, r) / (tolerance * b.norm2())));
    double most = most_iterations(smoother_);
    if (!is_fresh_) most = std::min(most, std::ceil(reuse_.most_iterations(digits)));
    GmresReport report = gmres_.solve(matrix_, preconditioner_->inverse, b, x, tolerance, most);
    if (report.error && !next_smoother(smoother_)) std::rethrow_exception(report.error);
    reuse_.record(report.iterations, digits);
    return report;
  }

  LinearSolverOptions options_;
  Timers timers_;
  std::string name_;
  Gmres gmres_;
  RCP<const Matrix> matrix_;
  MultigridInput multigrid_;
  std::optional<MultigridHierarchy> hierarchy_;
  std::optional<ContactPreconditioner> preconditioner_;  ///< of the matrix
  Smoother smoother_;                                    ///< of the next hierarchy
  ReusePolicy reuse_;                                    ///< of the hierarchy
  bool is_fresh_ = false;                                ///< the hierarchy: made for this matrix
  int setups_ = 0;
};

}  // namespace

std::unique_ptr<LinearSolver> make_iterative_solver(const LinearSolverOptions& options, const RCP<const Communicator>& comm, const Timers& timers,
                                                    const std::string& chosen) {
  std::vector<Diagnostic> errors = multigrid_parameter_errors(options.muelu, comm);
  const std::vector<Diagnostic> of_gmres = gmres_parameter_errors(options);
  errors.insert(errors.end(), of_gmres.begin(), of_gmres.end());
  if (!errors.empty()) throw InputError(std::move(errors));
  return std::make_unique<IterativeSolver>(options, timers, chosen + "GMRES + MueLu smoothed aggregation");
}

}  // namespace mortise::detail
