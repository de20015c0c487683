#include "distribution/inverted_elements.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/LU>
#include <Teuchos_CommHelpers.hpp>
#include <algorithm>
#include <limits>
#include <optional>

namespace mortise {
namespace {

/// Where det J of an element is smallest.
struct Smallest {
  double determinant = std::numeric_limits<double>::infinity();
  SpatialPoint position{};
};

/// An element with det J <= 0 somewhere. Where the edges of a cell with mid-side nodes are curved this may be in corners alone.
struct Inverted {
  LocalOrdinal element = 0;
  Smallest all, inside;  ///< of all places, and of those of the rule
  bool can_be_integrated() const { return inside.determinant > 0.0; }
};

/// Elements of a block that are inverted: the first that cannot be integrated, and all others.
struct InvertedOfBlock {
  std::optional<Inverted> first;
  std::vector<Inverted> in_corners;
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

/// Of the owned elements.
template <class Cell>
InvertedOfBlock inverted_of(const Mesh& mesh, const Block& block) {
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
  bool has_inner_places = false;
  if constexpr (nodes > dimension + 1) has_inner_places = Cell::jacobian_points > 0 && topology(block.shape).mid_side_nodes() > 0;
  InvertedOfBlock found;
  Eigen::Matrix<double, dimension, nodes> x;
  for (LocalOrdinal e = 0; e < block.owned && !found.first; ++e) {
    Inverted here;
    here.element = e;
    for (int a = 0; a < nodes; ++a)
      for (int i = 0; i < dimension; ++i) x(i, a) = mesh.coordinates[block.nodes(e)[a]][i];
    for (std::size_t p = 0; p < places.size(); ++p) {
      const Place& place = places[p];
      const Eigen::Matrix<double, dimension, dimension> jacobian = x.lazyProduct(place.gradients);
      const double determinant = jacobian.determinant();
      const auto keep_smallest = [&](Smallest& smallest) {
        if (determinant >= smallest.determinant) return;
        smallest.determinant = determinant;
        smallest.position = {};
        for (int a = 0; a < nodes; ++a)
          for (int i = 0; i < dimension; ++i) smallest.position[i] += place.values[a] * x(i, a);
      };
      keep_smallest(here.all);
      if (!has_inner_places || p >= static_cast<std::size_t>(nodes)) keep_smallest(here.inside);
    }
    if (here.all.determinant > 0.0) continue;
    if (here.can_be_integrated())
      found.in_corners.push_back(here);
    else
      found.first = here;
  }
  return found;
}

InvertedOfBlock inverted_of(const Mesh& mesh, const Block& block) {
  if (topology(block.shape).dimension < mesh.dimension) return {};  // the surface of a rigid body
  return visit_cell(block.shape, [&](auto cell) { return inverted_of<decltype(cell)>(mesh, block); });
}

/// The first node of an element that stands in it twice.
std::optional<LocalOrdinal> repeated_node(const Block& block, LocalOrdinal element) {
  const LocalOrdinal* const nodes = block.nodes(element);
  for (int a = 1; a < block.nodes_per_element; ++a)
    if (std::find(nodes, nodes + a, nodes[a]) != nodes + a) return nodes[a];
  return std::nullopt;
}

std::string text_of(const SpatialPoint& x, int dimension) {
  return dimension == 2 ? fmt::format("({:.6g}, {:.6g})", x[0], x[1]) : fmt::format("({:.6g}, {:.6g}, {:.6g})", x[0], x[1], x[2]);
}

/// The least numbers that ranks have, ascending, up to `most`; collective.
std::vector<long long> least_of_all(const Communicator& comm, std::vector<long long> mine, std::size_t most) {
  std::sort(mine.begin(), mine.end());
  mine.resize(most, std::numeric_limits<long long>::max());
  std::vector<long long> all(most * static_cast<std::size_t>(comm.getSize()));
  Teuchos::gatherAll(comm, static_cast<int>(most), mine.data(), static_cast<int>(all.size()), all.data());
  std::sort(all.begin(), all.end());
  all.erase(std::lower_bound(all.begin(), all.end(), std::numeric_limits<long long>::max()), all.end());
  if (all.size() > most) all.resize(most);
  return all;
}

}  // namespace

InvertedElements find_inverted_elements(const Mesh& mesh, const BodySet& set, const std::vector<BodyDescription>& bodies) {
  InvertedElements result;
  for (const Block& block : mesh.blocks) {
    const InvertedOfBlock inverted = inverted_of(mesh, block);
    const BodyDescription& body = bodies[block.body];
    const auto label = [&](LocalOrdinal element) {
      const GlobalOrdinal inside = block.element_ids[element] - set.first_element(block.body);
      return body.listed ? static_cast<long long>(*body.listed->labels.row(inside).first) : static_cast<long long>(inside);
    };
    if (inverted.first) {
      const auto& [determinant, position] = inverted.first->all;
      const std::optional<LocalOrdinal> twice = repeated_node(block, inverted.first->element);
      const std::string rule = twice
                                   ? fmt::format("its node at {} stands in it twice, and what is left is no triangle, wedge, pyramid or tetrahedron",
                                                 text_of(mesh.coordinates[*twice], mesh.dimension))
                               : mesh.dimension == 2 ? "corners have to go round counterclockwise and edges must not cross"
                                                     : "its sides must not cross";
      result.errors.push_back({body.place, fmt::format("body \"{}\": element {} is inverted: det J = {:.6g} at {}; {}", body.name,
                                                       label(inverted.first->element), determinant, text_of(position, mesh.dimension), rule)});
    }
    constexpr std::size_t most_names = 10;
    std::vector<long long> mine;
    for (const Inverted& one : inverted.in_corners) mine.push_back(label(one.element));
    long long count = 0;
    const auto of_rank = static_cast<long long>(mine.size());
    Teuchos::reduceAll(*mesh.comm, Teuchos::REDUCE_SUM, of_rank, Teuchos::outArg(count));
    if (count == 0) continue;
    const std::vector<long long> names = least_of_all(*mesh.comm, std::move(mine), most_names);
    result.warnings.push_back(fmt::format(
        "{}: {} elements are turned inside out at a corner, as the edges there are curved too much; det J is positive at all points of integration. "
        "Stresses near these corners are not to be relied on. Elements: {}{}",
        body.name, count, fmt::join(names, ", "), count > static_cast<long long>(names.size()) ? ", ..." : ""));
  }
  return result;
}

}  // namespace mortise
