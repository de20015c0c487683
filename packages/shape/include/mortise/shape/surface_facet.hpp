#pragma once
// A facet of a surface by the ids of its nodes.

#include <boost/container/static_vector.hpp>
#include <vector>

#include "mortise/core/types.hpp"

namespace mortise {

/// Highest number of nodes of a side of a cell.
inline constexpr int most_side_nodes = 8;

/// Nodes of a facet, in the order of its shape. In 2D it is a line of 2 (or 3) nodes with the outward normal on the right of the direction of travel,
/// n = (t_y, -t_x). In 3D it is a triangle of 3 (or 6) or a quadrilateral of 4 (or 8) nodes whose corners run counterclockwise seen from outside.
template <class Ordinal>
using Facet = boost::container::static_vector<Ordinal, most_side_nodes>;

using SurfaceFacet = Facet<GlobalOrdinal>;
using SurfaceFacets = std::vector<SurfaceFacet>;

}  // namespace mortise
