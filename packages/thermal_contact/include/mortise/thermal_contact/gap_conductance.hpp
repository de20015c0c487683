#pragma once
// Conductance across the gap of surfaces that do not touch. A new law: a struct here, and its line in gap_conductance_registry().

#include <optional>
#include <string>
#include <vector>

#include "mortise/core/parameters.hpp"

namespace mortise {

/// h across a gap, with its derivative.
struct ConductanceOfGap {
  double value = 0.0;   ///< h [power / (area temperature)]
  double of_gap = 0.0;  ///< dh/dg
};

/// The conductance of a pair of surfaces that do not touch. Nothing conducts beyond the search reach.
struct GapConductance : Described {
  /// h at a mean gap g >= 0 [length].
  virtual ConductanceOfGap at(double gap) const = 0;
  /// Error in its numbers; nothing: they make a law.
  virtual std::optional<std::string> fault() const = 0;
};

/// h = 0: nothing flows.
struct NoGapConductance : GapConductance {
  void describe(Parameters&) override {}
  ConductanceOfGap at(double) const override { return {}; }
  std::optional<std::string> fault() const override { return std::nullopt; }
};

/// h = k / (g + g_0), of a medium at rest in the gap.
struct MediumConductance : GapConductance {
  double conductivity = 0.0;  ///< k [power / (length temperature)]
  double distance = 0.0;      ///< g_0 > 0: what is left between surfaces that touch, as roughness and the jump distance of a gas [length]
  void describe(Parameters& parameters) override;
  ConductanceOfGap at(double gap) const override;
  std::optional<std::string> fault() const override;
};

/// Straight lines between points, constant beyond them.
struct TabulatedGapConductance : GapConductance {
  std::vector<double> gaps;          ///< of the points, ascending [length]
  std::vector<double> conductances;  ///< there
  void describe(Parameters& parameters) override;
  ConductanceOfGap at(double gap) const override;
  std::optional<std::string> fault() const override;
};

/// All laws by name.
const Registry<GapConductance>& gap_conductance_registry();

}  // namespace mortise
