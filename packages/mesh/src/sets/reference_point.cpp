#include "mortise/mesh/reference_point.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_Map.hpp>
#include <algorithm>
#include <cmath>
#include <limits>

#include "mortise/core/names.hpp"
#include "mortise/mesh/sets.hpp"

namespace mortise {
namespace {

/// The first node of the set that follows another point or is one, as an error.
std::vector<Diagnostic> conflicts(const Mesh& mesh, const std::vector<LocalOrdinal>& nodes, const ReferencePoint& point, const Place& place) {
  for (const ReferencePoint& other : mesh.reference_points) {
    const auto& followers = other.followers;
    for (const LocalOrdinal node : nodes) {
      if (node != other.node && !std::binary_search(followers.begin(), followers.end(), node)) continue;
      const auto& x = mesh.coordinates[node];
      return {{place, node == other.node
                          ? fmt::format("\"{}\" is a reference point itself; please tie \"{}\" to a set of a body", other.name, point.name)
                          : fmt::format("the node of reference position ({:g}, {:g}, {:g}) follows \"{}\" already, so it cannot follow \"{}\"", x[0],
                                        x[1], x[2], other.name, point.name)}};
    }
  }
  return {};
}

}  // namespace

const ReferencePoint& require_rotating_point(const Mesh& mesh, const Located<std::string>& name) {
  std::vector<std::string> names;
  for (const ReferencePoint& point : mesh.reference_points) {
    if (point.rotation_node < 0) continue;
    if (point.name == name.value) return point;
    names.push_back(point.name);
  }
  if (names.empty()) throw InputError(name.place, fmt::format("\"{}\" cannot rotate: there is no reference point that rotates", name.value));
  throw InputError(name.place, fmt::format("\"{}\" is no reference point that rotates{}; those are: {}", name.value, did_you_mean(name.value, names),
                                           fmt::join(names, ", ")));
}

void add_followers(Mesh& mesh, std::size_t index, const Located<std::string>& set, const std::array<bool, 3>& follows) {
  ReferencePoint& point = mesh.reference_points.at(index);
  const std::vector<LocalOrdinal>& nodes = require_node_set(mesh, set);
  throw_if_any(*mesh.comm, conflicts(mesh, nodes, point, set.place));
  point.followers = nodes;
  point.follows = follows;

  // (x, y, z, -x, -y, -z, body): largest over all ranks.
  std::array<double, 7> mine, all;
  mine.fill(-std::numeric_limits<double>::max());
  for (const LocalOrdinal node : nodes) {
    for (int i = 0; i < 3; ++i) {
      mine[i] = std::max(mine[i], mesh.coordinates[node][i]);
      mine[3 + i] = std::max(mine[3 + i], -mesh.coordinates[node][i]);
    }
    mine[6] = std::max<double>(mine[6], mesh.body_of_node[node]);
  }
  Teuchos::reduceAll(*mesh.comm, Teuchos::REDUCE_MAX, 7, mine.data(), all.data());
  if (!point.is_placed)
    for (int i = 0; i < 3; ++i) mesh.coordinates[point.node][i] = 0.5 * (all[i] - all[3 + i]);
  const auto& x = mesh.coordinates[point.node];
  const auto farthest = [&](int i) { return std::max(std::abs(all[i] - x[i]), std::abs(all[3 + i] + x[i])); };
  point.arm = std::hypot(farthest(0), farthest(1), farthest(2));
  if (!(point.arm > 0.0)) point.arm = 1.0;  // a single node at the point itself: any length will do
  mesh.body_of_node[point.node] = static_cast<int>(all[6]);
  if (point.rotation_node < 0) return;
  mesh.coordinates[point.rotation_node] = x;
  mesh.body_of_node[point.rotation_node] = static_cast<int>(all[6]);
}

}  // namespace mortise
