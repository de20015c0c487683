#pragma once
// Motion of bodies from one configuration to another: as rigid bodies, and the rest.

#include <Eigen/Core>
#include <vector>

#include "mortise/simulation/model/rigid_modes.hpp"
#include "mortise/simulation/model/supports.hpp"

namespace mortise {

/// The motion of the bodies of some modes, and of everything else, between two configurations.
struct BodyMotions {
  /// [modes.count()] in the modes of the second configuration. The rotation is w = 2 tan(a/2) about the axis of the angle a: with it
  /// x' - x = t + w x ((x + x')/2 - middle) is exact for a rigid body.
  Eigen::VectorXd rigid;
  std::vector<Eigen::Vector3d> middle;  ///< [bodies]
  std::vector<double> deformation;      ///< [bodies] largest motion of a node beside the rigid one
  double imposed = 0.0;                 ///< largest motion of a node of the other bodies, and of any along what is prescribed
};

/// Fitted to the nodes of each body, all alike. Collective.
/// @param modes  at `after`
BodyMotions body_motions(const FieldSpace& space, const RigidModes& modes, const NodePlaces& before, const NodePlaces& after,
                         const Supports& supports);

/// t + w x (x - middle) of a rigid motion of bodies()[b], numbers as in BodyMotions::rigid.
Eigen::Vector3d motion_at(const RigidModes& modes, const Eigen::VectorXd& motion, int b, const Eigen::Vector3d& middle, const Eigen::Vector3d& x);

/// The rotation w alone.
Eigen::Vector3d rotation_of(const RigidModes& modes, const Eigen::VectorXd& motion, int b);

/// d += factor times a motion in the numbers of `modes`, at nodes and at what they follow. It is exact for a motion from one configuration to another
/// if the positions are those half way between them. `d` is on the owned dofs.
void move_bodies(const FieldSpace& space, const RigidModes& modes, const Eigen::VectorXd& motion, const std::vector<Eigen::Vector3d>& middle,
                 const NodePlaces& half_way, double factor, Vector& d);

}  // namespace mortise
