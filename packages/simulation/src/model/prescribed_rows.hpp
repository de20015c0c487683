#pragma once
// What boundary conditions and reference points hold of rigid motions.

#include <Eigen/Core>

#include "mortise/simulation/model/rigid_modes.hpp"

namespace mortise {

/// The Gram matrix of the motions on what boundary conditions hold:
///   - each prescribed dof adds (motion at the dof)^2;
///   - a set that follows a reference point adds what deviates from the motion that it may share;
///   - a point that turns adds its prescribed rotations.
/// Collective; a part of the sum over the ranks.
/// @param fixed  [owned nodes x dim] 1 where the displacement is prescribed
/// @returns [modes.count() squared]
Eigen::MatrixXd prescribed_gram(const Mesh& mesh, const RigidModes& modes, const NodePlaces& at, const MultiVector& fixed);

}  // namespace mortise
