#pragma once
// The integrals over the overlap of one slave and one master facet in 3D, and their exact first derivatives.

#include <Eigen/Core>
#include <boost/container/static_vector.hpp>
#include <vector>

#include "mortise/mortar/auxiliary_plane.hpp"
#include "mortise/mortar/convex_clip.hpp"
#include "mortise/mortar/quadratic_facet.hpp"

namespace mortise {

/// A point of integration: where the line across the plane meets both facets.
struct OverlapPoint {
  Eigen::Vector2d xi;   ///< in the slave's reference facet
  Eigen::Vector2d eta;  ///< in the master's reference facet
  double weight = 0.0;  ///< area on the plane
  double height = 0.0;  ///< of the master over the slave along the plane's normal
};

/// Common part of a linear part of a slave facet and one of a master facet on the auxiliary plane. It is a convex polygon, cut into
/// triangles about the mean of its vertices (which is vertex polygon.size(); one triangle stays whole). Each triangle has the points of
/// triangle_points().
struct Overlap3d {
  FacetPart slave_part;                                               ///< of the slave facet
  FacetPart master_part;                                              ///< of the master facet
  ClipPolygon polygon;                                                ///< common part of the two
  boost::container::static_vector<std::array<int, 3>, 16> triangles;  ///< three vertices each
  boost::container::static_vector<OverlapPoint, 12 * 16> points;      ///< triangle by triangle
  double distance = 0.0;                                              ///< least |height|
};

/// The overlaps of all parts. Those are missing where a part of the master does not face the plane (its normal at a corner is nearly along it, or it
/// is folded there). Polygons are those of the linear parts; the points on them, xi and eta and heights, those of the facets themselves.
/// @param slave, master  nodes in the frame of the plane, the slave's seen from above, with normals away from the plane's origin
/// @param overlaps       added to
/// @throws StepFailure (projection) where a facet is so distorted that a point cannot be projected on it
void find_overlaps(const FacetVectors& slave, const FacetVectors& master, std::vector<Overlap3d>& overlaps);

/// int over an overlap, with L = basis N a basis of the slave facet's shape functions, n the number of slave nodes, m of master nodes. Rows:
///   int L_i L_j (i <= j, i first),   int L_i N_l^m (row i m + l),   int L_i g,
///   g = n . (xhat - x) = (n . p) height,   n = sum N_a n_a / |sum N_a n_a|.
struct SegmentIntegrals3d {
  Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, 108, 1> value;  ///< rows as above
  /// With respect to slave positions, nodal normals, master positions (three components each) in the frame of a fixed plane.
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, 108, 72> derivative;
};

/// The integrals over an overlap and, if `derivatives`, their derivatives, into `result`.
/// @param normals  nodal normals of the slave facet in the frame of the plane
/// @param basis    [n x n], held constant in the derivatives
void integrate_segment(const FacetVectors& slave, const FacetVectors& normals, const FacetVectors& master, const Overlap3d& overlap,
                       const Eigen::MatrixXd& basis, bool derivatives, SegmentIntegrals3d& result);

/// True if a linear master facet, in a frame whose third axis runs along the slave's normal, faces it without a fold (see shows_side()).
bool faces(const FacetVectors& master);

/// The xi at which the projection of a facet takes the place s, which lies on the given part of it.
/// @throws StepFailure (projection) where it is so distorted that there is none
Eigen::Vector2d facet_coordinates(const FacetVectors& nodes, const FacetPart& part, const Eigen::Vector2d& s);

/// Third component at xi.
double height_at(const FacetVectors& nodes, const Eigen::Vector2d& xi);

/// Shape functions of a facet.
Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, 8, 1> facet_values(std::size_t nodes, const Eigen::Vector2d& xi);

}  // namespace mortise
