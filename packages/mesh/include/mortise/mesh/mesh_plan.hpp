#pragma once
// Distribution of a mesh over many ranks, found on one.

#include <map>
#include <string>
#include <vector>

#include "mortise/mesh/build_mesh.hpp"

namespace mortise {

/// Share of one rank.
struct MeshShare {
  GlobalOrdinal elements = 0, nodes = 0;              ///< owned
  GlobalOrdinal ghost_elements = 0, ghost_nodes = 0;  ///< of other ranks
  GlobalOrdinal node_pairs = 0;                       ///< owned nodes with every node of their elements, themselves included: blocks of the stiffness
  std::map<int, GlobalOrdinal> ghosts_from;           ///< by owner: ghost nodes whose values come from there
};

struct MeshPlan {
  std::vector<int> rank_of_element, owner_of_node;  ///< [elements], [nodes] of all bodies
  std::vector<MeshShare> shares;                    ///< [ranks]
};

/// The result of build_mesh() on so many ranks, by the same choices, on this one: not collective. Takes memory for the whole mesh's graph.
/// @throws InputError as build_mesh(); std::runtime_error if METIS fails
MeshPlan plan_mesh(const std::vector<BodyDescription>& bodies, const std::vector<std::string>& contact_sides, int ranks);

}  // namespace mortise
