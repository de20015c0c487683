#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_MultiVector.hpp>

#include "host_view.hpp"
#include "mortise/solid/bodies.hpp"

namespace mortise {

RCP<MultiVector> current_coordinates(const Bodies& bodies, const Vector& displacement) {
  const Mesh& mesh = *bodies.mesh();
  auto coordinates = rcp(new MultiVector(mesh.owned_nodes, 2));
  auto x = coordinates->getLocalViewHost(Tpetra::Access::OverwriteAll);
  const HostReadView u(displacement);
  for (LocalOrdinal node = 0; node < mesh.owned_count(); ++node)
    for (int i = 0; i < 2; ++i) x(node, i) = mesh.coordinates[node][i] + u.data()[2 * node + i];
  return coordinates;
}

RCP<MultiVector> rigid_body_modes(const Bodies& bodies, const Vector& displacement) {
  const Mesh& mesh = *bodies.mesh();
  const bool axisymmetric = bodies.kinematics() == Kinematics::axisymmetric;
  auto modes = rcp(new MultiVector(bodies.dofs(), axisymmetric ? 1 : 3));  // starts as zero
  auto mode = modes->getLocalViewHost(Tpetra::Access::ReadWrite);
  const auto coordinates = current_coordinates(bodies, displacement);
  const auto x = coordinates->getLocalViewHost(Tpetra::Access::ReadOnly);
  double sum[3] = {0.0, 0.0, static_cast<double>(mesh.owned_count())}, total[3];
  for (LocalOrdinal node = 0; node < mesh.owned_count(); ++node)
    for (int i = 0; i < 2; ++i) sum[i] += x(node, i);
  Teuchos::reduceAll(*mesh.comm, Teuchos::REDUCE_SUM, 3, sum, total);
  for (LocalOrdinal node = 0; node < mesh.owned_count(); ++node) {
    if (axisymmetric) {
      mode(2 * node + 1, 0) = 1.0;
      continue;
    }
    mode(2 * node, 0) = 1.0;
    mode(2 * node + 1, 1) = 1.0;
    mode(2 * node, 2) = -(x(node, 1) - total[1] / total[2]);
    mode(2 * node + 1, 2) = x(node, 0) - total[0] / total[2];
  }
  return modes;
}

}  // namespace mortise
