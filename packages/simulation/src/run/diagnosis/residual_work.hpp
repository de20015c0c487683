#pragma once
// Work of a residual on bodies as a whole.

#include <Eigen/Core>

#include "mortise/simulation/model/rigid_modes.hpp"

namespace mortise {

/// Work of nodal forces F on the motions of the bodies, this rank's share. Prescribed rows hold no forces, and are not moved.
/// @param fixed  [owned nodes x dim] 1 where the displacement is prescribed
Eigen::RowVectorXd work_of_residual(const Mesh& mesh, const RigidModes& modes, const NodePlaces& at, const MultiVector& fixed, const Vector& F);

}  // namespace mortise
