#include "distribution/inverted_elements.hpp"

#include <fmt/format.h>

#include <Eigen/LU>
#include <limits>

namespace mortise {
namespace {

/// An element with det J <= 0 somewhere: the smallest value that was seen, and where.
struct Inverted {
  LocalOrdinal element = 0;
  double determinant = std::numeric_limits<double>::infinity();
  SpatialPoint position{};
};

/// det J is evaluated at the nodes and at the points of a rule. On linear triangles and tetrahedra it is constant. On bilinear quadrilaterals it is
/// linear in each reference coordinate without a mixed term: it is positive everywhere if it is so in the corners. On pyramids the corners of the
/// base are enough too (see Pyramid5); the apex has the mean of what they have.
template <class Cell>
std::vector<std::array<double, Cell::dimension>> places_to_look_at() {
  std::vector<std::array<double, Cell::dimension>> places;
  if constexpr (Cell::nodes == Cell::dimension + 1) {
    places.push_back(Cell::centroid);
  } else {
    for (const auto& node : Cell::node_positions) places.push_back(node);
    if constexpr (Cell::jacobian_points > 0)
      for (const auto& point : Cell::rule(Cell::jacobian_points)) places.push_back(point.template position<Cell::dimension>());
  }
  return places;
}

/// The first inverted one of the owned elements.
template <class Cell>
Inverted first_inverted(const Mesh& mesh, const Block& block) {
  constexpr int dimension = Cell::dimension, nodes = Cell::nodes;
  using Gradients = Eigen::Matrix<double, nodes, dimension>;
  struct Place {
    Gradients gradients;
    std::array<double, nodes> values;
  };
  std::vector<Place> places;
  for (const auto& xi : places_to_look_at<Cell>()) {
    Place place;
    place.values = Cell::values(xi);
    const auto gradients = Cell::gradients(xi);
    for (int a = 0; a < nodes; ++a)
      for (int i = 0; i < dimension; ++i) place.gradients(a, i) = gradients[a][i];
    places.push_back(place);
  }
  Inverted smallest;
  Eigen::Matrix<double, dimension, nodes> x;
  for (LocalOrdinal e = 0; e < block.owned && !(smallest.determinant <= 0.0); ++e) {
    smallest = {};
    smallest.element = e;
    for (int a = 0; a < nodes; ++a)
      for (int i = 0; i < dimension; ++i) x(i, a) = mesh.coordinates[block.nodes(e)[a]][i];
    for (const Place& place : places) {
      const Eigen::Matrix<double, dimension, dimension> jacobian = x.lazyProduct(place.gradients);
      const double determinant = jacobian.determinant();
      if (determinant >= smallest.determinant) continue;
      smallest.determinant = determinant;
      smallest.position = {};
      for (int a = 0; a < nodes; ++a)
        for (int i = 0; i < dimension; ++i) smallest.position[i] += place.values[a] * x(i, a);
    }
  }
  return smallest;
}

Inverted first_inverted(const Mesh& mesh, const Block& block) {
  if (topology(block.shape).dimension < mesh.dimension) return {};  // the surface of a rigid body
  return visit_cell(block.shape, [&](auto cell) { return first_inverted<decltype(cell)>(mesh, block); });
}

}  // namespace

std::vector<Diagnostic> inverted_elements(const Mesh& mesh, const BodySet& set, const std::vector<BodyDescription>& bodies) {
  std::vector<Diagnostic> diagnostics;
  for (std::size_t b = 0; b < mesh.blocks.size(); ++b) {
    const auto& block = mesh.blocks[b];
    const Inverted inverted = first_inverted(mesh, block);
    if (inverted.determinant > 0.0) continue;
    const auto& x = inverted.position;
    const bool plane = mesh.dimension == 2;
    const std::string at = plane ? fmt::format("({:.6g}, {:.6g})", x[0], x[1]) : fmt::format("({:.6g}, {:.6g}, {:.6g})", x[0], x[1], x[2]);
    const char* const rule = plane ? "corners have to go round counterclockwise and edges must not cross" : "its sides must not cross";
    const BodyDescription& body = bodies[block.body];
    const GlobalOrdinal inside = block.element_ids[inverted.element] - set.first_element(block.body);
    const GlobalOrdinal label = body.listed ? static_cast<GlobalOrdinal>(*body.listed->labels.row(inside).first) : inside;
    diagnostics.push_back(
        {body.place, fmt::format("body \"{}\": element {} is inverted: det J = {:.6g} at {}; {}", body.name, label, inverted.determinant, at, rule)});
  }
  return diagnostics;
}

}  // namespace mortise
