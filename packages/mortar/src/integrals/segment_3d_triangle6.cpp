// Integrals over slave facets that are quadratic triangles.

#include "integrals/segment_3d_kernel.hpp"

namespace mortise {

template void integrate_slave<Triangle6>(const FacetVectors&, const FacetVectors&, const FacetVectors&, const Overlap3d&, const Eigen::MatrixXd&,
                                         bool, SegmentIntegrals3d&);

}  // namespace mortise
