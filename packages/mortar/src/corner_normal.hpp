#pragma once
// The normal of a convex corner of a slave surface in 2D, that of the master which its two facets cover.

#include <Eigen/Core>

namespace mortise {

/// n_j of a corner j and how it turns.
struct CornerNormal {
  Eigen::Vector2d normal;
  /// The angle of n_j changes by  of_master dmu + of_before dnu_1 + of_behind dnu_2  with those of m_j and of the facets' normals.
  double of_master = 1.0, of_before = 0.0, of_behind = 0.0;
};

/// n_j = m_j / |m_j|, kept near the wedge of the facets' normals [n_1, n_2]: where m_j leaves the wedge by an angle e, n_j leaves it by
///   e (1 - S(e / 10 degrees - 1)),   S(t) = t^2 (3 - 2 t) on [0, 1], 0 before and 1 behind.
/// Up to 10 degrees it is m_j's direction, from 20 on the normal of the facet at that edge: a facet that lies flat on the master stays at a place
/// where nothing has a kink, and what the master does far off does not push a side along itself.
/// @param facing         m_j, not 0
/// @param before,behind  unit normals of the facet that ends at the corner and of the one that starts there
CornerNormal corner_normal(const Eigen::Vector2d& facing, const Eigen::Vector2d& before, const Eigen::Vector2d& behind);

}  // namespace mortise
