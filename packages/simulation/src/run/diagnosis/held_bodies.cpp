#include "run/diagnosis/held_bodies.hpp"

#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_Vector.hpp>

namespace mortise {

std::vector<int> bodies_held_by_contact_only(const Model& model) {
  const Mesh& mesh = *model.mesh();
  std::vector<int> mine(mesh.bodies.size(), 0), all(mine.size());
  for (LocalOrdinal node = 0; node < mesh.owned_count(); ++node)
    if (model.held_by_contact_only()[node]) mine[mesh.body_of_node[node]] = 1;
  Teuchos::reduceAll(*mesh.comm, Teuchos::REDUCE_MAX, static_cast<int>(mine.size()), mine.data(), all.data());
  std::vector<int> bodies;
  for (std::size_t body = 0; body < all.size(); ++body)
    if (all[body]) bodies.push_back(static_cast<int>(body));
  return bodies;
}

NodePlaces places_at(const Model& model, const Vector& x) { return node_places(*model.mesh(), x.offsetView(model.parts().dofs, 0).get()); }

}  // namespace mortise
