#pragma once
// Depth of points of one body's surface within another body.

#include <optional>
#include <vector>

#include "surfaces/body_surfaces.hpp"

namespace mortise {

/// Tags of the facets that a line from a probe is compared with.
struct SurfaceTags {
  static constexpr int own = 0;    ///< of the probe's body
  static constexpr int front = 1;  ///< of the other body: the set that may touch
  static constexpr int rest = 2;   ///< of the other body: elsewhere
};

/// Two bodies, seen from one of them.
struct BodiesToCompare {
  const Communicator& comm;
  int dimension;
  const std::vector<TaggedFacet>&own, &other;
  Box3 own_box, other_box;
  bool other_is_rigid = false;  ///< a surface with a solid side: it ends nowhere behind
  double touching = 0.0;        ///< shorter depths are none
};

/// Finding of the line from a probe against its normal, through its own body, about the other one.
struct Penetration {
  enum class Kind {
    none,
    overlap,    ///< out of the other body's front before the own body ends: the front pushes the probe out by `depth`
    swallowed,  ///< within the other body, and no front of it lies within the own body
    pierced     ///< in front of a rigid surface that lies within the own body
  };
  Kind kind = Kind::none;
  /// Distance to the plane of the facet by which the line leaves the other body; pierced: from the surface against its normal to the end of the own
  /// body.
  double depth = 0.0;
};

/// True if the line from a probe meets the other body's box, so that penetrations() looks at it.
bool may_penetrate(const SurfacePoint& point, const Box3& own_box, const Box3& other_box, bool other_is_rigid, double touching);

/// For each probe. Collective. Only probes whose line meets the other body's box cost anything. A line that meets a facet at a grazing angle on its
/// way, as lines that run within a face, finds nothing.
std::vector<Penetration> penetrations(const BodiesToCompare& bodies, const std::vector<SurfaceProbe>& probes);

/// The deepest overlap over all ranks, the same on each.
struct DeepestPoint {
  double depth = 0.0;  ///< 0: none
  GlobalOrdinal node = 0;
  Eigen::Vector3d place = Eigen::Vector3d::Zero();   ///< of the node
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< of the surface there
};

/// Of the given depths [probes] the largest above 0; of equal ones that of the least node. Collective.
DeepestPoint deepest_point(const Mesh& mesh, const PlaceOfNode& at, const std::vector<SurfaceProbe>& probes, const std::vector<double>& depths);

}  // namespace mortise
