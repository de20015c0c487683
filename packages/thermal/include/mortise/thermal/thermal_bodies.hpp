#pragma once
// Bodies with a temperature: their properties on a mesh, their fluxes of heat.

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "mortise/core/error.hpp"
#include "mortise/core/types.hpp"
#include "mortise/mesh/field_space.hpp"
#include "mortise/solid/element_type.hpp"
#include "mortise/thermal/thermal_properties.hpp"

namespace mortise {

class ThermalBlock;

/// Composition of one body, for heat. The body's mesh is the block of the same index.
struct ThermalBody {
  Place place;                                          ///< of its properties, for errors
  std::shared_ptr<const ThermalProperties> properties;  ///< null: it has no temperature
  double density = 0.0;                                 ///< rho0, mass per reference volume; counts with a specific heat
};

/// All bodies of a model, as conduction of heat sees them. A value that contributions and loads share.
///
/// The equation of heat, by weak form on the reference configuration, of which each contribution has a summand:
///   integral of (N rho0 c dtheta/dt - Grad N . Q - N R) dV0 - integral of N q dA0 = 0.
class ThermalBodies {
 public:
  /// @param space      has the field "temperature" of one component, on the nodes of all bodies with a temperature, and maybe "displacement"
  /// @param thickness  [length] counts for the plane kinematics
  /// @param bodies     an entry for each block of the mesh, in its order
  /// Collective. Throws InputError on all ranks for
  ///   - properties without meaning (ThermalProperties::fault());
  ///   - a lumped capacity of quadratic cells;
  ///   - a specific heat without a density above 0.
  /// Throws std::logic_error for fields, cells or bodies that do not fit to one another.
  ThermalBodies(std::shared_ptr<const FieldSpace> space, Kinematics kinematics, double thickness, std::vector<ThermalBody> bodies);
  ~ThermalBodies();
  ThermalBodies(const ThermalBodies&) = delete;
  ThermalBodies& operator=(const ThermalBodies&) = delete;

  const RCP<const Mesh>& mesh() const { return space_->mesh(); }
  Kinematics kinematics() const { return kinematics_; }
  double thickness() const { return thickness_; }
  const std::vector<ThermalBody>& bodies() const { return bodies_; }  ///< [blocks]
  const FieldSpace& space() const { return *space_; }
  const std::shared_ptr<const FieldSpace>& shared_space() const { return space_; }
  std::size_t temperature() const { return temperature_; }                   ///< index of the field in the space
  std::optional<std::size_t> displacement() const { return displacement_; }  ///< likewise; none: the model has no displacements

  bool conducts_by_displacement() const;  ///< Q of any body depends on F
  bool has_capacity() const;              ///< any body stores heat
  bool has_source() const;                ///< any body has a source

  /// Flux of heat per current area, q = F Q / J, of each owned element of a block: the mean over its current volume. Components x, y, z, axisymmetric
  /// r, z. Without displacements F = I. 0 in bodies without a temperature; NaN where the conductivity has no value.
  /// @param local_unknowns  on the local dofs of the space
  std::vector<std::array<double, 3>> element_heat_fluxes(const Vector& local_unknowns, LocalOrdinal block) const;

  /// The same at owned nodes, by NodalMeans: a column for each direction of the mesh on mesh()->owned_nodes. Collective.
  RCP<MultiVector> nodal_heat_fluxes(const Vector& local_unknowns) const;

  /// [blocks] Loops over elements, for the contributions; null: the body has no temperature.
  const std::vector<std::unique_ptr<ThermalBlock>>& blocks() const { return blocks_; }

 private:
  std::shared_ptr<const FieldSpace> space_;
  Kinematics kinematics_;
  double thickness_;
  std::vector<ThermalBody> bodies_;
  std::size_t temperature_ = 0;
  std::optional<std::size_t> displacement_;
  std::vector<std::unique_ptr<ThermalBlock>> blocks_;
};

}  // namespace mortise
