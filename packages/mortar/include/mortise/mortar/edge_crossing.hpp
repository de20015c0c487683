#pragma once
// Where two edges cross: how deep, and the force of it.

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "mortise/mortar/near_edges.hpp"

namespace mortise {

/// Contact of two wedges whose edges cross.
struct WedgeContact {
  double stiffness = 0.0;  ///< K of F = K g^2 [force / length^2]; 0: the edges do not touch as edges
  double area = 0.0;       ///< of the section of the overlap, over the depth squared
  double sign = 1.0;       ///< of normal = sign * (slave's direction x master's direction), out of the slave
};

/// Of two pieces in their positions. Nothing for edges of which neither side can be out of the other, and for nearly parallel ones.
WedgeContact wedge_contact(const EdgePiece& slave, const EdgePiece& master);

/// An edge as a line of nodes, by their places in a list of positions, with the nodes that tangents are taken between.
struct EdgeLine {
  std::vector<int> nodes;                   ///< two or more
  std::vector<std::array<int, 2>> tangent;  ///< [nodes] of the node before and the node behind; the node itself where the edge ends
};

/// Two edges near one another. K at a point is linear in either coordinate between its values at nodes, the means of the pieces around them.
struct EdgePair {
  EdgeLine slave;             ///< whose direction the normal has
  EdgeLine master;            ///< against it
  Eigen::MatrixXd stiffness;  ///< [slave nodes x master nodes]
  double sign = 1.0;          ///< as in WedgeContact
};

/// Where they cross.
struct EdgeCrossing {
  std::size_t slave = 0;                             ///< first node of the piece of the slave
  std::size_t master = 0;                            ///< first node of the piece of the master
  double s = 0.0;                                    ///< place along the piece of the slave, 0 to 1
  double m = 0.0;                                    ///< place along the piece of the master, 0 to 1
  double gap = 0.0;                                  ///< below 0: depth of the overlap
  double stiffness = 0.0;                            ///< K there
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< out of the slave
  Eigen::Vector3d on_slave;                          ///< x(s)
  Eigen::Vector3d on_master;                         ///< y(m)
};

/// All crossings, along the slave's edge. The tangents t are linear between nodes. The points x(s) and y(m) of a crossing, with w = y - x, fulfil
///   w . t_slave(s) = 0,   w . t_master(m) = 0:
/// the gap's way is across both edges. It is continuous where a crossing goes from a piece to the next, so that each is found once.
std::vector<EdgeCrossing> crossings_of(const EdgePair& pair, const std::vector<Eigen::Vector3d>& positions);

/// The force of a crossing in the rows of 8 nodes, and its derivatives by their positions.
struct CrossingForce {
  std::array<int, 8> nodes{};             ///< places in the list of positions; the same one may stand there twice
  Eigen::Matrix<double, 24, 1> residual;  ///< contribution to f_int - f_ext
  Eigen::Matrix<double, 24, 24> tangent;  ///< d residual / d positions
};

/// F = K g^2 for g < 0, along the normal, on x(s) and y(m). Nothing where the edges are apart.
std::optional<CrossingForce> force_of(const EdgePair& pair, const EdgeCrossing& crossing, const std::vector<Eigen::Vector3d>& positions);

}  // namespace mortise
