#pragma once
// Surfaces that the scene glues together.

#include <array>
#include <memory>
#include <vector>

#include "mortise/mesh/mesh.hpp"
#include "mortise/mortar/tied_surfaces.hpp"
#include "mortise/nonlinear/affine_constraints.hpp"
#include "mortise/simulation/model/model.hpp"
#include "mortise/simulation/scene/scene.hpp"
#include "surfaces/adjustment.hpp"

namespace mortise {

struct MeshedScene;

/// The ties of a scene.
struct SurfaceTies {
  std::shared_ptr<const TieRows> tied;  ///< null: the scene has none
  std::vector<TieAtStart> at_start;     ///< [ties of the scene]
};

/// Ties surfaces, and moves the slave nodes of ties that ask for it. They go first along their normals onto the master, then to X_s = P X_m with the
/// P of the tie. The mesh has all its sets and reference points. Collective.
/// @param held    what conditions prescribe
/// @param origin  from where positions are measured
/// @throws InputError at the ties' places for unknown sets, and as tie_surfaces()
SurfaceTies tie_scene(Mesh& mesh, const FieldSpace& space, const Scene& scene, const HeldNodes& held, const InterfaceMeasure& measure,
                      const std::array<double, 3>& origin);

/// Rows of ties of temperatures, in the component 0 of the displacement's; null: none conducts. A tie conducts if all nodes of both surfaces have a
/// temperature. Its slave nodes whose temperature is prescribed are not tied. Collective.
/// @param rows  of the temperature
/// @param held  [owned nodes] whether the temperature is prescribed, or there is none
/// @throws InputError as tie_surfaces()
std::shared_ptr<const TieRows> tie_temperatures(const MeshedScene& meshed, const Scene& scene, const FieldRows& rows, const std::vector<char>& held);

/// [mesh.bodies] a number that bodies share which ties join. Collective.
std::vector<int> joined_bodies(const Mesh& mesh, const Scene& scene);

/// [owned nodes] 1 where a dependent unknown of any rank follows the node. Collective.
std::vector<char> followed_by_dependents(const FieldSpace& space, const AffineConstraints& constraints);

}  // namespace mortise
