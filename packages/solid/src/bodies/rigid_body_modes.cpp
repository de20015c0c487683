#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_MultiVector.hpp>

#include "bodies/host_view.hpp"
#include "mortise/solid/bodies.hpp"

namespace mortise {

RCP<MultiVector> current_coordinates(const Bodies& bodies, const Vector& displacement) {
  const Mesh& mesh = *bodies.mesh();
  const int dimension = bodies.dimension();
  auto coordinates = rcp(new MultiVector(mesh.owned_nodes, dimension));
  auto x = coordinates->getLocalViewHost(Tpetra::Access::OverwriteAll);
  const HostReadView u(displacement);
  for (LocalOrdinal node = 0; node < mesh.owned_count(); ++node)
    for (int i = 0; i < dimension; ++i) x(node, i) = mesh.coordinates[node][i] + u.data()[bodies.space().row(node, i)];
  return coordinates;
}

RCP<MultiVector> rigid_body_modes(const Bodies& bodies, const Vector& displacement) {
  const Mesh& mesh = *bodies.mesh();
  const int dimension = bodies.dimension();
  const bool axisymmetric = bodies.kinematics() == Kinematics::axisymmetric;
  auto modes = rcp(new MultiVector(bodies.space().dofs(), axisymmetric ? 1 : dimension == 3 ? 6 : 3));  // starts as zero
  auto mode = modes->getLocalViewHost(Tpetra::Access::ReadWrite);
  const auto coordinates = current_coordinates(bodies, displacement);
  const auto x = coordinates->getLocalViewHost(Tpetra::Access::ReadOnly);
  double sum[4] = {0.0, 0.0, 0.0, static_cast<double>(mesh.owned_count())}, total[4];
  for (LocalOrdinal node = 0; node < mesh.owned_count(); ++node)
    for (int i = 0; i < dimension; ++i) sum[i] += x(node, i);
  Teuchos::reduceAll(*mesh.comm, Teuchos::REDUCE_SUM, 4, sum, total);
  for (LocalOrdinal node = 0; node < mesh.owned_count(); ++node) {
    if (axisymmetric) {
      mode(bodies.space().row(node, 1), 0) = 1.0;
      continue;
    }
    for (int i = 0; i < dimension; ++i) mode(bodies.space().row(node, i), i) = 1.0;
    // Turning about the normal to the directions i and j moves the node by (-x_j, x_i); in 3D about x, y, z.
    const auto turn = [&](int column, int i, int j) {
      mode(bodies.space().row(node, i), column) = -(x(node, j) - total[j] / total[3]);
      mode(bodies.space().row(node, j), column) = x(node, i) - total[i] / total[3];
    };
    if (dimension == 2) {
      turn(2, 0, 1);
    } else {
      turn(3, 1, 2);
      turn(4, 2, 0);
      turn(5, 0, 1);
    }
  }
  return modes;
}

}  // namespace mortise
