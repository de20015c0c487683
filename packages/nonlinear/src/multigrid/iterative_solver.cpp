#include "multigrid/iterative_solver.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "linear/linear_system_checks.hpp"
#include "multigrid/fields/field_preconditioner.hpp"
#include "multigrid/fields/weighted_equations.hpp"
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
    if (multigrid.alone != multigrid_.alone) drop_hierarchy();
    matrix_ = matrix;
    multigrid_ = multigrid;
    fields_ = multigrid.fields ? std::optional(multigrid.fields()) : std::nullopt;
    preconditioner_.reset();
    is_fresh_ = false;
    if (reuse_.is_stale() || hierarchies_.empty() || !hierarchy_rows_->isSameAs(*matrix->getDomainMap())) drop_hierarchy();
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
    const WeightedEquations equations(matrix_, fields_ ? &*fields_ : nullptr, b);
    LinearSolveReport report;
    std::optional<StepFailure> failure;
    try {
      prepare();
      start(b, x);
      report.iterations = iterate_until_converged(equations, x, tolerance);
    } catch (const std::exception& error) {
      drop_hierarchy();
      failure = StepFailure(FailureKind::linear_solver, name() + ": " + error.what());
    }
    throw_if_any(*matrix_->getComm(), failure);

    Vector r(b.getMap());
    report.relative_residual = true_residual(*equations.A(), equations.b(), x, r) / equations.size();
    if (report.relative_residual <= accepted_residual * tolerance) return report;
    drop_hierarchy();
    throw StepFailure(FailureKind::linear_solver, fmt::format("{}: the true relative residual is {:.1e} after {} iterations (tolerance {:.1e})",
                                                              name(), report.relative_residual, report.iterations, tolerance));
  }

 private:
  void drop_hierarchy() {
    hierarchies_.clear();
    preconditioner_.reset();
    reuse_ = {};
  }

  /// Makes the preconditioner of the matrix at hand, and the hierarchies of its fields if there are none, unless it is there.
  void prepare() {
    if (preconditioner_) return;
    const auto scope = timers_.scope("linear setup");
    const EquationsOfFields equations(matrix_, multigrid_, fields_ ? &*fields_ : nullptr);
    if (hierarchies_.empty()) {
      hierarchies_ = equations.hierarchies(options_.muelu.value, smoother_);
      hierarchy_rows_ = matrix_->getDomainMap();
      ++setups_;
      is_fresh_ = true;
    }
    preconditioner_ = equations.preconditioner(hierarchies_);
  }

  void start(const Vector& b, Vector& x) const {
    if (preconditioner_->start.is_null()) return;
    const auto scope = timers_.scope("linear solve");
    preconditioner_->start->apply(b, x);
  }

  /// A hierarchy of an earlier matrix that fails is replaced during the solve. A smoother that fails is replaced for good, and the solve starts anew.
  int iterate_until_converged(const WeightedEquations& equations, Vector& x, double tolerance) {
    GmresReport report = iterate(equations, x, tolerance);
    int iterations = report.iterations;
    const auto try_again = [&] {
      drop_hierarchy();
      prepare();
      report = iterate(equations, x, tolerance);
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

  GmresReport iterate(const WeightedEquations& equations, Vector& x, double tolerance) {
    const auto scope = timers_.scope("linear solve");
    Vector r(x.getMap());
    const double digits = std::max(1.0, std::log10(true_residual(*equations.A(), equations.b(), x, r) / (tolerance * equations.size())));
    double most = most_iterations(smoother_);
    if (!is_fresh_) most = std::min(most, std::ceil(reuse_.most_iterations(digits)));
    GmresReport report = gmres_.solve(equations.A(), equations.preconditioner(preconditioner_->inverse), equations.b(), x, tolerance, most);
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
  std::optional<FieldsOfRows> fields_;                   ///< of the matrix; none: it has one
  std::vector<MultigridHierarchy> hierarchies_;          ///< of the fields; empty: none yet
  RCP<const Map> hierarchy_rows_;                        ///< of the matrix that they were made for
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
