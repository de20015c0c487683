#include "listed/body_checks.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <boost/geometry.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <numeric>
#include <set>

namespace mortise {
namespace {

constexpr double flat = 1e-6;  ///< over the size of the mesh: as many digits as mesh files often have

std::string place_text(const MeshFile& file, std::int32_t file_node) {
  const auto& x = file.coordinates[static_cast<std::size_t>(file_node)];
  return fmt::format("node {} at ({:.6g}, {:.6g}, {:.6g})", file.node_labels[static_cast<std::size_t>(file_node)], x[0], x[1], x[2]);
}

}  // namespace

void require_flat(const MeshFile& file, const FileBodyRequest& request, const ChosenCells& chosen) {
  if (request.dimension != 2) return;
  constexpr double infinity = std::numeric_limits<double>::infinity();
  std::array<double, 3> low{infinity, infinity, infinity}, high{-infinity, -infinity, -infinity};
  for (const std::int32_t node : chosen.file_nodes)
    for (int i = 0; i < 3; ++i) {
      low[i] = std::min(low[i], file.coordinates[static_cast<std::size_t>(node)][i]);
      high[i] = std::max(high[i], file.coordinates[static_cast<std::size_t>(node)][i]);
    }
  const double size = std::hypot(high[0] - low[0], high[1] - low[1], high[2] - low[2]);
  if (high[2] - low[2] <= flat * size) return;
  throw InputError(request.place,
                   fmt::format("body \"{}\" of {} reaches from z = {:.6g} to {:.6g}; a plane or axisymmetric model needs a mesh in a plane of one z, "
                               "with x and y (the radius and the axis) in it",
                               request.name, file.path, low[2], high[2]));
}

void require_conforming(const MeshFile& file, const FileBodyRequest& request, const ChosenCells& chosen, const SideTable& sides) {
  const auto label = [&](const ElementSide& side) { return chosen.elements.labels[static_cast<std::size_t>(side.element)]; };
  if (const auto many = sides.shared_by_many(); !many.empty())
    throw InputError(
        request.place,
        fmt::format("body \"{}\" of {}: elements {}, {} and {} share one side, near {}; a side belongs to two elements at most, so please remove "
                    "elements that stand twice in the mesh",
                    request.name, file.path, label(many[0]), label(many[1]), label(many[2]),
                    place_text(file, chosen.file_nodes[static_cast<std::size_t>(sides.key(many[0])[0])])));
  // Triangles of the surface by their corners; each quadrilateral of the surface has four triangles of its corners.
  std::vector<std::pair<CornerKey, ElementSide>> triangles;
  std::vector<ElementSide> quadrilaterals;
  for (const ElementSide& side : sides.surface()) {
    const CornerKey key = sides.key(side);
    if (key[2] < 0) return;  // in 2D
    if (key[3] < 0)
      triangles.emplace_back(key, side);
    else
      quadrilaterals.push_back(side);
  }
  std::sort(triangles.begin(), triangles.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  for (const ElementSide& side : quadrilaterals)
    for (int left_out = 0; left_out < 4; ++left_out) {
      const CornerKey of_side = sides.key(side);
      std::array<std::int32_t, 3> corners{};
      for (int c = 0, k = 0; c < 4; ++c)
        if (c != left_out) corners[k++] = of_side[c];
      const CornerKey key = corner_key(corners.data(), 3);
      const auto found = std::lower_bound(triangles.begin(), triangles.end(), key, [](const auto& a, const CornerKey& b) { return a.first < b; });
      if (found == triangles.end() || found->first != key) continue;
      throw InputError(request.place,
                       fmt::format("body \"{}\" of {}: a triangle of element {} lies on a quadrilateral of element {}, near {}; the two are not "
                                   "connected there. Please put pyramids between them",
                                   request.name, file.path, label(found->second), label(side),
                                   place_text(file, chosen.file_nodes[static_cast<std::size_t>(key[0])])));
    }
}

void require_one_piece(const MeshFile& file, const FileBodyRequest& request, const ChosenCells& chosen) {
  const BodyElements& elements = chosen.elements;
  const std::vector<std::int32_t> lowest = lowest_connected_nodes(chosen);
  std::set<std::int32_t> pieces;
  std::int64_t outside = 0;
  std::int32_t other = -1;
  for (std::int32_t e = 0; e < elements.size(); ++e) {
    const std::int32_t piece = lowest[static_cast<std::size_t>(*elements.nodes_of(e))];
    if (pieces.size() < 1000) pieces.insert(piece);
    if (piece == lowest[static_cast<std::size_t>(*elements.nodes_of(0))]) continue;
    ++outside;
    if (other < 0) other = e;
  }
  if (pieces.size() == 1) return;
  throw InputError(
      request.place,
      fmt::format(
          "body \"{}\" of {} falls into {} pieces that have no node in common: {} of {} elements are not connected to the first one, for instance "
          "element {} with {}; please make each piece a body of its own, by its \"blocks\" or a point of it (\"piece\"), or merge nodes that stand "
          "at one "
          "place",
          request.name, file.path, pieces.size(), outside, elements.size(), elements.labels[static_cast<std::size_t>(other)],
          place_text(file, chosen.file_nodes[static_cast<std::size_t>(*elements.nodes_of(other))])));
}

void require_one_orientation(const MeshFile& file, const FileBodyRequest& request, const ChosenCells& chosen) {
  const BodyElements& elements = chosen.elements;
  std::map<std::array<std::int32_t, 2>, std::int32_t> ways;  // of edges from one node to the next, and the facet
  const auto say = [&](std::int32_t one, std::int32_t other, std::int32_t node) {
    throw InputError(
        request.place,
        fmt::format("rigid body \"{}\" of {}: facets {} and {} have their outsides on different sides, near {}; all facets have to run the same way "
                    "round, counterclockwise seen from outside (in 2D with the body on the left)",
                    request.name, file.path, elements.labels[static_cast<std::size_t>(one)], elements.labels[static_cast<std::size_t>(other)],
                    place_text(file, chosen.file_nodes[static_cast<std::size_t>(node)])));
  };
  for (std::int32_t e = 0; e < elements.size(); ++e) {
    const int corners = elements.cell(e).corners;
    const std::int32_t* nodes = elements.nodes_of(e);
    if (corners == 2) {  // each node is the start of one line and the end of another
      for (const int end : {0, 1}) {
        const auto [found, is_new] = ways.try_emplace({nodes[end], end}, e);
        if (!is_new) say(found->second, e, nodes[end]);
      }
      continue;
    }
    for (int a = 0; a < corners; ++a) {
      const auto [found, is_new] = ways.try_emplace({nodes[a], nodes[(a + 1) % corners]}, e);
      if (!is_new) say(found->second, e, nodes[a]);
    }
  }
}

namespace {

namespace geometry = boost::geometry;
using TreePoint = geometry::model::point<double, 3, geometry::cs::cartesian>;
using TreeBox = geometry::model::box<TreePoint>;

Eigen::Vector3d place_of(const MeshFile& file, const ChosenCells& chosen, std::int32_t node) {
  return Eigen::Vector3d(file.coordinates[static_cast<std::size_t>(chosen.file_nodes[static_cast<std::size_t>(node)])].data());
}

/// The distance of a point from a triangle or, with two corners, a line; infinite where it lies beside it.
double distance(const Eigen::Vector3d& x, const std::vector<Eigen::Vector3d>& corners) {
  constexpr double beside = 1e-9;
  const Eigen::Vector3d e = corners[1] - corners[0], r = x - corners[0];
  if (corners.size() == 2) {
    const double s = r.dot(e) / e.squaredNorm();
    return s < -beside || s > 1.0 + beside ? std::numeric_limits<double>::infinity() : (r - s * e).norm();
  }
  const Eigen::Vector3d f = corners[2] - corners[0], normal = e.cross(f);
  if (!(normal.squaredNorm() > 0.0)) return std::numeric_limits<double>::infinity();  // a side that is collapsed to a line
  const double u = r.cross(f).dot(normal) / normal.squaredNorm(), v = e.cross(r).dot(normal) / normal.squaredNorm();
  if (u < -beside || v < -beside || u + v > 1.0 + beside) return std::numeric_limits<double>::infinity();
  return std::abs(r.dot(normal)) / normal.norm();
}

}  // namespace

std::optional<std::string> loose_nodes(const MeshFile& file, const ChosenCells& chosen, const SideTable& sides) {
  constexpr double on_side = 1e-6;  ///< over its size: as many digits as mesh files often have
  std::set<std::int32_t> nodes;
  const std::vector<ElementSide> surface = sides.surface();
  for (const ElementSide& side : surface)
    for (const std::int32_t node : nodes_of_side(chosen.elements, side)) nodes.insert(node);
  std::vector<std::pair<TreePoint, std::int32_t>> entries;
  for (const std::int32_t node : nodes) {
    const Eigen::Vector3d x = place_of(file, chosen, node);
    entries.emplace_back(TreePoint(x[0], x[1], x[2]), node);
  }
  const geometry::index::rtree<std::pair<TreePoint, std::int32_t>, geometry::index::rstar<16>> tree(entries);
  std::set<std::int32_t> loose;
  std::int32_t of_element = -1, example = -1;
  std::vector<std::pair<TreePoint, std::int32_t>> near;
  for (const ElementSide& side : surface) {
    const auto own = nodes_of_side(chosen.elements, side);
    const int corners = topology(shape_of_side(chosen.elements, side)).corners;
    std::vector<Eigen::Vector3d> x;
    for (int c = 0; c < corners; ++c) x.push_back(place_of(file, chosen, own[static_cast<std::size_t>(c)]));
    const double size = (x[1] - x[0]).norm();
    Eigen::Vector3d low = x[0], high = x[0];
    for (const Eigen::Vector3d& corner : x) low = low.cwiseMin(corner), high = high.cwiseMax(corner);
    low.array() -= on_side * size, high.array() += on_side * size;
    near.clear();
    tree.query(geometry::index::intersects(TreeBox(TreePoint(low[0], low[1], low[2]), TreePoint(high[0], high[1], high[2]))),
               std::back_inserter(near));
    for (const auto& [point, node] : near) {
      if (std::find(own.begin(), own.end(), node) != own.end()) continue;
      const Eigen::Vector3d at = place_of(file, chosen, node);
      double least = distance(at, {x[0], x[1]});
      if (corners > 2) least = distance(at, {x[0], x[1], x[2]});
      if (corners == 4) least = std::min(least, distance(at, {x[0], x[2], x[3]}));
      if (least > on_side * size) continue;
      if (loose.insert(node).second && example < 0) example = node, of_element = side.element;
    }
  }
  if (loose.empty()) return std::nullopt;
  return fmt::format(
      "{} nodes of the surface lie on sides of elements that do not have them, for instance {} on a side of element {}: nothing connects the two "
      "there. "
      "Please merge nodes that stand at one place and let cells share whole sides, unless it is a crack",
      loose.size(), place_text(file, chosen.file_nodes[static_cast<std::size_t>(example)]),
      chosen.elements.labels[static_cast<std::size_t>(of_element)]);
}

}  // namespace mortise
