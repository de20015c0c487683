#pragma once
// Dirichlet conditions of the temperature.

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "mortise/core/parameters.hpp"
#include "mortise/nonlinear/affine_constraints.hpp"
#include "mortise/thermal/thermal_bodies.hpp"

namespace mortise {

/// A temperature that is prescribed on a set of nodes.
struct PrescribedTemperatureOptions {
  Located<std::string> set;    ///< node or side set
  ScalarFunction temperature;  ///< of t, x, y, z (reference position)
  void describe(Parameters& parameters);
};

/// All prescribed temperatures of this rank's nodes. Reactions, the power that they take, are the rows of the residual.
class PrescribedTemperatures {
 public:
  /// Collective. Throws InputError on all ranks for a set that does not exist, nodes without a temperature, and nodes where conditions differ.
  PrescribedTemperatures(const ThermalBodies& bodies, const std::vector<Named<PrescribedTemperatureOptions>>& conditions);

  /// Rows of owned nodes, ascending.
  const std::vector<LocalOrdinal>& rows() const { return rows_; }

  /// A line for each row, in this order.
  /// @param first  number of the first of values() among those of the constraints
  std::vector<AffineConstraints::Line> lines(std::size_t first = 0) const;

  /// Of rows() at a time. A function without a finite value is put into `failure` if that is empty (kind input), its value is NaN.
  std::vector<double> values(double time, std::optional<StepFailure>& failure) const;

 private:
  struct Source {
    std::size_t condition;
    std::array<double, 3> position;
  };
  double value(const Source& source, double time, std::optional<StepFailure>& failure) const;

  std::vector<Named<PrescribedTemperatureOptions>> conditions_;
  std::vector<LocalOrdinal> rows_;
  std::vector<Source> sources_;  ///< [rows]
};

}  // namespace mortise
