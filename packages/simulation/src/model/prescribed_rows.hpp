#pragma once
// Rigid motions that boundary conditions and reference points hold.

#include <Eigen/Core>

#include "mortise/simulation/model/rigid_modes.hpp"
#include "mortise/simulation/model/supports.hpp"

namespace mortise {

/// The Gram matrix of the motions on what boundary conditions hold:
///   - each prescribed dof adds (motion at the dof)^2, each inclined support (motion along its direction)^2;
///   - a set that follows a reference point adds what deviates from the motion that it may share;
///   - a point that turns adds its prescribed rotations;
///   - each tied dof adds (its motion - that of what it is tied to)^2, as if the slave were where the master has it;
///   - springs and dashpots add what add_connectors() says.
/// Collective; a part of the sum over the ranks.
/// @returns [modes.count() squared]
Eigen::MatrixXd prescribed_gram(const FieldSpace& space, const RigidModes& modes, const NodePlaces& at, const Supports& supports);

}  // namespace mortise
