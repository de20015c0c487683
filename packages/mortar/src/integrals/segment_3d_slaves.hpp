#pragma once
// Each shape of slave facets has a source file of its own.

#include "mortise/mortar/segment_3d.hpp"

namespace mortise {

/// integrate_segment() for a slave facet of that shape.
template <class Slave>
void integrate_slave(const FacetVectors& slave, const FacetVectors& normals, const FacetVectors& master, const Overlap3d& overlap,
                     const Eigen::MatrixXd& basis, bool derivatives, SegmentIntegrals3d& result);

}  // namespace mortise
