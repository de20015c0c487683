#pragma once
// Averaged normals of slave nodes in space.

#include <Eigen/Core>
#include <array>
#include <vector>

#include "mortise/core/types.hpp"

namespace mortise {

/// What shapes the normal of a node in space: the corners of its slave facets, as indices into positions.
struct CornerStencil {
  LocalOrdinal node = 0;
  std::vector<std::array<LocalOrdinal, 2>> corners;  ///< of each facet at the node: the next node around the facet, and the one before
  std::vector<LocalOrdinal> columns;                 ///< the node and those of the corners, without repeats
  std::array<bool, 3> projected{};                   ///< components without a free direction, taken out of the average
};

/// Unit normal of a facet at its corner x: c / |c|, c = (next - x) x (previous - x). |c| must not be zero.
Eigen::Vector3d corner_normal(const Eigen::Vector3d& x, const Eigen::Vector3d& next, const Eigen::Vector3d& previous);

/// Normalised sum of the unit normals of the node's facets at the node, without the `projected` components:  s = P sum_e n_e,  n = s / |s|,
///   dn_e = (I - n_e n_e^T) dc_e / |c_e|,   dn = (I - n n^T) P sum_e dn_e / |s|.
/// Returns false where a corner has no normal or the average does not point out of each facet (then `normal` is not meant to be used).
/// @param derivative  [3 x 3 columns], column 3 c + i for component i of columns[c]; null: not asked for
bool average_normal(const CornerStencil& stencil, const std::vector<Eigen::Vector3d>& x, Eigen::Vector3d& normal,
                    Eigen::Matrix<double, 3, Eigen::Dynamic>* derivative);

}  // namespace mortise
