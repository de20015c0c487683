// Integrals over slave facets that are bilinear quadrilaterals.

#include "integrals/segment_3d_kernel.hpp"

namespace mortise {

template void integrate_slave<Quadrilateral4>(const FacetVectors&, const FacetVectors&, const FacetVectors&, const Overlap3d&, const Eigen::MatrixXd&,
                                              bool, SegmentIntegrals3d&);

}  // namespace mortise
