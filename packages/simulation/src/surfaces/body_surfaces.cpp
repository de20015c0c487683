#include "surfaces/body_surfaces.hpp"

#include <Teuchos_CommHelpers.hpp>
#include <algorithm>
#include <tuple>

#include "mortise/mortar/quadratic_facet.hpp"

namespace mortise {

PlaceOfNode reference_places(const Mesh& mesh) {
  return [&mesh](LocalOrdinal node) { return Eigen::Vector3d(mesh.coordinates[static_cast<std::size_t>(node)].data()); };
}

FacetPlaces places_of(const Mesh& mesh, const Side& side, const PlaceOfNode& at) {
  FacetPlaces places;
  for (const LocalOrdinal node : mesh.side_nodes(side)) places.push_back(at(node));
  return places;
}

const SideSet& whole_surface(const Mesh& mesh, std::size_t body) { return mesh.side_sets.at(mesh.bodies[body].name + "/surface"); }

bool is_rigid(const Mesh& mesh, std::size_t body) { return mesh.bodies[body].is_surface; }

std::vector<TaggedFacet> tagged_surface(const Mesh& mesh, std::size_t body, const SideSet& set, int in_set, int elsewhere, const PlaceOfNode& at) {
  const auto key = [](const Side& side) { return std::tuple(side.block, side.element, side.side); };
  std::vector<std::tuple<LocalOrdinal, LocalOrdinal, int>> members;
  for (LocalOrdinal s = 0; s < set.owned; ++s) members.push_back(key(set.sides[s]));
  std::sort(members.begin(), members.end());
  std::vector<TaggedFacet> facets;
  const SideSet& surface = whole_surface(mesh, body);
  facets.reserve(static_cast<std::size_t>(surface.owned));
  for (LocalOrdinal s = 0; s < surface.owned; ++s) {
    const Side& side = surface.sides[s];
    const bool is_member = std::binary_search(members.begin(), members.end(), key(side));
    facets.push_back({places_of(mesh, side, at), is_member ? in_set : elsewhere});
  }
  return facets;
}

std::vector<Box3> body_boxes(const Mesh& mesh, const PlaceOfNode& at) {
  std::vector<Box3> boxes(mesh.bodies.size());
  for (std::size_t body = 0; body < boxes.size(); ++body) {
    const SideSet& surface = whole_surface(mesh, body);
    for (LocalOrdinal s = 0; s < surface.owned; ++s)
      for (const LocalOrdinal node : mesh.side_nodes(surface.sides[s])) boxes[body].enclose(at(node));
  }
  return boxes_over_ranks(*mesh.comm, boxes);
}

std::vector<SidesOfBody> sides_by_body(const Mesh& mesh, const SideSet& set) {
  const auto body_of_side = [&](const Side& side) { return static_cast<std::size_t>(mesh.blocks[side.block].body); };
  std::vector<int> mine(mesh.bodies.size(), 0), all(mine.size(), 0);
  for (const Side& side : set.sides) mine[body_of_side(side)] = 1;
  Teuchos::reduceAll(*mesh.comm, Teuchos::REDUCE_MAX, static_cast<int>(mine.size()), mine.data(), all.data());
  std::vector<SidesOfBody> parts;
  const bool is_one = std::count(all.begin(), all.end(), 1) == 1;
  for (std::size_t body = 0; body < all.size(); ++body) {
    if (all[body] == 0) continue;
    if (is_one) return {{body, std::shared_ptr<const SideSet>(std::shared_ptr<const SideSet>(), &set)}};
    const auto part = std::make_shared<SideSet>();
    for (std::size_t s = 0; s < set.sides.size(); ++s) {
      if (body_of_side(set.sides[s]) != body) continue;
      part->sides.push_back(set.sides[s]);
      if (s < static_cast<std::size_t>(set.owned)) ++part->owned;
    }
    parts.push_back({body, part});
  }
  return parts;
}

std::vector<SurfaceProbe> probes_of(const Mesh& mesh, const SideSet& set, const PlaceOfNode& at) {
  std::vector<SurfaceProbe> probes;
  for (LocalOrdinal s = 0; s < set.owned; ++s) {
    const std::vector<LocalOrdinal> nodes = mesh.side_nodes(set.sides[s]);
    for (const SurfacePoint& point : surface_points(mesh.dimension, places_of(mesh, set.sides[s], at))) probes.push_back({point, nodes[point.node]});
  }
  return probes;
}

std::vector<double> side_lengths(const Mesh& mesh, const Side& side, const PlaceOfNode& at) {
  const std::vector<LocalOrdinal> nodes = mesh.side_nodes(side);
  const std::size_t corners = facet_corners(mesh.dimension, nodes.size());
  std::vector<double> lengths;
  for (std::size_t a = 0; a < corners; ++a) lengths.push_back((at(nodes[(a + 1) % corners]) - at(nodes[a])).norm());
  std::sort(lengths.begin(), lengths.end());
  return lengths;
}

double longest_facet(const Mesh& mesh, const SideSet& set, const PlaceOfNode& at) {
  double mine = 0.0, longest = 0.0;
  for (LocalOrdinal s = 0; s < set.owned; ++s) mine = std::max(mine, side_lengths(mesh, set.sides[s], at).back());
  Teuchos::reduceAll(*mesh.comm, Teuchos::REDUCE_MAX, mine, Teuchos::outArg(longest));
  return longest;
}

double deviation_from_parts(const Mesh& mesh, const SideSet& set, const PlaceOfNode& at) {
  double mine = 0.0, largest = 0.0;
  for (LocalOrdinal s = 0; s < set.owned; ++s) {
    const FacetPlaces places = places_of(mesh, set.sides[static_cast<std::size_t>(s)], at);
    const std::size_t corners = facet_corners(mesh.dimension, places.size());
    for (std::size_t a = corners; a < places.size(); ++a) {
      const auto [one, other] = ends_of_edge(a, corners);
      mine = std::max(mine, (places[a] - 0.5 * (places[one] + places[other])).norm());
    }
  }
  Teuchos::reduceAll(*mesh.comm, Teuchos::REDUCE_MAX, mine, Teuchos::outArg(largest));
  return 0.25 * (mesh.dimension - 1) * largest;
}

}  // namespace mortise
