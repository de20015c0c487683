#pragma once
// Area and normals of the master that a slave facet in 3D faces.

#include <Eigen/Core>

#include "mortise/mortar/segment_3d.hpp"

namespace mortise {

/// m_j = -int N_j <-p.n_m> n_m over an overlap, with the normal p of the slave facet's plane and the unit normals n_m of the master. On quadratic
/// slave facets Ñ_j takes the place of N_j. In the frame of the plane, over which the master stands at the height z(s),
///   n_m = (z', -1) / (1 + z'^2)^(1/2),   -<-p.n_m> n_m = (-z', 1) / (1 + z'^2).
struct FacingIntegrals3d {
  Eigen::VectorXd value;  ///< component i of m_j, in the frame, in row 3 j + i
  /// With respect to slave positions and master positions (three components each) in the frame of a fixed plane.
  Eigen::MatrixXd derivative;
};

/// @param slave, master  nodes in the frame of the plane
void integrate_facing(const FacetVectors& slave, const FacetVectors& master, const Overlap3d& overlap, bool derivatives, FacingIntegrals3d& result);

}  // namespace mortise
