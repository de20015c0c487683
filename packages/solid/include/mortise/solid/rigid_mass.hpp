#pragma once
// Mass of rigid bodies, as a mass matrix on some of their nodes.

#include <Eigen/Core>
#include <string>
#include <vector>

#include "mortise/core/parameters.hpp"
#include "mortise/solid/bodies.hpp"
#include "mortise/solid/nodal_mass.hpp"

namespace mortise {

/// Mass, centre and second moments E = integral of (x - c)(x - c)^T dm of a rigid body; its tensor of inertia is tr(E) I - E.
struct RigidMass {
  double mass = 0.0;
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  Eigen::Matrix3d second_moments = Eigen::Matrix3d::Zero();
};

/// From principal moments of inertia about the centre along x, y, z; in 2D the third one alone counts.
RigidMass rigid_mass(double mass, const Eigen::Vector3d& centre, const Eigen::Vector3d& moments_of_inertia);

/// Of a homogeneous body within a closed surface, by the divergence theorem; in 2D with the thickness of the bodies. Collective.
/// @throws InputError on all ranks for a surface that is not closed
RigidMass mass_within(const Bodies& bodies, const Located<std::string>& surface, double density);

/// A mass matrix on a few nodes, for each direction alike.
struct MassBlock {
  std::vector<GlobalOrdinal> nodes;
  Eigen::MatrixXd mass;  ///< [nodes x nodes], symmetric, no eigenvalue below 0
};

/// The mass of a rigid body on nodes that move with it. Points of the body are affine in the nodes that span it. Let P = [1; x_i] and
/// Q = [m, m c^T; m c, E + m c c^T]. Then M with P M P^T = Q has the body's mass, centre and second moments (in 2D of E the trace alone counts).
/// Nothing for nodes that do not span the space in which the body has extent. Collective.
/// @param nodes  of this rank, each on one rank; those furthest apart are taken
std::optional<MassBlock> mass_on_nodes(const Mesh& mesh, const std::vector<LocalOrdinal>& nodes, const RigidMass& mass);
/// Adds the rows of the nodes that this rank owns.
void add_block(const Mesh& mesh, const MassBlock& block, MassRows& rows);

}  // namespace mortise
