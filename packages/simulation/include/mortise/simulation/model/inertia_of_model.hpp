#pragma once
// Mass of a model.

#include <memory>
#include <vector>

#include "mortise/solid/massless_nodes.hpp"
#include "mortise/solid/nodal_mass.hpp"

namespace mortise {

/// Mass of all bodies of a scene with inertia.
struct InertiaOfModel {
  std::shared_ptr<const NodalMass> mass;  ///< null: the scene has no inertia
  RCP<const Matrix> stiffness_damping;    ///< b K_0 [owned dofs squared]; null: none
  MasslessNodes massless;                 ///< of contact surfaces; without an extension where all nodes keep their mass
  GlobalOrdinal without_mass = 0;         ///< nodes, over all ranks
  GlobalOrdinal kept = 0;                 ///< nodes of contact surfaces that keep their mass, over all ranks
  double centre_shift = 0.0;              ///< [length] largest motion of a body's centre of mass by what contact nodes gave away
};

}  // namespace mortise
