#pragma once
// When a hierarchy of multigrid is rebuilt.

#include <limits>

namespace mortise::detail {

/// Iterations of GMRES that making a hierarchy counts as. Fewer than take as long: what an old one costs grows with model and ranks
/// (docs/solvers.md).
constexpr double iterations_of_set_up = 10.0;

/// Tells when a hierarchy that serves one matrix after another is stale and has to be rebuilt. Let its solves have taken iterations i_k to reduce
/// residuals by d_k digits. The cost so far is c = (S + sum i_k) / sum d_k iterations a digit, with S those of the set-up. It is least where the next
/// digit costs as much as all before it on average; from there on another hierarchy saves time, if it is like this one. The iterations of a fresh
/// hierarchy are not used: the first solve may be easier than all that follow, and a new hierarchy no better.
class ReusePolicy {
 public:
  /// A solve with the hierarchy.
  /// @param iterations of GMRES.
  /// @param digits of the residual, its decadic logarithm's fall; > 0.
  void record(int iterations, double digits);

  /// True if solves have taken more than one iteration, in sum, beyond the least average: counts are whole numbers, and one more says nothing.
  bool is_stale() const { return beyond_ > 1.0; }

  /// Iterations of a solve of so many digits at which it had better have begun with a new hierarchy. Infinite before the first solve.
  double most_iterations(double digits) const { return digits * least_average_ + iterations_of_set_up; }

 private:
  double iterations_ = iterations_of_set_up;  ///< S + sum i_k
  double digits_ = 0.0;                       ///< sum d_k
  double least_average_ = std::numeric_limits<double>::infinity();
  double beyond_ = 0.0;  ///< sum of max(0, i_k - d_k min c)
};

}  // namespace mortise::detail
