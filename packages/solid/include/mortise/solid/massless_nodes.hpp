#pragma once
// Removal of the mass of nodes on contact surfaces.

#include <string>
#include <vector>

#include "mortise/core/parameters.hpp"
#include "mortise/core/types.hpp"
#include "mortise/mesh/mesh.hpp"

namespace mortise {

/// Nodes without mass, and whose velocity they have. A contact node with mass must jump in velocity when it closes: contact forces chatter (Khenous,
/// Laborde, Renard 2008; Hager, Hueeber, Wohlmuth 2008). Here v_s = sum_i w_si v_i of interior nodes i of the same body, w_si >= 0, sum_i w_si = 1.
/// The kinetic energy is 1/2 v^T P^T M P v. Total mass stays. Where layers are alike, row sums are in proportion to integral N_s of the face.
struct MasslessNodes {
  std::vector<LocalOrdinal> nodes;  ///< owned nodes without mass, ascending
  /// Owned nodes of the surfaces that keep their mass: no interior node is near, or they follow a point. Bodies that keep theirs are left out.
  std::vector<LocalOrdinal> kept;
  /// [owned nodes squared] P: the identity in rows of nodes with mass, w in rows of those without, whose columns are empty.
  RCP<const Matrix> extension;
};

/// Nodes of side sets of deformable bodies. Interior nodes are those of the elements at s that lie on none of the sets, with weights by inverse
/// distance to the line through s along the surface's normal; on structured layers the node below has weight 1. A node whose elements have no
/// interior node takes the mean of its neighbours. Collective.
/// @param keeps  [mesh.bodies] bodies whose nodes keep their mass
/// @throws InputError on all ranks for a set that does not exist
MasslessNodes massless_nodes(const Mesh& mesh, const std::vector<Located<std::string>>& surfaces, const std::vector<char>& keeps);

}  // namespace mortise
