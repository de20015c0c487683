#pragma once
// Area and normals of the master that a slave facet in 2D faces.

#include <Eigen/Core>
#include <vector>

#include "mortise/mortar/segment_2d.hpp"

namespace mortise {

/// m_j = -int N_j <-n.n_m> n_m over an overlap, with the unit normals n of the slave facet and n_m of the master. On quadratic slave facets Ñ_j takes
/// the place of N_j. N_j <-n.n_m> is the length that the master sees of the facet.
struct FacingIntegrals {
  Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, 6, 1> value;  ///< component i of m_j in row 2 j + i
  /// With respect to slave positions, nodal normals, master positions (two components each).
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, 6, 18> derivative;
};

/// @param rule  quadrature on [-1, 1], mapped to the overlap
/// @throws StepFailure as project_onto()
void integrate_facing(const SlaveCurve& slave, const LinePoints& master, const Overlap& overlap, const InterfaceMeasure& measure,
                      const std::vector<LinePoint>& rule, bool derivatives, FacingIntegrals& result);

}  // namespace mortise
