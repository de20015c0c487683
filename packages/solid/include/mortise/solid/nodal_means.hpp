#pragma once
// From the quadrature points of elements to nodes.

#include <Eigen/Core>
#include <vector>

#include "mortise/core/types.hpp"
#include "mortise/mesh/mesh.hpp"
#include "mortise/solid/element_type.hpp"

namespace mortise {

/// [nodes x points]: values at the nodes of an element from those at its quadrature points. They are those of the polynomial that fits the points
/// best. Its terms are 1, xi_i on simplices, all products of the 1, xi_i on squares and cubes, those of 1, xi, eta with 1, zeta on wedges. On
/// pyramids they are products of 1, u with 1, v, the coordinates of rays, and the apex gets what the axis has. Points that are too few determine the
/// smallest coefficients about the centroid: one point gives a constant. Constants are exact; so is whatever the polynomials hold.
/// The points are those of the stiffness, see ElementGeometry.
Eigen::MatrixXd extrapolation_to_nodes(CellShape cell, Kinematics kinematics);

/// Values at owned nodes: each is the mean over the elements around the node of what their points, extrapolated, give there. 0 at nodes without
/// elements.
class NodalMeans {
 public:
  /// @param components  number of values at a point
  NodalMeans(RCP<const Mesh> mesh, int components);

  /// Takes a point of an element. All elements around owned nodes have to be visited, ghosts too, and all points of each.
  /// @param extrapolation  [nodes x points] of the block's cells
  /// @param values         [components] at the point
  void add(const Block& block, LocalOrdinal element, int point, const Eigen::MatrixXd& extrapolation, const double* values);

  /// [owned nodes], a column for each component. Collective.
  RCP<MultiVector> result() const;

 private:
  RCP<const Mesh> mesh_;
  int components_;
  std::vector<double> sums_;   ///< [owned nodes x components]
  std::vector<int> elements_;  ///< [owned nodes] number of elements around
};

}  // namespace mortise
