#pragma once
// Slave nodes that are moved onto their masters before anything is computed: without strain.

#include <Eigen/Core>
#include <array>
#include <functional>
#include <map>
#include <vector>

#include "mortise/mesh/mesh.hpp"

namespace mortise {

/// Components and directions of nodes that conditions prescribe.
struct HeldNodes {
  std::vector<std::array<bool, 3>> components;                            ///< [local nodes]
  std::map<LocalOrdinal, std::vector<std::array<double, 3>>> directions;  ///< of inclined supports, by local nodes: unit vectors
};

/// v at a node without its part along what is held of it.
Eigen::Vector3d free_part(const HeldNodes& held, LocalOrdinal node, Eigen::Vector3d v);

/// Result of an adjustment, over all ranks.
struct Adjustment {
  GlobalOrdinal nodes = 0;  ///< that were moved
  double largest = 0.0;     ///< by so much [length]
  double overlap = 0.0;     ///< depth of the overlap of the surfaces before it [length]
};

/// Moves nodes of `slave` along their normals onto `master` where it is no further away than `tolerance`, in front or behind. Nodes stay
/// along what is held of them. Changes the reference positions of the mesh. Collective; the same on any number of ranks.
Adjustment adjust_onto_master(Mesh& mesh, const SideSet& slave, const SideSet& master, double tolerance, const HeldNodes& held);

/// Ghosts get the reference positions that their owners have. Collective.
void share_positions(Mesh& mesh);

}  // namespace mortise
