#pragma once
// Where straight lines cross oriented surfaces, from whichever side: what tells inside from outside.

#include <Eigen/Core>
#include <array>
#include <boost/container/static_vector.hpp>
#include <limits>
#include <vector>

#include "mortise/core/types.hpp"
#include "mortise/shape/surface_facet.hpp"

namespace mortise {

/// Positions of a facet's nodes, in order; in 2D z = 0.
using FacetPlaces = boost::container::static_vector<Eigen::Vector3d, most_side_nodes>;

/// A facet of this rank, oriented as surface_facet.hpp says. `tag` says to the caller what it belongs to.
struct TaggedFacet {
  FacetPlaces points;  ///< of its nodes
  int tag = 0;         ///< of the caller's choice
};

/// The points x + s d of a line with low <= s <= high, d a unit vector.
struct LineSegment {
  Eigen::Vector3d x;  ///< s = 0
  Eigen::Vector3d d;  ///< unit vector
  double low = 0.0;   ///< least s
  double high = 0.0;  ///< largest s
};

/// Where a line crosses a facet.
struct Crossing {
  double s = 0.0;                                    ///< of the line [length]
  bool leaves = false;                               ///< the line goes along the facet's outward normal, out of the body
  int tag = 0;                                       ///< the facet's
  double along = 0.0;                                ///< the cosine of the angle between the line and the facet's outward normal
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< outward unit normal of the facet there
};

/// Sine of the angle between line and facet below which they are hardly told apart: that of facets that face one another.
inline constexpr double grazing_angle = 0.05;

/// Treatment of facets that a line meets at less than the grazing angle.
enum class Grazing {
  left_out,  ///< the line passes them by
  counted    ///< they are crossed as others are: |along| is below grazing_angle
};

/// The centre of a facet, or of each part of a quadratic one, and points just beside its nodes, with the facet's unit normal there. A line from such
/// a point passes beside the edges that the surfaces of conforming meshes share.
struct SurfacePoint {
  Eigen::Vector3d x;                                 ///< on the facet or just beside a node of it
  Eigen::Vector3d normal;                            ///< outward unit normal of the facet at x
  int node = 0;                                      ///< place of the nearest node among the facet's
  Eigen::Vector3d inward = Eigen::Vector3d::Zero();  ///< unit vector to the centre; 0 at the centre, and where none is known
};

/// None of a facet without area.
std::vector<SurfacePoint> surface_points(int dimension, const FacetPlaces& facet);

/// Collective: for each segment of this rank the crossings with the facets of all ranks, in ascending order of s. Quadratic facets count as curved as
/// they are. Facets travel to the ranks whose box of segments they meet.
std::vector<std::vector<Crossing>> crossings(const Communicator& comm, int dimension, const std::vector<TaggedFacet>& facets,
                                             const std::vector<LineSegment>& segments, Grazing grazing = Grazing::left_out);

/// An axis-parallel box; empty as it is made.
struct Box3 {
  Eigen::Vector3d low = Eigen::Vector3d::Constant(std::numeric_limits<double>::max());    ///< least coordinates
  Eigen::Vector3d high = Eigen::Vector3d::Constant(-std::numeric_limits<double>::max());  ///< largest coordinates

  /// Grows to hold x.
  void enclose(const Eigen::Vector3d& x) { low = low.cwiseMin(x), high = high.cwiseMax(x); }
  bool empty() const { return low[0] > high[0]; }                          ///< true if it holds no point
  double diagonal() const { return empty() ? 0.0 : (high - low).norm(); }  ///< its length; 0 if it is empty
  Box3 widened(double by) const;                                           ///< a box that ends further out by that, on every side
  /// Whether x is in it or on its boundary.
  bool holds(const Eigen::Vector3d& x) const { return (x.array() >= low.array()).all() && (x.array() <= high.array()).all(); }
  /// True if the two have a point in common.
  bool meets(const Box3& other) const { return (low.array() <= other.high.array()).all() && (high.array() >= other.low.array()).all(); }
  /// The part of a segment in the box: false if there is none.
  bool cut(LineSegment& segment) const;
};

/// The boxes of all ranks together. Collective.
std::vector<Box3> boxes_over_ranks(const Communicator& comm, const std::vector<Box3>& mine);

}  // namespace mortise
