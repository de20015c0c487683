#pragma once
// Pressures that are given functions of the overlap of two surfaces. A new law: a struct here, and its line in
// pressure_law_registry().

#include <optional>
#include <string>
#include <vector>

#include "mortise/core/parameters.hpp"

namespace mortise {

/// A point of the curve p(h), h the overclosure: below 0 where the surfaces are apart.
struct PressurePoint {
  double overclosure = 0.0;  ///< h [length]
  double pressure = 0.0;     ///< p [stress]; 0: the surfaces do not act on one another
  double slope = 0.0;        ///< dp/dh; at a kink the right one [stress / length]
};

/// The pressure of a contact pair as a function of the overclosure: continuous, nowhere falling, 0 far apart.
struct PressureLaw : Described {
  /// The point of the curve on the line p + c h = sum. There is one for any sum and any c > 0, as p never falls.
  virtual PressurePoint on_line(double sum, double c) const = 0;
  /// Overclosure up to which the pressure is 0 [length].
  virtual double onset() const = 0;
  /// Stiffness across the surfaces, as one number [stress / length].
  virtual double typical_slope() const = 0;
  /// Error in its numbers; nothing: they make a curve.
  virtual std::optional<std::string> fault() const = 0;
};

/// p = K h for h > 0.
struct LinearPressure : PressureLaw {
  double stiffness = 0.0;  ///< K [stress / length]
  void describe(Parameters& parameters) override;
  PressurePoint on_line(double sum, double c) const override;
  double onset() const override { return 0.0; }
  double typical_slope() const override { return stiffness; }
  std::optional<std::string> fault() const override;
};

/// A pressure that grows exponentially from a clearance c_0 on, and is p_0 where the surfaces just touch.
struct ExponentialPressure : PressureLaw {
  /// One of the two curves that programs call exponential.
  enum class Curve { from_zero, from_hundredth };
  double clearance = 0.0;          ///< c_0 [length]
  double pressure = 0.0;           ///< p_0 [stress]
  Curve curve = Curve::from_zero;  ///< p(-c_0) = 0, as in Abaqus, or p_0 / 100, as in CalculiX
  void describe(Parameters& parameters) override;
  PressurePoint on_line(double sum, double c) const override;
  double onset() const override;
  double typical_slope() const override { return at(0.0).slope; }
  std::optional<std::string> fault() const override;

 private:
  PressurePoint at(double overclosure) const;
  double most_at(double pressure) const;
};

/// Straight lines between points. From the last one on the pressure grows by the last slope.
struct TabulatedPressure : PressureLaw {
  std::vector<double> overclosures;  ///< of the points, ascending [length]
  std::vector<double> pressures;     ///< there: 0 at first, nowhere falling, above 0 at last [stress]
  void describe(Parameters& parameters) override;
  PressurePoint on_line(double sum, double c) const override;
  double onset() const override;
  double typical_slope() const override;
  std::optional<std::string> fault() const override;

 private:
  double slope(std::size_t piece) const;
};

/// All laws by name.
const Registry<PressureLaw>& pressure_law_registry();

}  // namespace mortise
