#pragma once
// The first stage of a model: the mesh of a scene.

#include <memory>
#include <string>
#include <vector>

#include "model/pairs/adjusted_slaves.hpp"
#include "model/pairs/surface_ties.hpp"
#include "mortise/core/timers.hpp"
#include "mortise/mesh/field_space.hpp"
#include "mortise/mesh/mesh.hpp"
#include "mortise/simulation/model/model.hpp"
#include "mortise/simulation/scene/scene.hpp"

namespace mortise {

/// The mesh, with what is moved on it before anything is computed.
struct MeshedScene {
  RCP<const Mesh> mesh;
  std::shared_ptr<const FieldSpace> space;
  MeshSize size;
  MeshRemarks remarks;
  std::string digest;                   ///< of the mesh before ties adjusted it; empty: that of the mesh as it is
  std::vector<Adjustment> adjustments;  ///< [pairs of the scene]
  SurfaceTies ties;
  std::vector<Place> places;  ///< [bodies of the scene]
};

/// How areas of the scene's surfaces are measured.
InterfaceMeasure measure_of(const Scene& scene);

/// Builds the mesh. Collective. Throws InputError, on all ranks, for what a mesh cannot be made of.
MeshedScene mesh_scene(const RCP<const Communicator>& comm, const Scene& scene, const Timers& timers);

}  // namespace mortise
