#include "body_set.hpp"

#include "interval.hpp"

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

int BodySet::body_of_node(GlobalOrdinal node) const { return interval(first_node_, node); }

int BodySet::body_of_element(GlobalOrdinal element) const { return interval(first_element_, element); }

std::array<GlobalOrdinal, 4> BodySet::element_nodes(GlobalOrdinal element) const {
  const int body = body_of_element(element);
  auto nodes = with_complex(body, [&](const auto& complex) { return complex.element_nodes(element - first_element_[body]); });
  for (int a = 0; a < nodes_per_element(body); ++a) nodes[a] += first_node_[body];
  return nodes;
}

}  // namespace mortise
