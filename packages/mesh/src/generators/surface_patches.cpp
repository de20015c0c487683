#include "mortise/mesh/surface_patches.hpp"

#include <Teuchos_CommHelpers.hpp>
#include <Teuchos_OrdinalTraits.hpp>
#include <Tpetra_Export.hpp>
#include <Tpetra_Import.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace mortise {
namespace {

using Position = std::array<double, 3>;

/// Numbers up to 2^52 are exact as the difference to it, so that the largest difference is that of the least number.
constexpr double beyond_numbers = 4503599627370496.0;

RCP<const Map> map_of_sides(const Mesh& mesh, const std::vector<GlobalOrdinal>& numbers) {
  return rcp(new Map(Teuchos::OrdinalTraits<Tpetra::global_size_t>::invalid(), Teuchos::arrayViewFromVector(numbers), 0, mesh.comm));
}

double cosine(const Position& a, const Position& b) {
  const double lengths = std::hypot(a[0], a[1], a[2]) * std::hypot(b[0], b[1], b[2]);
  return lengths > 0.0 ? (a[0] * b[0] + a[1] * b[1] + a[2] * b[2]) / lengths : -1.0;
}

/// Outward normal of a facet at one of its nodes, of any length: of quadratic ones that of the curved facet.
Position normal_at(const Mesh& mesh, const std::vector<LocalOrdinal>& nodes, CellShape shape, std::size_t node) {
  return visit_cell(shape, [&](auto cell) -> Position {
    using Cell = decltype(cell);
    Position t[2]{};
    if constexpr (Cell::dimension < 3) {
      const auto gradients = Cell::gradients(Cell::node_positions[node]);
      for (std::size_t a = 0; a < nodes.size(); ++a)
        for (int d = 0; d < Cell::dimension; ++d)
          for (int i = 0; i < 3; ++i) t[d][i] += gradients[a][d] * mesh.coordinates[static_cast<std::size_t>(nodes[a])][i];
    }
    if (Cell::dimension == 1) return {t[0][1], -t[0][0], 0.0};
    return {t[0][1] * t[1][2] - t[0][2] * t[1][1], t[0][2] * t[1][0] - t[0][0] * t[1][2], t[0][0] * t[1][1] - t[0][1] * t[1][0]};
  });
}

/// A side at one of its edges, in 2D at a node.
struct SideAtEdge {
  std::size_t side;
  Position normal;  ///< there
};

/// Pairs of sides on this rank that share an edge with an owned node, and how they meet there. Every pair is found on a rank that owns a node of
/// its edge.
std::vector<std::array<SideAtEdge, 2>> neighbours(const Mesh& mesh, const SideSet& set) {
  std::map<std::array<LocalOrdinal, 2>, std::vector<SideAtEdge>> sides_of_edge;
  for (std::size_t s = 0; s < set.sides.size(); ++s) {
    const auto nodes = mesh.side_nodes(set.sides[s]);
    const CellShape shape = mesh.side_shape(set.sides[s]);
    const CellTopology& facet = topology(shape);
    for (int a = 0; a < facet.corners; ++a) {
      const LocalOrdinal first = nodes[static_cast<std::size_t>(a)];
      const LocalOrdinal second = mesh.dimension == 2 ? first : nodes[static_cast<std::size_t>((a + 1) % facet.corners)];
      if (std::min(first, second) >= mesh.owned_count()) continue;
      // Edge a of a plane facet lies between corners a and a + 1; where it has a node in its middle that tells.
      const bool has_middle = mesh.dimension == 3 && facet.nodes > facet.corners;
      const Position normal = normal_at(mesh, nodes, shape, static_cast<std::size_t>(has_middle ? facet.corners + a : a));
      sides_of_edge[{std::min(first, second), std::max(first, second)}].push_back({s, normal});
    }
  }
  std::vector<std::array<SideAtEdge, 2>> pairs;
  for (const auto& [edge, sides] : sides_of_edge)
    for (std::size_t a = 0; a < sides.size(); ++a)
      for (std::size_t b = a + 1; b < sides.size(); ++b) pairs.push_back({sides[a], sides[b]});
  return pairs;
}

}  // namespace

GlobalOrdinal side_number(const Mesh& mesh, const Side& side) {
  return 8 * mesh.blocks[side.block].element_ids[static_cast<std::size_t>(side.element)] + 1 + side.side;
}

Position middle_of(const Mesh& mesh, const Side& side) {
  const auto nodes = mesh.side_nodes(side);
  Position middle{};
  for (const LocalOrdinal node : nodes)
    for (int i = 0; i < 3; ++i) middle[i] += mesh.coordinates[static_cast<std::size_t>(node)][i] / static_cast<double>(nodes.size());
  return middle;
}

// In 2D (t_y, -t_x) of the way along it. In 3D half the sum of p_a x p_b over the edges of the polygon, with positions from its first corner on.
Position normal_of(const Mesh& mesh, const Side& side) {
  const auto nodes = mesh.side_nodes(side);
  const int corners = topology(mesh.side_shape(side)).corners;
  const auto x = [&](int a) { return mesh.coordinates[static_cast<std::size_t>(nodes[static_cast<std::size_t>(a % corners)])]; };
  if (mesh.dimension == 2) return {x(1)[1] - x(0)[1], x(0)[0] - x(1)[0], 0.0};
  Position normal{};
  const Position origin = x(0);
  for (int a = 0; a < corners; ++a) {
    Position p = x(a), q = x(a + 1);
    for (int i = 0; i < 3; ++i) p[i] -= origin[i], q[i] -= origin[i];
    for (int i = 0; i < 3; ++i) normal[i] += 0.5 * (p[(i + 1) % 3] * q[(i + 2) % 3] - p[(i + 2) % 3] * q[(i + 1) % 3]);
  }
  return normal;
}

// Each side begins with its own number. The least number of neighbours is taken over until nothing changes: on this rank at once, and from rank to
// rank by rounds. There are as many rounds as a patch crosses ranks.
std::vector<GlobalOrdinal> patches_of(const Mesh& mesh, const SideSet& set, double angle) {
  std::vector<GlobalOrdinal> patch;
  for (const Side& side : set.sides) patch.push_back(side_number(mesh, side));
  const auto local_map = map_of_sides(mesh, patch),
             owned_map = map_of_sides(mesh, {patch.begin(), patch.begin() + static_cast<std::ptrdiff_t>(set.owned)});
  const double least_cosine = std::cos(angle * M_PI / 180.0) - 1e-12;
  std::vector<std::array<std::size_t, 2>> smooth;
  for (const auto& [a, b] : neighbours(mesh, set))
    if (cosine(a.normal, b.normal) >= least_cosine) smooth.push_back({a.side, b.side});
  // Sides of this rank that hang together, by the first of them.
  std::vector<std::size_t> first(set.sides.size());
  std::iota(first.begin(), first.end(), std::size_t{0});
  const auto root = [&](std::size_t s) {
    while (first[s] != s) s = first[s] = first[first[s]];
    return s;
  };
  for (const auto& [a, b] : smooth) {
    const std::size_t one = root(a), other = root(b);
    first[std::max(one, other)] = std::min(one, other);
  }
  const Export to_owners(local_map, owned_map);
  const Import to_copies(owned_map, local_map);
  for (int changed_anywhere = 1; changed_anywhere != 0;) {
    std::vector<GlobalOrdinal> least(patch);
    for (std::size_t s = 0; s < patch.size(); ++s) least[root(s)] = std::min(least[root(s)], patch[s]);
    Vector local(local_map), owned(owned_map);
    {
      const auto view = local.getLocalViewHost(Tpetra::Access::OverwriteAll);
      for (std::size_t s = 0; s < patch.size(); ++s) view(s, 0) = beyond_numbers - static_cast<double>(least[root(s)]);
    }
    owned.doExport(local, to_owners, Tpetra::ABSMAX);
    local.doImport(owned, to_copies, Tpetra::REPLACE);
    const auto view = local.getLocalViewHost(Tpetra::Access::ReadOnly);
    int changed = 0;
    for (std::size_t s = 0; s < patch.size(); ++s) {
      const auto now = static_cast<GlobalOrdinal>(beyond_numbers - view(s, 0));
      if (now != patch[s]) changed = 1;
      patch[s] = now;
    }
    Teuchos::reduceAll(*mesh.comm, Teuchos::REDUCE_MAX, changed, Teuchos::outArg(changed_anywhere));
  }
  return patch;
}

}  // namespace mortise
