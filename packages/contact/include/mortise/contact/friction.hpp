#pragma once
// Friction laws: how much shear traction a closed node bears before it slips. A new law: a struct here, and its line in friction_registry().

#include <limits>
#include <optional>

#include "mortise/contact/friction_bound.hpp"
#include "mortise/core/parameters.hpp"

namespace mortise {

/// The friction of a contact pair.
struct FrictionLaw : Described {
  /// False: no code and no memory of friction for the pair.
  virtual bool acts() const { return true; }

  /// rho at a node; NaN where the law has none.
  virtual FrictionBound bound(const FrictionPoint& point) const = 0;

  /// True if FrictionPoint::temperature is known to be read: archives keep it.
  virtual bool reads_temperature() const { return false; }

  /// A number that rho / pressure never exceeds; infinite where none is known.
  virtual double largest_ratio() const { return std::numeric_limits<double>::infinity(); }

  /// Why there is no bound at a node; nothing where there is one.
  virtual std::optional<Diagnostic> missing_bound(const FrictionPoint& /*point*/) const { return {}; }
};

/// Nodes slip freely.
struct NoFriction : FrictionLaw {
  void describe(Parameters&) override {}  ///< no parameters
  bool acts() const override { return false; }
  FrictionBound bound(const FrictionPoint&) const override { return {}; }
  double largest_ratio() const override { return 0.0; }
};

/// rho = min(mu p, largest traction).
struct CoulombFriction : FrictionLaw {
  ScalarFunction coefficient{0.0};         ///< mu of pressure, slip path and temperature
  std::optional<double> largest_traction;  ///< [stress]
  void describe(Parameters& parameters) override;
  /// A coefficient of 0 is no friction.
  bool acts() const override { return !coefficient.is_constant() || coefficient.at({0.0, 0.0, 0.0}) > 0.0; }
  FrictionBound bound(const FrictionPoint& point) const override;
  bool reads_temperature() const override { return coefficient.depends_on(2); }
  double largest_ratio() const override { return coefficient.is_constant() ? coefficient.at({0.0, 0.0, 0.0}) : FrictionLaw::largest_ratio(); }
  std::optional<Diagnostic> missing_bound(const FrictionPoint& point) const override;
};

/// rho given, whatever the pressure.
struct TrescaFriction : FrictionLaw {
  double traction = 0.0;  ///< [stress]
  void describe(Parameters& parameters) override;
  FrictionBound bound(const FrictionPoint&) const override { return {traction, 0.0}; }
};

/// All friction laws by name.
const Registry<FrictionLaw>& friction_registry();

}  // namespace mortise
