#pragma once
// Distinction of a corner from facets that stand for an arc.

#include <cmath>

#include "mortise/mortar/line_crossings.hpp"

namespace mortise {

/// Facets that stand for an arc turn by less from one to the next. More takes a corner.
inline constexpr double kink_angle = 30.0 * M_PI / 180.0;

/// The depth of a corner of the master within a slave facet, over the facet's length, up to which the weighted gap stays open where facets stand for
/// an arc. See corner_watch.cpp for the derivation.
inline const double arc_depth = 0.375 * std::tan(0.5 * kink_angle);

/// The unit normal of a facet between its corners, outwards.
Eigen::Vector3d facet_normal(int dimension, const FacetPlaces& x);
Eigen::Vector3d facet_centre(const FacetPlaces& x);

}  // namespace mortise
