#pragma once
// Where a line crosses a quadratic facet.

#include <vector>

#include "mortise/mortar/line_crossings.hpp"

namespace mortise {

/// Adds the crossings of a line with a facet as curved as it is; those at an angle with a sine below `least` are passed by.
void cross_curved(int dimension, const LineSegment& line, const FacetPlaces& facet, int tag, double least, std::vector<Crossing>& found);

}  // namespace mortise
