#pragma once
// Finds, before anything is solved, the bodies that nothing holds: the rigid modes of all bodies against what the scene holds them with.

#include <array>
#include <string>
#include <vector>

#include "mortise/core/error.hpp"
#include "mortise/mesh/mesh.hpp"
#include "mortise/mortar/mortar_interface.hpp"
#include "mortise/simulation/model/supports.hpp"

namespace mortise {

/// Two surfaces that may touch, as ContactPair holds them.
struct HoldingPair {
  const SurfaceFacets* slave = nullptr;   ///< slave facets with a node owned by this rank
  const SurfaceFacets* master = nullptr;  ///< master facets of this rank
  double reach = 0.0;                     ///< distance within which a slave facet counts; 0: the longest facet of the pair
  bool rubs = false;                      ///< there is friction
};

/// Collective. Each body may move by its rigid modes q:
///   - plane: two translations and the rotation about its centre, over its size;
///   - axisymmetric: the translation along the axis;
///   - 3D: three of each.
/// The Gram matrix of q adds up what holds a motion:
///   - every prescribed dof adds (mode at the dof)^2, every inclined support (mode along its direction)^2;
///   - a set that follows a reference point adds what deviates from the motion that it may share;
///   - every tied dof adds (mode - modes of what it is tied to)^2;
///   - every spring, and in statics every dashpot, adds (its elongation in a motion)^2;
///   - every corner of a slave facet in reach of its master adds (n . (mode_slave - mode_master))^2, with friction |mode_slave - mode_master|^2.
/// A null vector of the matrix is a motion that nothing holds.
/// @param body_places  where the scene gives each body (mesh.bodies order)
/// @param may_move     motions that nothing holds are allowed
/// @returns for each body (mesh.bodies order) whether only contact holds it, or those that it is tied to, or nothing
/// @throws InputError naming body and mode for each motion that nothing holds
std::vector<char> check_held(const FieldSpace& space, bool axisymmetric, const Supports& supports, const std::vector<HoldingPair>& pairs,
                             const std::vector<Place>& body_places, bool may_move = false);

}  // namespace mortise
