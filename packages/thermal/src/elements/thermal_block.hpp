#pragma once
// The elements of one body behind one virtual call a block.

#include <array>
#include <functional>
#include <memory>
#include <optional>

#include "mortise/core/error.hpp"
#include "mortise/mesh/field_space.hpp"
#include "mortise/solid/element_loop.hpp"
#include "mortise/solid/element_type.hpp"
#include "mortise/thermal/thermal_properties.hpp"

namespace mortise {

/// Arguments of the loops of a block.
struct ThermalBlockContext {
  const FieldSpace& space;
  const Block& block;
  std::size_t temperature;                  ///< index of the field
  std::optional<std::size_t> displacement;  ///< likewise; none: the model has no displacements
  Kinematics kinematics;
  double thickness;  ///< counts for plane cells
  std::shared_ptr<const ThermalProperties> properties;
  double density;

  bool conducts_by_displacement() const { return displacement && properties->acts_in != ConductivityActsIn::reference; }
};

/// Values on the local dofs of the space.
struct ThermalState {
  double time = 0.0;
  const double* unknowns = nullptr;
  const double* velocity = nullptr;         ///< read by the capacity
  const double* velocity_shares = nullptr;  ///< likewise: factors of the velocity's weight in its Jacobian
  double time_step = 0.0;                   ///< over which the velocity is a change; 0: it is one at a time
};

/// A quadrature point's flux of heat.
struct HeatFluxPoint {
  LocalOrdinal element = 0;  ///< index in the block
  int point = 0;
  double weight = 0.0;           ///< current volume
  std::array<double, 3> flux{};  ///< q = F Q / J
};

/// Residuals go to target.residual, Jacobians to target.matrix: to what is not null. Of sums with a failure nothing is of use.
class ThermalBlock {
 public:
  virtual ~ThermalBlock() = default;
  virtual void add_conduction(const ThermalState& at, const AssemblyTarget& target, std::optional<StepFailure>& failure) const = 0;
  /// @param by_velocity  weight of dr/d(velocity) in the Jacobian
  /// @param by_unknowns  of dr/d(unknowns)
  virtual void add_capacity(const ThermalState& at, double by_velocity, double by_unknowns, const AssemblyTarget& target,
                            std::optional<StepFailure>& failure) const = 0;
  virtual void add_source(const ThermalState& at, const AssemblyTarget& target, std::optional<StepFailure>& failure) const = 0;
  /// Points of the first `count` elements.
  virtual void visit_fluxes(const ThermalState& at, LocalOrdinal count, const std::function<void(const HeatFluxPoint&)>& visit) const = 0;
};

/// Blocks of all cells.
std::unique_ptr<ThermalBlock> make_thermal_block(const ThermalBlockContext& context);
/// Those of the plane, and linear and quadratic ones in space: compiled in a source each.
std::unique_ptr<ThermalBlock> make_plane_block(const ThermalBlockContext& context);
std::unique_ptr<ThermalBlock> make_linear_space_block(const ThermalBlockContext& context);
std::unique_ptr<ThermalBlock> make_quadratic_space_block(const ThermalBlockContext& context);

}  // namespace mortise
