#pragma once
// Reference points: nodes beyond those of the bodies, whose motion sets of nodes follow.

#include <array>
#include <optional>
#include <string>

#include "mortise/core/parameters.hpp"
#include "mortise/mesh/mesh.hpp"

namespace mortise {

/// A reference point that a mesh gets besides its bodies.
struct ReferencePointDescription {
  std::string name;  ///< of its node set
  Place place;
  bool rotates = true;
  std::optional<std::array<double, 3>> position;  ///< no value: the middle of the box around its followers
};

/// Makes the nodes of a set followers of reference point `point`, in the components of `follows`, and places the point. Collective.
/// @throws InputError on all ranks: no such set, a node that follows another point already
void add_followers(Mesh& mesh, std::size_t point, const Located<std::string>& set, const std::array<bool, 3>& follows);

/// The reference point of that name, which has to rotate; else InputError at the name's place.
const ReferencePoint& require_rotating_point(const Mesh& mesh, const Located<std::string>& name);

}  // namespace mortise
