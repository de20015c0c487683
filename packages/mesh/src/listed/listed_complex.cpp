#include "mortise/mesh/listed_complex.hpp"

namespace mortise {

GlobalOrdinal ListedBody::elements() const {
  GlobalOrdinal count = 0;
  for (const BodyPart& part : parts) count += part.elements;
  return count;
}

SpatialPoint ListedComplex::coordinate(GlobalOrdinal node) const {
  const double* x = body_->coordinates.row(node).first;
  return {x[0], x[1], x[2]};
}

CellNodes ListedComplex::element_nodes(GlobalOrdinal element) const {
  CellNodes nodes;
  for (const std::int32_t node : body_->element_nodes.row(element)) nodes.push_back(node);
  return nodes;
}

std::vector<GlobalOrdinal> ListedComplex::elements_of_node(GlobalOrdinal node) const {
  const auto row = body_->elements_of_node.row(node);
  return {row.begin(), row.end()};
}

std::vector<SurfaceSide> ListedComplex::surface_sides(GlobalOrdinal element) const {
  const auto row = body_->surface_sides.row(element);
  std::vector<SurfaceSide> sides;
  for (const std::int32_t* entry = row.begin(); entry != row.end(); entry += 2) sides.push_back({entry[0], entry[1]});
  return sides;
}

std::vector<int> ListedComplex::sides_of_node(GlobalOrdinal node) const {
  const auto row = body_->sides_of_node.row(node);
  return {row.begin(), row.end()};
}

}  // namespace mortise
