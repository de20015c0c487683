#include "body_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
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

}  // namespace mortise
