#pragma once
// Averaged normals of the slave nodes in 2D.

#include <array>
#include <vector>

#include "mortise/mortar/mortar_interface.hpp"

namespace mortise {

using Positions = std::vector<Eigen::Vector2d>;

/// What shapes the normal of a node: its slave facets, as indices into positions.
struct NormalStencil {
  std::vector<std::array<LocalOrdinal, 2>> facets;
  std::vector<LocalOrdinal> columns;  ///< the facets' nodes without repeats
  std::array<bool, 2> projected{};    ///< components without a free direction, taken out of the average
};

/// n_e = (t_y, -t_x) / |t|, t = x_b - x_a. The length must not be zero.
Eigen::Vector2d facet_normal(const Eigen::Vector2d& a, const Eigen::Vector2d& b);

/// Normalised sum of the unit normals of the node's facets, without the `projected` components:  s = P sum_e n_e,  n = s / |s|,
///   dn_e = R (I - t t^T) dx / |x_b - x_a|,  dn = (I - n n^T) P sum_e dn_e / |s|.
/// Returns false where a facet has no length or the normal does not point out of each of them (then `normal` is not meant to be used).
bool average_normal(const NormalStencil& stencil, const Positions& x, bool derivatives, NodalNormal& normal);

}  // namespace mortise
