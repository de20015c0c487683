// Laws of the flux of heat through a surface, and their parameters.

#include "mortise/thermal/thermal_loads.hpp"

#include <fmt/format.h>

#include <cmath>

#include "loads/surface_heat.hpp"
#include "mortise/core/guarded_value.hpp"

namespace mortise {
namespace {

const std::vector<std::string> place_and_temperature{"t", "x", "y", "z", "temperature"};

std::vector<double> arguments_at(const SurfacePoint& point) {
  return {point.time, point.position[0], point.position[1], point.position[2], point.temperature};
}

/// Value of a function of a point, and its slope if that is wanted.
ValueAndSlope function_at(const ScalarFunction& function, const SurfacePoint& point, bool with_slope) {
  if (with_slope) return value_and_slope(function, arguments_at(point), 4);
  return {value_or_nan(function, arguments_at(point)), 0.0};
}

/// What messages say of a function's value, with why it has none.
SurfaceFault surface_fault_of(const char* name, const ScalarFunction& function, double value, const SurfacePoint& point, const char* allowed) {
  std::string reason;
  value_or_nan(function, arguments_at(point), &reason);
  return {fmt::format("{} \"{}\" is {:g}{}", name, function.source(), value, reason.empty() ? "" : fmt::format(" ({})", reason)), allowed};
}

class GivenFlux final : public SurfaceFluxLaw {
 public:
  explicit GivenFlux(ScalarFunction flux) : flux_(std::move(flux)) {}
  std::string name() const override { return "heat flux"; }
  ValueAndSlope at(const SurfacePoint& point, bool with_slope, std::optional<SurfaceFault>& fault) const override {
    const ValueAndSlope q = function_at(flux_, point, with_slope);
    if (!std::isfinite(q.value)) fault = surface_fault_of("flux", flux_, q.value, point, "finite");
    return q;
  }

 private:
  ScalarFunction flux_;
};

/// q = h (theta_s - theta),  q' = h' (theta_s - theta) - h.
class Convection final : public SurfaceFluxLaw {
 public:
  Convection(ScalarFunction coefficient, ScalarFunction surroundings)
      : coefficient_(std::move(coefficient)), surroundings_(std::move(surroundings)) {}
  std::string name() const override { return "convection"; }
  ValueAndSlope at(const SurfacePoint& point, bool with_slope, std::optional<SurfaceFault>& fault) const override {
    const ValueAndSlope h = function_at(coefficient_, point, with_slope);
    if (!(h.value >= 0.0) || !std::isfinite(h.value)) fault = surface_fault_of("coefficient", coefficient_, h.value, point, ">= 0 and finite");
    const double around = function_at(surroundings_, point, false).value;
    if (!std::isfinite(around)) fault = surface_fault_of("temperature of the surroundings", surroundings_, around, point, "finite");
    const double difference = around - point.temperature;
    return {h.value * difference, h.slope * difference - h.value};
  }

 private:
  ScalarFunction coefficient_, surroundings_;
};

/// q = e s (theta_s^4 - theta^4),  q' = -4 e s theta^3.
class Radiation final : public SurfaceFluxLaw {
 public:
  Radiation(double factor, ScalarFunction surroundings) : factor_(factor), surroundings_(std::move(surroundings)) {}
  std::string name() const override { return "radiation"; }
  ValueAndSlope at(const SurfacePoint& point, bool, std::optional<SurfaceFault>& fault) const override {
    const double around = function_at(surroundings_, point, false).value, theta = point.temperature;
    if (!(around >= 0.0) || !std::isfinite(around))
      fault = surface_fault_of("absolute temperature of the surroundings", surroundings_, around, point, ">= 0 and finite");
    if (!(theta > 0.0) || !std::isfinite(theta))
      fault = SurfaceFault{fmt::format("absolute temperature of the surface is {:g}", theta), "> 0 and finite"};
    const double cube = theta * theta * theta;
    return {factor_ * (std::pow(around, 4) - theta * cube), -4.0 * factor_ * cube};
  }

 private:
  double factor_;
  ScalarFunction surroundings_;
};

}  // namespace

void SurfaceHeatFluxOptions::describe(Parameters& parameters) {
  parameters.add("set", set, Says("side set that the heat goes through").required());
  parameters.add("flux", flux,
                 Says("power into the body per reference area, an expression of t, the reference position x, y, z and `temperature`")
                     .unit("power / area")
                     .arguments(place_and_temperature)
                     .required());
}

void ConvectionOptions::describe(Parameters& parameters) {
  parameters.add("set", set, Says("side set that touches the surroundings").required());
  parameters.add("coefficient", coefficient,
                 Says("h >= 0, per reference area, an expression of t, the reference position x, y, z and `temperature`, that of the surface")
                     .unit("power / (area temperature)")
                     .arguments(place_and_temperature)
                     .required());
  parameters.add("surroundings", surroundings,
                 Says("temperature of the surroundings, an expression of t and the reference position x, y, z").unit("temperature").required());
}

void RadiationOptions::describe(Parameters& parameters) {
  parameters.add("set", set, Says("side set that sees the surroundings").required());
  parameters.add("emissivity", emissivity, Says("share of what a black body radiates").unit("-").above(0.0).at_most(1.0));
  parameters.add("stefan-boltzmann constant", stefan_boltzmann,
                 Says("in the units of the model, 5.670374419e-8 W / (m^2 K^4)").unit("power / (area temperature^4)").above(0.0).required());
  parameters.add(
      "surroundings", surroundings,
      Says("absolute temperature of the surroundings, an expression of t and the reference position x, y, z; temperatures of the model have "
           "to be absolute too")
          .unit("temperature")
          .required());
}

std::shared_ptr<Contribution> SurfaceHeatFluxOptions::make(const std::shared_ptr<const ThermalBodies>& bodies) const {
  return make_surface_heat(bodies, set, std::make_unique<GivenFlux>(flux));
}

bool ConvectionOptions::determines_temperature() const {
  return !coefficient.is_constant() || value_or_nan(coefficient, {0.0, 0.0, 0.0, 0.0, 0.0}) != 0.0;
}

std::shared_ptr<Contribution> ConvectionOptions::make(const std::shared_ptr<const ThermalBodies>& bodies) const {
  return make_surface_heat(bodies, set, std::make_unique<Convection>(coefficient, surroundings));
}

std::shared_ptr<Contribution> RadiationOptions::make(const std::shared_ptr<const ThermalBodies>& bodies) const {
  return make_surface_heat(bodies, set, std::make_unique<Radiation>(emissivity * stefan_boltzmann, surroundings));
}

const Registry<ThermalLoadOptions>& thermal_load_registry() {
  static const Registry<ThermalLoadOptions> registry =
      Registry<ThermalLoadOptions>()
          .add<SurfaceHeatFluxOptions>("heat flux", "a given flux of heat into the body")
          .add<ConvectionOptions>("convection", "heat from surroundings of another temperature")
          .add<RadiationOptions>("radiation", "heat of radiation between the surface and its surroundings");
  return registry;
}

}  // namespace mortise
