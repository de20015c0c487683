#include "model/current_places.hpp"

#include <Tpetra_Import.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_Vector.hpp>

namespace mortise {

PlaceOfNode current_places(const Bodies& bodies, const Vector& displacement) {
  const RCP<Vector> local = rcp(new Vector(bodies.space().local_dofs()));
  local->doImport(displacement, *bodies.space().ghost_import(), Tpetra::INSERT);
  const auto u = local->getLocalViewHost(Tpetra::Access::ReadOnly);
  return [space = bodies.shared_space(), mesh = bodies.mesh(), local, u](LocalOrdinal node) {
    Eigen::Vector3d x(mesh->coordinates[static_cast<std::size_t>(node)].data());
    for (LocalOrdinal i = 0; i < mesh->dimension; ++i) x[i] += u(space->row(node, i), 0);
    return x;
  };
}

PlacedBodies placed_bodies(const Model& model, const Vector& displacement) {
  const Mesh& mesh = *model.mesh();
  const PlaceOfNode at = current_places(*model.bodies(), displacement);
  return {mesh, at, body_boxes(mesh, at), model.size().length, touching_depth * model.size().length};
}

std::vector<char> on_local_nodes(const Mesh& mesh, const Import& to_local, const std::vector<char>& owned) {
  Vector from(mesh.owned_nodes), to(mesh.local_nodes);
  {
    const auto marks = from.getLocalViewHost(Tpetra::Access::ReadWrite);
    for (std::size_t node = 0; node < owned.size(); ++node) marks(node, 0) = owned[node];
  }
  to.doImport(from, to_local, Tpetra::INSERT);
  const auto marks = to.getLocalViewHost(Tpetra::Access::ReadOnly);
  std::vector<char> result;
  for (LocalOrdinal node = 0; node < mesh.local_count(); ++node) result.push_back(marks(node, 0) != 0.0);
  return result;
}

}  // namespace mortise
