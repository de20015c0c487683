#pragma once
// Rigid motions that springs and dashpots hold.

#include <Eigen/Core>

#include "mortise/simulation/model/rigid_modes.hpp"
#include "mortise/solid/connectors.hpp"

namespace mortise {

/// gram += (motion of an end relative to the other)^2 for each direction in which a spring or a dashpot acts; of an axial one along its line alone.
/// Collective; a part of the sum over the ranks.
void add_connectors(const Connectors& connectors, const RigidModes& modes, const NodePlaces& at, Eigen::MatrixXd& gram);

}  // namespace mortise
