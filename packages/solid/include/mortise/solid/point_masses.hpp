#pragma once
// Masses at nodes, reference points and sets.

#include <string>
#include <vector>

#include "mortise/core/parameters.hpp"
#include "mortise/solid/bodies.hpp"

namespace mortise {

/// A mass at a reference point, or spread over a set.
struct PointMassOptions {
  Located<std::string> set;                ///< nodes or sides, or a reference point
  double mass = 0.0;                       ///< of the whole set
  std::vector<double> moments_of_inertia;  ///< of a reference point that rotates, about it: in 2D one, in 3D about x, y, z at the start; empty: 0
  void describe(Parameters& parameters);
};

/// Masses as a matrix of nodes, [owned nodes squared]. With A the area of a set of sides, m integral N_a N_b / A dGamma; m/n at each of n nodes. A
/// moment of inertia J in 2D is J / arm^2 at the rotation node, whose dof is arm * theta. In 3D it is in masses of the nodes that follow the point,
/// with the sum 0: they turn with it, so that no gyroscopic terms are written. Collective.
/// @throws InputError on all ranks for sets that do not exist, points that do not rotate, moments that no body has
RCP<const Matrix> matrix_of_point_masses(const Bodies& bodies, const std::vector<Named<PointMassOptions>>& masses);

/// [owned nodes] sums of the rows of a matrix of nodes, 0 at rotation nodes: what has weight.
std::vector<double> weighing_masses(const Mesh& mesh, const Matrix& of_nodes);

}  // namespace mortise
