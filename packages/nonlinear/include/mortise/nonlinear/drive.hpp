#pragma once
// Drive of a step: the changes of its loads and prescribed displacements.

#include <memory>
#include <optional>
#include <vector>

#include "mortise/core/types.hpp"

namespace mortise {

namespace detail {
class SystemModel;
}  // namespace detail

/// Changes of loads and of prescribed displacements between two pseudo-times, at a displacement x that is held:
///
///     f_ext(x, to) - f_ext(x, from)      s (p(to) - p(from))
///
/// Each is kept for each field. Changes within the round-off of what changes are 0. Contact conditions that depend on time (clearances, coefficients)
/// are no part of it. Collective in all members but strength().
class Drive {
 public:
  /// |(df_ext, s dp)|, a force
  double strength() const;

  /// Share in which this drive continues an earlier one at the same place: the least, over loads and prescribed displacements, of
  ///
  ///     (now . before) / |before|^2,
  ///
  /// the share of the earlier change that is made once more; not below 0. None where nothing drove before.
  std::optional<double> continuation(const Drive& before) const;

 private:
  friend class SemiSmoothSystem;
  /// @throws StepFailure on every rank for a load or a prescribed displacement without a value
  Drive(std::shared_ptr<const detail::SystemModel> model, const Vector& displacement, double from, double to);

  std::shared_ptr<const detail::SystemModel> model_;
  std::vector<RCP<Vector>> changes_;        ///< loads, prescribed displacements
  std::vector<std::vector<double>> norms_;  ///< of each, [fields], in units of the first
};

}  // namespace mortise
