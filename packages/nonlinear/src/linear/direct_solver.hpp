#pragma once
// Direct solvers by Amesos2.

#include <memory>
#include <stdexcept>
#include <string>

#include "mortise/core/timers.hpp"
#include "mortise/nonlinear/linear_solver.hpp"
#include "mortise/nonlinear/linear_solver_options.hpp"

namespace Amesos2 {
template <class Matrix, class Vector>
class Solver;
}

namespace mortise::detail {

using Amesos2Solver = Amesos2::Solver<Matrix, MultiVector>;

/// Error message of MUMPS; the same on all ranks.
class MumpsError : public std::runtime_error {
 public:
  MumpsError(int code, int detail);
  /// INFOG(1)
  int code() const { return code_; }
  /// True if memory could not be had.
  bool is_out_of_memory() const { return code_ == -5 || code_ == -7 || code_ == -13 || code_ == -19; }
  /// True if more work space (ICNTL(14)) may help.
  bool needs_work_space() const { return code_ == -8 || code_ == -9 || code_ == -14 || code_ == -15 || code_ == -20; }

 private:
  int code_;
};

/// Amesos2's adapter of MUMPS, and its extra work space in percent of the estimate. In one source file, see there.
RCP<Amesos2Solver> make_mumps_adapter(const RCP<const Matrix>& matrix);
/// Memory that the last analysis foresaw for the factorisation on this rank, extra work space included [MiB].
double mumps_memory_foreseen();
/// Sign of the determinant that the last factorisation gave; 0: it gave none.
int mumps_determinant_sign();
void set_mumps_work_space(Amesos2Solver& mumps, int percent);

/// @param work_space  extra work space of the first factorisation, in percent; more is taken where that is not enough
std::unique_ptr<LinearSolver> make_mumps_solver(const LinearSolverOptions& options, const Timers& timers, const std::string& name,
                                                int work_space = 50);
std::unique_ptr<LinearSolver> make_klu2_solver(const LinearSolverOptions& options, const Timers& timers);

/// True if the global ids of a map are all of an interval (in any order): what Amesos2 calls contiguous.
bool ids_have_no_gaps(const Map& map);

}  // namespace mortise::detail
