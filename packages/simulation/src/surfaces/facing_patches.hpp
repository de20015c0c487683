#pragma once
// Smooth parts of the bodies' surfaces that face one another.

#include <optional>
#include <vector>

#include "surfaces/body_surfaces.hpp"

namespace mortise {

/// A smooth part of a body's surface, over all ranks.
struct SurfacePart {
  int body = 0;
  GlobalOrdinal number = 0;                          ///< of the patch: see patches_of()
  Eigen::Vector3d seed = Eigen::Vector3d::Zero();    ///< the middle of the side that has this number
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  ///< weighted by area
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< mean of the unit normals
  double area = 0.0;                                 ///< in 2D a length
  double shortest = 0.0;                             ///< side of a facet
  double turn = 0.0;                                 ///< 1 - |mean of the unit normals|: 0 of a plane part, the more it is curved the larger
  GlobalOrdinal sides = 0;
};

/// Two parts of different bodies that face one another.
struct FacingParts {
  int first = 0, second = 0;  ///< indices of parts, first < second
  double gap = 0.0;           ///< the smallest that was seen; negative where they overlap
  long probes = 0;            ///< points that see the other part
};

/// A part of another body that stands behind the one that a part sees.
struct HiddenPart {
  int from = 0, hidden = 0;  ///< indices of parts
  double distance = 0.0;     ///< the smallest from a point of `from`, along its normal
};

struct FacingSurfaces {
  std::vector<SurfacePart> parts;   ///< by their numbers
  std::vector<FacingParts> facing;  ///< by their indices
  std::vector<HiddenPart> hidden;   ///< as far as the longest edge of all sides, or the reach
};

/// From points on every side of the bodies' surfaces a line is drawn along the normal, both ways. The first surface that it meets is seen if it is
/// another body's outside, turned towards the point by less than 60 degrees, no further than `reach`. No surface, of the own body neither, may stand
/// between: nothing is seen through a wall.
/// @param bodies  for each body whether it takes part
/// @param angle   [degrees] between sides at the edges of parts
/// @param reach   none: as far as the longest edge of the side that looks
/// Collective; the same on any number of ranks.
FacingSurfaces find_facing_surfaces(const Mesh& mesh, const std::vector<char>& bodies, double angle, std::optional<double> reach);

}  // namespace mortise
