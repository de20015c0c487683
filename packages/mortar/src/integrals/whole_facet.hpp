#pragma once
// The weights of a slave facet's nodes over the whole facet in the current configuration, whatever is covered.

#include <Eigen/Core>

#include "mortise/mortar/auxiliary_plane.hpp"
#include "mortise/mortar/mortar_interface.hpp"
#include "mortise/mortar/segment_2d.hpp"

namespace mortise {

/// int N_j, of quadratic facets int Ñ_j, with the measure of the integrals over overlaps.
struct WholeFacet {
  FacetVector weights;    ///< [nodes]
  Eigen::MatrixXd slope;  ///< [nodes x dim nodes] derivatives with respect to the nodes' positions; empty if not asked for
};

/// Of a line, with thickness or 2 pi r.
WholeFacet whole_facet(const LinePoints& x, const InterfaceMeasure& measure, bool derivatives);

/// Of a facet in 3D: areas on its auxiliary plane.
WholeFacet whole_facet(const AuxiliaryPlane& plane, bool derivatives);

}  // namespace mortise
