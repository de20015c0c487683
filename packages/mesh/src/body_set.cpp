#include "body_set.hpp"

#include "interval.hpp"

namespace mortise {
namespace {

SpatialPoint in_space(const Point& point) { return {point[0], point[1], 0.0}; }
SpatialPoint in_space(const SpatialPoint& point) { return point; }

}  // namespace

BodySet::BodySet(const std::vector<BodyDescription>& bodies) {
  for (const auto& body : bodies) {
    dimension_ = body.mesh->dimension();
    complexes_.push_back(body.mesh->complex(body.shape, body.place));
    shapes_.push_back(body.shape);
    first_node_.push_back(first_node_.back() + std::visit([](const auto& complex) { return complex.node_count(); }, complexes_.back()));
    first_element_.push_back(first_element_.back() + std::visit([](const auto& complex) { return complex.element_count(); }, complexes_.back()));
  }
}

int BodySet::body_of_node(GlobalOrdinal node) const { return interval(first_node_, node); }

int BodySet::body_of_element(GlobalOrdinal element) const { return interval(first_element_, element); }

CellNodes BodySet::element_nodes(GlobalOrdinal element) const {
  const int body = body_of_element(element);
  auto nodes = with_complex(body, [&](const auto& complex) { return complex.element_nodes(element - first_element_[body]); });
  for (GlobalOrdinal& node : nodes) node += first_node_[body];
  return nodes;
}

SpatialPoint BodySet::coordinate(GlobalOrdinal node) const {
  const int body = body_of_node(node);
  return with_complex(body, [&](const auto& complex) { return in_space(complex.coordinate(node - first_node_[body])); });
}

}  // namespace mortise
