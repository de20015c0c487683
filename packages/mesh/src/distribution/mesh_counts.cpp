#include "mortise/mesh/mesh_counts.hpp"

#include <algorithm>

#include "distribution/body_set.hpp"

namespace mortise {

std::vector<MeshCounts> mesh_counts(const std::vector<BodyDescription>& bodies) {
  check_bodies(bodies);
  std::vector<MeshCounts> counts;
  for (const auto& body : bodies) {
    MeshCounts of_body;
    std::visit(
        [&](const auto& complex) {
          of_body.elements = complex.element_count();
          of_body.nodes = complex.node_count();
        },
        complex_of(body));
    of_body.least_nodes_of_element = most_cell_nodes;
    for (const BodyPart& part : parts_of(body)) {
      of_body.least_nodes_of_element = std::min(of_body.least_nodes_of_element, topology(part.shape).nodes);
      of_body.is_solid = topology(part.shape).dimension == body.dimension();
    }
    counts.push_back(of_body);
  }
  return counts;
}

}  // namespace mortise
