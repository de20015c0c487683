#include "mortise/mortar/quadratic_facet.hpp"

#include <Eigen/LU>
#include <stdexcept>
#include <string>

namespace mortise {
namespace {

NonNegativeBasis make_basis(std::size_t corners, std::size_t nodes, double share) {
  NonNegativeBasis basis;
  const auto count = static_cast<Eigen::Index>(nodes);
  basis.of_shape = FacetMatrix::Identity(count, count);
  for (std::size_t node = corners; node < nodes; ++node) {
    const auto middle = static_cast<Eigen::Index>(node);
    basis.of_shape(middle, middle) = 1.0 - 2.0 * share;
    for (const std::size_t end : ends_of_edge(node, corners)) basis.of_shape(static_cast<Eigen::Index>(end), middle) = share;
  }
  basis.to_shape = basis.of_shape.inverse();
  return basis;
}

}  // namespace

const std::vector<FacetPart>& linear_parts(int dimension, std::size_t nodes) {
  static const std::vector<FacetPart> line2 = {{0, 1}}, line3 = {{0, 2}, {2, 1}}, triangle3 = {{0, 1, 2}}, quadrilateral4 = {{0, 1, 2, 3}},
                                      triangle6 = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}, {3, 4, 5}},
                                      quadrilateral8 = {{0, 4, 7}, {4, 1, 5}, {5, 2, 6}, {7, 6, 3}, {4, 5, 6, 7}};
  if (dimension == 2) return nodes == 2 ? line2 : line3;
  switch (nodes) {
    case 3:
      return triangle3;
    case 4:
      return quadrilateral4;
    case 6:
      return triangle6;
    case 8:
      return quadrilateral8;
    default:
      throw std::invalid_argument("no facet in 3D has " + std::to_string(nodes) + " nodes");
  }
}

const NonNegativeBasis* non_negative_basis(int dimension, std::size_t nodes) {
  static const NonNegativeBasis line3 = make_basis(2, 3, 0.25), triangle6 = make_basis(3, 6, 0.25), quadrilateral8 = make_basis(4, 8, 0.375);
  if (nodes <= facet_corners(dimension, nodes)) return nullptr;
  return dimension == 2 ? &line3 : (nodes == 6 ? &triangle6 : &quadrilateral8);
}

}  // namespace mortise
