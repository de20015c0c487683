#include "mortise/mesh/mesh_counts.hpp"

#include "body_set.hpp"

namespace mortise {

std::vector<MeshCounts> mesh_counts(const std::vector<BodyDescription>& bodies) {
  check_bodies(bodies);
  std::vector<MeshCounts> counts;
  for (const auto& body : bodies)
    counts.push_back(std::visit(
        [](const auto& complex) {
          return MeshCounts{complex.element_count(), complex.node_count()};
        },
        body.mesh->complex(body.shape, body.place)));
  return counts;
}

}  // namespace mortise
