#include "body_set.hpp"

#include <algorithm>

namespace mortise {

BodySet::BodySet(const std::vector<BodyDescription>& bodies) {
  for (const auto& body : bodies) {
    if (body.shape == CellShape::line2)
      complexes_.emplace_back(body.mesh->build_surface(body.place));
    else
      complexes_.emplace_back(body.mesh->build(body.shape, body.place));
    shapes_.push_back(body.shape);
    first_node_.push_back(first_node_.back() + std::visit([](const auto& complex) { return complex.node_count(); }, complexes_.back()));
    first_element_.push_back(first_element_.back() + std::visit([](const auto& complex) { return complex.element_count(); }, complexes_.back()));
  }
}

int BodySet::body_of_node(GlobalOrdinal node) const {
  return static_cast<int>(std::upper_bound(first_node_.begin(), first_node_.end(), node) - first_node_.begin()) - 1;
}

int BodySet::body_of_element(GlobalOrdinal element) const {
  return static_cast<int>(std::upper_bound(first_element_.begin(), first_element_.end(), element) - first_element_.begin()) - 1;
}

std::array<GlobalOrdinal, 4> BodySet::element_nodes(GlobalOrdinal element) const {
  const int body = body_of_element(element);
  auto nodes = with_complex(body, [&](const auto& complex) { return complex.element_nodes(element - first_element_[body]); });
  for (int a = 0; a < nodes_per_element(body); ++a) nodes[a] += first_node_[body];
  return nodes;
}

}  // namespace mortise
