#pragma once
// The plane on which a slave facet and its master facets are compared in 3D.

#include <Eigen/Core>
#include <array>
#include <boost/container/static_vector.hpp>
#include <optional>
#include <vector>

namespace mortise {

/// Vectors at the nodes of a triangle or a quadrilateral, linear or quadratic.
using FacetVectors = boost::container::static_vector<Eigen::Vector3d, 8>;

/// The plane across the slave facet's own normal p = c / |c| at its centre. Its direction c is
///   of triangles  c = (x_1 - x_0) x (x_2 - x_0),   of quadrilaterals  c = (x_2 - x_0) x (x_3 - x_1).
/// It depends on the positions of the facet's corners only, and areas on it are those of a flat facet. Everything is projected along p. In its frame
/// (e_1, e_2, p) the first two components of a position are its projection, the third its height.
struct AuxiliaryPlane {
  Eigen::Matrix3d frame;                              ///< rows e_1, e_2, p
  Eigen::Vector3d origin;                             ///< a point of the plane: the centre of the slave facet
  FacetVectors slave;                                 ///< the facet's nodes in the frame: their projections run counterclockwise
  std::array<Eigen::Matrix<double, 2, 3>, 4> tilt{};  ///< of corners: d(e_1 . p, e_2 . p) / dx_a, x_a by its components in the frame

  /// Components of a global position in the frame: the first two are its projection.
  Eigen::Vector3d to_frame(const Eigen::Vector3d& x) const { return frame * (x - origin); }

  /// Turns gradients of an integral I with respect to vectors of a fixed frame into total ones, in the global frame. I does not change when all
  /// positions r, all normals r and the plane turn together by w, and dp = w x p, so
  ///   dI/dp . dp = -sum_r dI/dr . (w x r),   w = p x dp.
  /// @param vectors    what the columns belong to, in the frame: slave positions first, three columns each
  /// @param gradients  [any x 3 vectors.size()]
  void to_global(const std::vector<Eigen::Vector3d>& vectors, Eigen::Ref<Eigen::MatrixXd> gradients) const;
};

/// None if the projection of one of the facet's linear parts has no area, is not convex, or is turned over.
std::optional<AuxiliaryPlane> make_auxiliary_plane(const FacetVectors& slave);

/// True if a linear facet is seen without a fold, from above the plane (side = 1) or from below (side = -1). At every corner its normal, times
/// `side`, must have a component along p of more than `tolerance`. Then its projection is convex.
bool shows_side(const FacetVectors& in_frame, double side, double tolerance);

}  // namespace mortise
