#pragma once
// GMRES of Belos.

#include <exception>
#include <vector>

#include "mortise/nonlinear/linear_solver_options.hpp"

namespace mortise::detail {

/// True residuals up to so many times the tolerance do.
constexpr double accepted_residual = 10.0;

/// End of iterations.
struct GmresReport {
  int iterations = 0;        ///< their number
  bool converged = false;    ///< to the tolerance, or to a true residual that does
  std::exception_ptr error;  ///< error that ended them early, such as overflow; null: none
};

/// GMRES, preconditioned from the right. It keeps few vectors before it restarts, and more from a system on that took many iterations.
class Gmres {
 public:
  /// With the maximum of iterations and the parameters of Belos in `options`.
  explicit Gmres(LinearSolverOptions options) : options_(std::move(options)) {}

  /// Goes on from x towards the solution of A x = b. Collective.
  /// @param tolerance        of the residual over |b|
  /// @param most_iterations  bounds those of the options; may be infinite
  GmresReport solve(const RCP<const Operator>& A, const RCP<const Operator>& preconditioner, const Vector& b, Vector& x, double tolerance,
                    double most_iterations);

 private:
  LinearSolverOptions options_;
  bool has_large_basis_ = false;
};

/// Errors of Belos about the parameters of `options`: names and types.
std::vector<Diagnostic> gmres_parameter_errors(const LinearSolverOptions& options);

}  // namespace mortise::detail
