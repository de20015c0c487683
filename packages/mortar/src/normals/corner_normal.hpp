#pragma once
// The normal of a convex corner of a slave surface, that of the master which its facets cover.

#include <Eigen/Core>
#include <vector>

namespace mortise {

/// n_j of a corner j and how it turns.
template <int dim>
struct CornerNormal {
  Eigen::Matrix<double, dim, 1> normal;
  Eigen::Matrix<double, dim, dim> of_facing;               ///< dn_j / dm_j
  std::vector<Eigen::Matrix<double, dim, dim>> of_facets;  ///< [facets] dn_j / dn_f
};

/// n_j = m_j / |m_j|, kept near the wedge of the facets' normals [n_1, n_2]. Where m_j leaves the wedge by an angle e, n_j leaves it by
///   e (1 - S(e / 10 degrees - 1)),   S(t) = t^2 (3 - 2 t) on [0, 1], 0 before and 1 behind.
/// Up to 10 degrees it is m_j's direction, from 20 on the normal of the facet at that edge. Thus a facet that lies flat on the master stays at a
/// place where nothing has a kink. And what the master does far off does not push a side along itself.
/// @param facing         m_j, not 0
/// @param before,behind  unit normals of the facet that ends at the corner and of the one that starts there
CornerNormal<2> corner_normal(const Eigen::Vector2d& facing, const Eigen::Vector2d& before, const Eigen::Vector2d& behind);

/// The same in 3D, where the wedge is the convex cone of all the facets' normals. Let p be the unit vector of the cone that is nearest to m_j, o the
/// unit vector across p towards m_j, and e the angle between p and m_j. Then
///   n_j = cos(e') p + sin(e') o,   e' = e (1 - S(e / 10 degrees - 1)).
/// @param facets  unit normals, at least one
CornerNormal<3> corner_normal(const Eigen::Vector3d& facing, const std::vector<Eigen::Vector3d>& facets);

}  // namespace mortise
