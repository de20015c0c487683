#pragma once
// Heat through a side set: integration of a flux that depends on the temperature.

#include <array>
#include <memory>
#include <optional>
#include <string>

#include "mortise/core/piecewise_linear.hpp"
#include "mortise/thermal/thermal_loads.hpp"

namespace mortise {

/// A point of a surface.
struct SurfacePoint {
  double time = 0.0;
  std::array<double, 3> position{};  ///< of the reference configuration
  double temperature = 0.0;
};

/// A function's value that is not allowed.
struct SurfaceFault {
  std::string what;     ///< with its value: "heat flux \"1 / t\" is inf"
  std::string allowed;  ///< "finite"
};

/// q into the body, with its derivative by the temperature.
class SurfaceFluxLaw {
 public:
  virtual ~SurfaceFluxLaw() = default;
  virtual std::string name() const = 0;
  /// @param with_slope  the slope is wanted
  /// @param fault       gets what is not allowed; the result is then of no use
  virtual ValueAndSlope at(const SurfacePoint& point, bool with_slope, std::optional<SurfaceFault>& fault) const = 0;
};

/// The load of a law on a set. Collective; throws InputError as ThermalLoadOptions::make().
std::shared_ptr<Contribution> make_surface_heat(std::shared_ptr<const ThermalBodies> bodies, const Located<std::string>& set,
                                                std::unique_ptr<const SurfaceFluxLaw> law);

}  // namespace mortise
