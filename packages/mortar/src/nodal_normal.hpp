#pragma once
// Averaged normals of the slave nodes.

#include <array>
#include <vector>

#include "facet_geometry.hpp"
#include "mortise/mortar/mortar_interface.hpp"

namespace mortise {

/// What shapes the normal of a node: its slave facets, as indices into positions.
struct NormalStencil {
  LocalOrdinal node = 0;
  /// Of each facet, in the plane: its first and its second node; in space: the next node around the facet, and the one before.
  std::vector<std::array<LocalOrdinal, 2>> corners;
  std::vector<LocalOrdinal> columns;  ///< the node and those of the corners, without repeats
  std::array<bool, 3> projected{};    ///< components without a free direction, taken out of the average
};

/// n_e = (t_y, -t_x) / |t|, t = x_b - x_a. The length must not be zero.
Eigen::Vector2d facet_normal(const Eigen::Vector2d& a, const Eigen::Vector2d& b);

/// Unit normal of a facet at its corner x: c / |c|, c = (next - x) x (previous - x). |c| must not be zero.
Eigen::Vector3d corner_normal(const Eigen::Vector3d& x, const Eigen::Vector3d& next, const Eigen::Vector3d& previous);

/// Normalised sum of the unit normals of the node's facets at the node, without the `projected` components:  s = P sum_e n_e,  n = s / |s|,
///   dn = (I - n n^T) P sum_e dn_e / |s|,
///   dn_e = R (I - t t^T) dx / |x_b - x_a| in the plane,   dn_e = (I - n_e n_e^T) dc / |c| in space.
/// Returns false where a facet has no normal or the average does not point out of each of them (then `normal` is not meant to be used).
bool average_normal(const NormalStencil& stencil, const Positions<2>& x, bool derivatives, NodalNormal& result);
bool average_normal(const NormalStencil& stencil, const Positions<3>& x, bool derivatives, NodalNormal& result);

}  // namespace mortise
