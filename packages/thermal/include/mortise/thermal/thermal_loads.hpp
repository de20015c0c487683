#pragma once
// Heat through the surface of bodies: flux, convection, radiation.

#include <memory>
#include <string>

#include "mortise/core/parameters.hpp"
#include "mortise/nonlinear/contribution.hpp"
#include "mortise/thermal/thermal_bodies.hpp"

namespace mortise {

/// A flux q of heat into a body through a side set, per reference area, by its parameters. It is a contribution r_a = -integral of N_a q dA0 with its
/// derivative by theta; its power is minus the sum of its rows, see sums_of_heat(). In 2D dA0 is length times thickness or 2 pi R.
struct ThermalLoadOptions : Described {
  Located<std::string> set;  ///< side set
  /// Makes the load, of the kind external. A value q that is not finite is a failure (kind input) of the step. Collective.
  /// @throws InputError on all ranks for a set that does not exist, or has sides of bodies without a temperature
  virtual std::shared_ptr<Contribution> make(const std::shared_ptr<const ThermalBodies>& bodies) const = 0;
  /// True if the heat depends on the temperature of the surface, as that to surroundings does: it determines the temperature of a steady body.
  virtual bool determines_temperature() const = 0;
  /// Temperature of t, x, y, z that the surface would take by this load alone; null: it has none.
  virtual const ScalarFunction* surroundings_temperature() const { return nullptr; }
  /// True if it goes with the size of temperatures, and not with their differences.
  virtual bool needs_absolute_temperatures() const { return false; }
};

/// q as it is given.
struct SurfaceHeatFluxOptions : ThermalLoadOptions {
  ScalarFunction flux;  ///< into the body, of t, x, y, z (reference position), temperature [power / area]
  void describe(Parameters& parameters) override;
  std::shared_ptr<Contribution> make(const std::shared_ptr<const ThermalBodies>& bodies) const override;
  bool determines_temperature() const override { return false; }
};

/// q = h (theta_s - theta).
struct ConvectionOptions : ThermalLoadOptions {
  ScalarFunction coefficient;   ///< h >= 0 of t, x, y, z, temperature [power / (area temperature)]
  ScalarFunction surroundings;  ///< theta_s of t, x, y, z
  void describe(Parameters& parameters) override;
  std::shared_ptr<Contribution> make(const std::shared_ptr<const ThermalBodies>& bodies) const override;
  bool determines_temperature() const override;
  const ScalarFunction* surroundings_temperature() const override { return &surroundings; }
};

/// q = e s (theta_s^4 - theta^4), with absolute temperatures: theta <= 0 or theta_s < 0 is a failure (kind input).
struct RadiationOptions : ThermalLoadOptions {
  double emissivity = 1.0;        ///< e in (0, 1]
  double stefan_boltzmann = 0.0;  ///< s > 0, in the units of the model [power / (area temperature^4)]
  ScalarFunction surroundings;    ///< theta_s of t, x, y, z
  void describe(Parameters& parameters) override;
  std::shared_ptr<Contribution> make(const std::shared_ptr<const ThermalBodies>& bodies) const override;
  bool determines_temperature() const override { return true; }
  const ScalarFunction* surroundings_temperature() const override { return &surroundings; }
  bool needs_absolute_temperatures() const override { return true; }
};

/// All kinds by name: "heat flux", "convection", "radiation".
const Registry<ThermalLoadOptions>& thermal_load_registry();

}  // namespace mortise
