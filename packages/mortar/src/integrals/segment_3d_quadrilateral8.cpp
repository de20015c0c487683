// Integrals over slave facets that are quadratic quadrilaterals.

#include "integrals/segment_3d_kernel.hpp"

namespace mortise {

template void integrate_slave<Quadrilateral8>(const FacetVectors&, const FacetVectors&, const FacetVectors&, const Overlap3d&, const Eigen::MatrixXd&,
                                              bool, SegmentIntegrals3d&);

}  // namespace mortise
