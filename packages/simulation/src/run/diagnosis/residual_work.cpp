#include "run/diagnosis/residual_work.hpp"

#include <Tpetra_MultiVector.hpp>
#include <Tpetra_Vector.hpp>

namespace mortise {

Eigen::RowVectorXd work_of_residual(const Mesh& mesh, const RigidModes& modes, const NodePlaces& at, const MultiVector& fixed, const Vector& F) {
  const auto forces = F.getLocalViewHost(Tpetra::Access::ReadOnly);
  const auto prescribed = fixed.getLocalViewHost(Tpetra::Access::ReadOnly);
  Eigen::RowVectorXd work = Eigen::RowVectorXd::Zero(modes.count());
  for (LocalOrdinal node = 0; node < mesh.owned_count(); ++node) {
    Eigen::Vector3d force = Eigen::Vector3d::Zero();
    for (int i = 0; i < mesh.dimension; ++i)
      if (prescribed(node, i) == 0.0) force[i] = forces(mesh.dimension * node + i, 0);
    modes.add(mesh.body_of_node[node], at.x[node], force, work);
  }
  return work;
}

}  // namespace mortise
