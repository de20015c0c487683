#pragma once
// Linear constraints between the unknowns of a system.

#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "mortise/core/error.hpp"
#include "mortise/core/types.hpp"

namespace mortise {

/// A closed set of constraints x_i = sum_j a_ij x_j + b_i(t): prescribed values, mesh ties, inclined supports. Lines come in any order, and an x_j
/// may be constrained itself. A line without terms prescribes x_i; such unknowns stay among those of the system, so that others may depend on them.
/// All other lines are put into one another until they depend on unknowns alone, x = T x + b(t). A value.
class AffineConstraints {
 public:
  /// x_row = sum of coefficients times unknowns, and of factors times values.
  struct Line {
    LocalOrdinal row = 0;                                 ///< owned
    std::vector<std::pair<GlobalOrdinal, double>> terms;  ///< (id of an unknown of any rank, a_ij)
    std::vector<std::pair<std::size_t, double>> shares;   ///< (number of a value, factor)
  };
  /// Values of all lines at a pseudo-time. Failures of this rank go to `failure` if that is empty; values are not finite there.
  using Values = std::function<std::vector<double>(double time, std::optional<StepFailure>& failure)>;

  /// Collective.
  /// @param values  may be empty if no line has shares
  /// @throws std::invalid_argument on all ranks for two lines of a row, and for lines that depend on one another in a circle, with an id
  AffineConstraints(RCP<const Map> dofs, std::vector<Line> lines, Values values);

  /// Rows of lines without terms, ascending.
  const std::vector<LocalOrdinal>& prescribed() const { return prescribed_; }
  /// Their values, in this order. Failures as in Values.
  std::vector<double> prescribed_values(double time, std::optional<StepFailure>& failure) const;

  /// Rows of lines with terms, ascending.
  const std::vector<LocalOrdinal>& dependent() const { return dependent_; }
  /// [owned dofs squared] Rows of other dofs are those of the identity, columns of dependent ones are empty. Null: no rank has a dependent row.
  const RCP<const Matrix>& T() const { return T_; }
  /// b [owned dofs], 0 at rows that do not depend; null: it is 0 at all times. Failures as in Values. Collective.
  RCP<Vector> offset(double time, std::optional<StepFailure>& failure) const;

 private:
  using Shares = std::vector<std::pair<std::size_t, double>>;

  RCP<const Map> dofs_;
  Values values_;
  std::vector<LocalOrdinal> prescribed_, dependent_;
  std::vector<Shares> shares_of_prescribed_, shares_of_dependent_;
  RCP<const Matrix> lines_;  ///< as given
  RCP<const Matrix> T_;      ///< lines_^rounds_
  int rounds_ = 1;
  bool has_offset_ = false;  ///< on any rank
};

}  // namespace mortise
