#pragma once
// Mass of rigid bodies, as masses of their nodes.

#include <Eigen/Core>
#include <string>
#include <vector>

#include "mortise/core/parameters.hpp"
#include "mortise/solid/bodies.hpp"

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

/// Masses of nodes with the same mass, centre and second moments: m_i = p(x_i), p the quadratic polynomial with these moments (in 2D of 1, x, y,
/// r^2). As the nodes move like a rigid body, that is the mass of the body; single ones may be negative. Nothing for nodes that do not span the
/// space.
/// @param nodes  of this rank, each on one rank
/// @returns [nodes]. Collective.
std::optional<std::vector<double>> masses_of_nodes(const Mesh& mesh, const std::vector<LocalOrdinal>& nodes, const RigidMass& mass);

}  // namespace mortise
