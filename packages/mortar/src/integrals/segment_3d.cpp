#include "mortise/mortar/segment_3d.hpp"

#include "integrals/segment_3d_slaves.hpp"
#include "mortise/shape/quadrilateral4.hpp"
#include "mortise/shape/quadrilateral8.hpp"
#include "mortise/shape/triangle3.hpp"
#include "mortise/shape/triangle6.hpp"

namespace mortise {

void integrate_segment(const FacetVectors& slave, const FacetVectors& normals, const FacetVectors& master, const Overlap3d& overlap,
                       const Eigen::MatrixXd& basis, bool derivatives, SegmentIntegrals3d& result) {
  const auto kernel = slave.size() == 3   ? integrate_slave<Triangle3>
                      : slave.size() == 4 ? integrate_slave<Quadrilateral4>
                      : slave.size() == 6 ? integrate_slave<Triangle6>
                                          : integrate_slave<Quadrilateral8>;
  kernel(slave, normals, master, overlap, basis, derivatives, result);
}

}  // namespace mortise
