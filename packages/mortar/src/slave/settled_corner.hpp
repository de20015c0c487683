#pragma once
// A corner of the slave surface that takes the master's normal: its normal, and what counts of its facets.

#include <algorithm>
#include <vector>

#include "mortise/mortar/mortar_interface.hpp"
#include "normals/nodal_normal.hpp"

namespace mortise {

/// A facet at the corner: where the corner stands on it, its own normal there.
struct CornerSide {
  FacetCoupling* coupling = nullptr;  ///< with `facing`; null: not covered
  Eigen::Index place = 0;
  const NodalNormal* normal = nullptr;
};

/// Result of a corner for its facets: taken from the couplings of all corners before any of these is changed.
struct SettledCorner {
  std::vector<CornerSide> sides;                    ///< in 2D the one that ends at the corner first
  std::vector<double> weight;                       ///< [sides] w_f
  std::vector<Eigen::RowVectorXd> slope_of_weight;  ///< [sides] in `columns`; empty without derivatives
  std::vector<LocalOrdinal> columns;                ///< nodes that the normal and the weights depend on
};

/// Adds the part of a derivative in `from` to that in `columns`, which holds them all.
template <int dim, class Slope, class Part>
void add_columns(const std::vector<LocalOrdinal>& columns, const std::vector<LocalOrdinal>& from, const Part& part, Slope& slope) {
  for (std::size_t c = 0; c < from.size(); ++c) {
    const auto place = std::find(columns.begin(), columns.end(), from[c]) - columns.begin();
    slope.template middleCols<dim>(dim * place) += part.template middleCols<dim>(dim * static_cast<Eigen::Index>(c));
  }
}

/// Sets the weights of the corner's sides and, but on a line of symmetry in 2D, its normal.
/// @param derivatives  whether `slope_of_weight` and the normal's derivative have columns
/// @param moves        whether these are other than 0
/// @param normal       the average of its facets' normals; becomes n_j
/// @return false where nothing is covered: `normal` stays the average
template <int dim>
bool settle(SettledCorner& corner, bool derivatives, bool moves, const NormalStencil& stencil, NodalNormal& normal);

}  // namespace mortise
