#pragma once
// Conductance of two surfaces that touch: heat per area, time and jump of temperature. A new law: a struct here, and its line in
// conductance_registry().

#include <optional>
#include <string>
#include <vector>

#include "mortise/core/parameters.hpp"
#include "mortise/core/scalar_function.hpp"

namespace mortise {

/// Surfaces that touch at a slave node, as a law sees them.
struct TouchingPoint {
  double pressure = 0.0;          ///< p >= 0 [stress]
  double temperature = 0.0;       ///< mean of both sides
  double slip_rate = 0.0;         ///< v >= 0 [length / time]
  double largest_pressure = 0.0;  ///< of all nodes of the pair; where ConductanceLaw::needs_largest_pressure()
};

/// h, with its derivatives.
struct Conductance {
  double value = 0.0;           ///< h [power / (area temperature)]
  double of_pressure = 0.0;     ///< dh/dp
  double of_temperature = 0.0;  ///< dh/dtheta
  double of_slip_rate = 0.0;    ///< dh/dv
};

/// The conductance of a pair of surfaces that touch.
struct ConductanceLaw : Described {
  /// h and its derivatives. A law may give a value that is negative or not finite: whoever asks refuses it with the place.
  virtual Conductance at(const TouchingPoint& point) const = 0;
  /// True if TouchingPoint::largest_pressure is read.
  virtual bool needs_largest_pressure() const { return false; }
  /// Error in its numbers; nothing: they make a law.
  virtual std::optional<std::string> fault() const = 0;
};

/// h = 0: nothing flows.
struct NoConductance : ConductanceLaw {
  void describe(Parameters&) override {}
  Conductance at(const TouchingPoint&) const override { return {}; }
  std::optional<std::string> fault() const override { return std::nullopt; }
};

/// h whatever the pressure.
struct ConstantConductance : ConductanceLaw {
  double value = 0.0;  ///< h
  void describe(Parameters& parameters) override;
  Conductance at(const TouchingPoint&) const override { return {value, 0.0, 0.0, 0.0}; }
  std::optional<std::string> fault() const override;
};

/// No resistance: h = 10^6 k / l, k the largest conductivity of both sides and l the shortest side of a slave facet. Then the jump is 10^-6 of the
/// difference of temperatures across a facet, far below the error of any mesh, and h is no worse for a linear solver than a tie.
struct PerfectConductance : ConstantConductance {
  static constexpr double over_facet = 1e6;  ///< h l / k
  void describe(Parameters&) override {}     ///< no parameters
  /// That of a pair.
  static PerfectConductance of(double conductivity, double facet);
};

/// h = h_g + h_0 (p / H)^m, as of rough surfaces: Cooper, Mikic, Yovanovich 1969 have h_0 = 1.25 k s / sigma with the mean conductivity k, the mean
/// slope s and the roughness sigma of the profiles, and m = 0.95.
struct PowerConductance : ConductanceLaw {
  double factor = 0.0;            ///< h_0
  double hardness = 0.0;          ///< H [stress]
  double exponent = 0.95;         ///< m > 0
  double without_pressure = 0.0;  ///< h_g, as of a gas between the asperities
  /// Share of the largest pressure below which the secant replaces the power: its slope has no bound at p = 0 for m < 1.
  static constexpr double of_largest = 1e-6;
  void describe(Parameters& parameters) override;
  Conductance at(const TouchingPoint& point) const override;
  bool needs_largest_pressure() const override { return true; }
  std::optional<std::string> fault() const override;
};

/// Straight lines between points, constant beyond them.
struct TabulatedConductance : ConductanceLaw {
  std::vector<double> pressures;     ///< of the points, ascending [stress]
  std::vector<double> conductances;  ///< there
  void describe(Parameters& parameters) override;
  Conductance at(const TouchingPoint& point) const override;
  std::optional<std::string> fault() const override;
};

/// h as a function of pressure, temperature and slip rate. Its derivatives are central differences.
struct ConductanceFunction : ConductanceLaw {
  ScalarFunction conductance{0.0};  ///< of `pressure`, `temperature`, `slip_rate`
  void describe(Parameters& parameters) override;
  Conductance at(const TouchingPoint& point) const override;
  std::optional<std::string> fault() const override { return std::nullopt; }
};

/// All laws by name.
const Registry<ConductanceLaw>& conductance_registry();

}  // namespace mortise
