#include "linear/direct_solver.hpp"

#include <fmt/format.h>

#include <Amesos2.hpp>
#include <Teuchos_BLAS.hpp>
#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <new>
#include <optional>
#include <vector>

#include "linear/linear_system_checks.hpp"
#include "mortise/core/memory.hpp"
#include "mortise/core/trilinos_versions.hpp"

namespace mortise::detail {
namespace {

/// Steps of iterative refinement at most.
constexpr int most_refinements = 3;

/// Correction over solution up to which a solution is accepted. Take a singular matrix whose right-hand side is not in its range. Its factors, with
/// pivots of round-off, give a huge multiple of a null vector. The backward error is small. But A does not see this vector, so each step of
/// refinement adds the same multiple again. Corrections are then half, a third, a quarter of the solution. Of any other matrix they are about
/// round-off times its condition number.
constexpr double certain = 1e-2;

/// Result of refinement.
struct Refined {
  int steps = 0;
  double backward_error = 0.0;
  double largest_correction = 0.0;  ///< over the solution it led to, of all steps
};

/// Buffer of OpenBLAS at its first product of matrices: 128 MiB of addresses, most of which it never touches. If it does not get them it asks
/// again without end.
constexpr double blas_buffer_mib = 129.0;

/// Lets the BLAS take its buffer. Kernels for small matrices (up to 100^3 products) take none.
void warm_blas() {
  constexpr int size = 160;
  const std::vector<double> ones(size * size, 1.0);
  std::vector<double> product(size * size);
  Teuchos::BLAS<int, double>().GEMM(Teuchos::NO_TRANS, Teuchos::NO_TRANS, size, size, size, 1.0, ones.data(), size, ones.data(), size, 0.0,
                                    product.data(), size);
}

/// Analysis, factorisation, solve, iterative refinement if the true residual asks for it.
class DirectSolver : public LinearSolver {
 public:
  DirectSolver(std::string name, double residual_bound, const Timers& timers) : name_(std::move(name)), bound_(residual_bound), timers_(timers) {}

  std::string name() const override { return name_; }
  int symbolic_setups() const override { return symbolic_setups_; }

  void set_matrix(const RCP<const Matrix>& matrix, bool graph_changed, const MultigridInput&) override {
    matrix_ = matrix;
    factored_ = false;
    if (graph_changed) amesos2_ = Teuchos::null;
  }

  void forget() override {
    amesos2_ = Teuchos::null;
    factored_ = false;
  }

  LinearSolveReport solve(const Vector& b, Vector& x, double) override {
    const double size = check_finite(*matrix_, b, name_);
    if (size == 0.0) {
      x.putScalar(0.0);
      return {};
    }
    LinearSolveReport report;
    Refined refined;
    try {
      if (!factored_) {
        const auto scope = timers_.scope("linear setup");
        factor();
      }
      const auto scope = timers_.scope("linear solve");
      amesos2_->solve(&x, &b);
      Vector r(b.getMap());
      report.relative_residual = true_residual(*matrix_, b, x, r) / size;
      if (report.relative_residual <= bound_) return report;  // and so is the backward error, which is never larger by more than norms differ
      refined = refine(b, x, r, report.relative_residual, size);
    } catch (const StepFailure&) {
      forget();
      throw;
    } catch (const MumpsError& error) {
      if (error.is_out_of_memory()) fail_without_memory(error.what());
      fail(error.what());
    } catch (const std::bad_alloc& error) {
      if (matrix_->getComm()->getSize() > 1) throw;  // of this rank alone: the others wait in the solver
      fail_without_memory(error.what());
    } catch (const std::exception& error) {
      fail(error.what());
    }
    if (!(refined.backward_error <= bound_))
      fail(fmt::format(
          "the backward error |b - A x| / (|A| |x| + |b|) is {:.1e} after {} steps of refinement (bound {:.1e}): the matrix is singular or "
          "nearly so",
          refined.backward_error, refined.steps, bound_));
    if (!(refined.largest_correction <= certain))
      fail(fmt::format(
          "a step of refinement changes the solution by {:.1e} of itself (bound {:.1e}): no digit of it is certain, the matrix is singular "
          "or nearly so",
          refined.largest_correction, certain));
    return report;
  }

 protected:
  /// Refuses what would not fit, before it is begun: libraries that get no memory loop without end or end the program. Collective.
  /// @param mine  what this rank will take [MiB]
  void check_memory(const char* what, double mine) {
    const Communicator& comm = *matrix_->getComm();
    const double ranks = ranks_on_this_machine(comm);
    const double left = std::min(own_memory_left_mib() - (is_warm_ ? 0.0 : blas_buffer_mib), machine_memory_left_mib() / ranks);
    std::optional<StepFailure> failure;
    if (mine > left)
      failure.emplace(FailureKind::out_of_memory,
                      fmt::format("{}: {} would take about {:.0f} MiB on rank {}, and {:.0f} MiB are left; please run it on more machines, take the "
                                  "iterative solver or a coarser mesh, or raise the limit (ulimit -v)",
                                  name_, what, mine, comm.getRank(), std::max(0.0, left)));
    throw_if_any(comm, failure);
    if (!is_warm_) warm_blas();
    is_warm_ = true;
  }
  /// Memory for ordering the matrix on this rank [MiB].
  virtual double memory_of_analysis() const { return 0.0; }
  const RCP<const Matrix>& matrix() const { return matrix_; }
  virtual RCP<Amesos2Solver> make(const RCP<const Matrix>& matrix) = 0;
  virtual void factor_numerically(Amesos2Solver& amesos2) { amesos2.numericFactorization(); }

 private:
  // r comes in as b - A x. One step at least: a correction says how certain x is.
  Refined refine(const Vector& b, Vector& x, Vector& r, double& relative_residual, double size) {
    Refined refined;
    const double matrix_norm = largest_row_sum(*matrix_);
    Vector correction(x.getMap());
    do {
      amesos2_->solve(&correction, &r);
      x.update(1.0, correction, 1.0);
      ++refined.steps;
      refined.largest_correction = std::max(refined.largest_correction, correction.normInf() / x.normInf());
      const double before = relative_residual;
      relative_residual = true_residual(*matrix_, b, x, r) / size;
      refined.backward_error = backward_error(matrix_norm, b, x, r);
      if (!(relative_residual < 0.5 * before)) break;  // round-off is what is left
    } while (relative_residual > bound_ && refined.steps < most_refinements);
    return refined;
  }

  // Amesos2 reads the values of a matrix in its analysis and, from then on, once before each numeric factorisation that follows a solve. Every
  // factorisation here is followed by a solve, and a solver that failed is dropped.
  void factor() {
    if (amesos2_.is_null()) {
      check_memory("the analysis", memory_of_analysis());
      amesos2_ = make(matrix_);
      amesos2_->symbolicFactorization();
      ++symbolic_setups_;
    } else {
      amesos2_->setA(matrix_, Amesos2::SYMBFACT);
    }
    factor_numerically(*amesos2_);
    factored_ = true;
  }

  [[noreturn]] void fail_without_memory(const std::string& why) {
    forget();
    throw StepFailure(FailureKind::out_of_memory, fmt::format("{}: not enough memory ({}); {:.0f} MiB are left", name_, why,
                                                              std::min(own_memory_left_mib(), machine_memory_left_mib())));
  }

  [[noreturn]] void fail(const std::string& why) {
    forget();
    throw StepFailure(FailureKind::linear_solver, name_ + ": " + why);
  }

  std::string name_;
  double bound_;
  Timers timers_;
  RCP<const Matrix> matrix_;
  RCP<Amesos2Solver> amesos2_;
  bool factored_ = false;
  bool is_warm_ = false;  ///< the BLAS has its buffer
  int symbolic_setups_ = 0;
};

class MumpsSolver : public DirectSolver {
 public:
  MumpsSolver(std::string name, double residual_bound, const Timers& timers, int work_space)
      : DirectSolver(std::move(name), residual_bound, timers), work_space_(work_space) {}

  int determinant_sign() const override { return sign_; }

 protected:
  RCP<Amesos2Solver> make(const RCP<const Matrix>& matrix) override { return make_mumps_adapter(matrix); }

  // MUMPS orders the whole matrix on one rank. Its graph is there twice in both directions, 4 integers an entry, and once more in PORD. The levels of
  // PORD's multisection take as much again. Entries with their rows and columns are on each rank.
  double memory_of_analysis() const override {
    constexpr double mib = 1024.0 * 1024.0, integers = 8.0;
    const double own = static_cast<double>(local_entry_count(*matrix())) * (sizeof(double) + 2 * sizeof(int));
    const double graph = matrix()->getComm()->getRank() == 0 ? static_cast<double>(matrix()->getGlobalNumEntries()) * integers * sizeof(int) : 0.0;
    return (own + graph) / mib;
  }

  // Pivoting may need more work space than the analysis foresaw: ICNTL(14) is raised and the factorisation repeated. From then on this
  // space is given at once.
  void factor_numerically(Amesos2Solver& mumps) override {
    for (;; work_space_ = std::max(50, 4 * work_space_)) {
      set_mumps_work_space(mumps, work_space_);
      const double needed = mumps_memory_foreseen() * (100.0 + work_space_) / (100.0 + default_work_space);
      check_memory("the factorisation", needed - (held_since_ == symbolic_setups() ? held_ : 0.0));
      try {
        mumps.numericFactorization();
        sign_ = mumps_determinant_sign();
        held_ = needed;
        held_since_ = symbolic_setups();
        return;
      } catch (const MumpsError& error) {
        if (!error.needs_work_space() || work_space_ > 1000) throw;
      }
    }
  }

 private:
  static constexpr double default_work_space = 20.0;  ///< of MUMPS, with which analyses look ahead [percent]
  int work_space_;
  int sign_ = 0;
  double held_ = 0.0;    ///< memory of the last factors, whose place the next ones of the same analysis get [MiB]
  int held_since_ = -1;  ///< analyses until then
};

class Klu2Solver : public DirectSolver {
 public:
  using DirectSolver::DirectSolver;

 protected:
  // On one rank Amesos2 gives KLU2 the matrix's own arrays, whatever the global ids are. Told that the ids have gaps, it takes the path of many
  // ranks, whose results are wrong.
  RCP<Amesos2Solver> make(const RCP<const Matrix>& matrix) override { return Amesos2::create<Matrix, MultiVector>("KLU2", matrix); }
};

}  // namespace

bool ids_have_no_gaps(const Map& map) {
  const GlobalOrdinal interval = map.getMaxAllGlobalIndex() - map.getMinAllGlobalIndex() + 1;
  return map.getMinAllGlobalIndex() == map.getIndexBase() && interval == static_cast<GlobalOrdinal>(map.getGlobalNumElements());
}

std::unique_ptr<LinearSolver> make_mumps_solver(const LinearSolverOptions& options, const Timers& timers, const std::string& name, int work_space) {
  return std::make_unique<MumpsSolver>(name, options.residual_bound, timers, work_space);
}

std::unique_ptr<LinearSolver> make_klu2_solver(const LinearSolverOptions& options, const Timers& timers) {
  return std::make_unique<Klu2Solver>("KLU2", options.residual_bound, timers);
}

}  // namespace mortise::detail
