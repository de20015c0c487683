#pragma once
// Sides of the master that leave a slave facet to another side at a convex corner between the two (2D).

#include <vector>

#include "geometry/facet_geometry.hpp"
#include "search/surface_search.hpp"

namespace mortise {

/// Master facets that leave a slave facet to a side beyond a convex corner that faces it better, by its chord.
/// @param slave    slave facet at whose ends the surface goes on smoothly (local nodes)
/// @param masters  those that are near
std::vector<char> yielding_facets(const Facet<LocalOrdinal>& slave, const std::vector<Facet<LocalOrdinal>>& masters, const Positions<2>& x);

/// True if some of these master facets may yield after facets have turned by up to `turn` (radian) against one another: they have a corner.
bool any_may_yield(const std::vector<PlacedFacet<2>>& masters, double turn);

}  // namespace mortise
