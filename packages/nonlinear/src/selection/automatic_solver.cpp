#include "selection/automatic_solver.hpp"

#include <algorithm>

namespace mortise::detail {
namespace {

/// Matrices that the direct solver takes at first, and at most, before the iterative one is tried again.
constexpr int fewest_direct = 20, most_direct = 320;

class AutomaticSolver : public LinearSolver {
 public:
  AutomaticSolver(std::unique_ptr<LinearSolver> iterative, std::unique_ptr<LinearSolver> direct, double most)
      : iterative_(std::move(iterative)), direct_(std::move(direct)), most_(most) {}

  std::string name() const override { return iterative_->name(); }
  int symbolic_setups() const override { return iterative_->symbolic_setups() + direct_->symbolic_setups(); }
  std::optional<Tolerances> tolerances() const override { return iterative_->tolerances(); }

  void set_matrix(const RCP<const Matrix>& matrix, bool graph_changed, const MultigridInput& multigrid) override {
    matrix_ = matrix;
    multigrid_ = multigrid;
    has_new_graph_ = has_new_graph_ || graph_changed;
    iterative_has_matrix_ = direct_has_matrix_ = false;
    iterations_ = 0;
    if (direct_left_ > 0 && --direct_left_ == 0) direct_->forget();
  }

  void forget() override {
    iterative_->forget();
    direct_->forget();
    direct_left_ = 0;
    next_direct_ = fewest_direct;
  }

  LinearSolveReport solve(const Vector& b, Vector& x, double tolerance) override {
    if (direct_left_ > 0) {
      try {
        return solve_directly(b, x);
      } catch (const StepFailure& failure) {  // on every rank
        if (failure.kind() != FailureKind::out_of_memory) throw;
        has_room_ = false;
        direct_left_ = 0;
      }
    }
    try {
      const LinearSolveReport report = solve_iteratively(b, x, tolerance);
      iterations_ += report.iterations;
      if (iterations_ > most_)
        prefer_direct();
      else
        next_direct_ = fewest_direct;
      return report;
    } catch (const StepFailure& failure) {  // on every rank
      if (failure.kind() != FailureKind::linear_solver || !has_room_) throw;
    }
    prefer_direct();
    return solve_directly(b, x);
  }

 private:
  void prefer_direct() {
    if (!has_room_) return;
    direct_left_ = next_direct_;
    next_direct_ = std::min(2 * next_direct_, most_direct);
  }

  LinearSolveReport solve_directly(const Vector& b, Vector& x) {
    if (!direct_has_matrix_) direct_->set_matrix(matrix_, has_new_graph_, multigrid_);
    direct_has_matrix_ = true;
    has_new_graph_ = false;
    return direct_->solve(b, x);
  }

  LinearSolveReport solve_iteratively(const Vector& b, Vector& x, double tolerance) {
    if (!iterative_has_matrix_) iterative_->set_matrix(matrix_, has_new_graph_, multigrid_);
    iterative_has_matrix_ = true;
    return iterative_->solve(b, x, tolerance);
  }

  std::unique_ptr<LinearSolver> iterative_, direct_;
  double most_;  ///< iterations for one matrix
  RCP<const Matrix> matrix_;
  MultigridInput multigrid_;
  bool has_new_graph_ = true;  ///< since the direct solver had a matrix
  bool iterative_has_matrix_ = false, direct_has_matrix_ = false;
  bool has_room_ = true;  ///< the direct solver, for all that is known
  int iterations_ = 0;    ///< with the matrix at hand
  int direct_left_ = 0;   ///< matrices that the direct solver still takes, this one among them
  int next_direct_ = fewest_direct;
};

}  // namespace

double iterations_of_factorisation(GlobalOrdinal unknowns) {
  constexpr double unknowns_per_iteration = 160.0;
  return static_cast<double>(unknowns) / unknowns_per_iteration;
}

std::unique_ptr<LinearSolver> make_automatic_solver(std::unique_ptr<LinearSolver> iterative, std::unique_ptr<LinearSolver> direct, double most) {
  return std::make_unique<AutomaticSolver>(std::move(iterative), std::move(direct), most);
}

}  // namespace mortise::detail
