#pragma once
// Slave nodes that are moved onto their masters before anything is computed: without strain.

#include <array>
#include <functional>
#include <vector>

#include "mortise/mesh/mesh.hpp"

namespace mortise {

/// What an adjustment did, over all ranks.
struct Adjustment {
  GlobalOrdinal nodes = 0;  ///< that were moved
  double largest = 0.0;     ///< by so much [length]
};

/// Moves nodes of `slave` along their normals onto `master` where it is no further away than `tolerance`, in front or behind. Components of a node
/// for which `held` is true stay. Changes the reference positions of the mesh. Collective; the same on any number of ranks.
Adjustment adjust_onto_master(Mesh& mesh, const SideSet& slave, const SideSet& master, double tolerance,
                              const std::vector<std::array<bool, 3>>& held);

/// Ghosts get the reference positions that their owners have. Collective.
void share_positions(Mesh& mesh);

}  // namespace mortise
