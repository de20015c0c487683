#include "surfaces/facing_patches.hpp"

#include <Teuchos_CommHelpers.hpp>
#include <algorithm>
#include <cmath>
#include <map>

#include "mortise/mesh/surface_patches.hpp"

namespace mortise {
namespace {

constexpr double facing = 0.5;  ///< cosine of the angle between opposite normals: surfaces that meet at more than 60 degrees do not face one another
constexpr double touching = 1e-9;  ///< over the size of the model: nearer crossings are at the point itself

/// The lists of all ranks, one after the other. Collective.
std::vector<double> gather(const Communicator& comm, const std::vector<double>& mine) {
  const int ranks = comm.getSize();
  const int size = static_cast<int>(mine.size());
  std::vector<int> sizes(static_cast<std::size_t>(ranks));
  Teuchos::gatherAll(comm, 1, &size, ranks, sizes.data());
  const int longest = std::max(1, *std::max_element(sizes.begin(), sizes.end()));
  std::vector<double> padded(mine), all(static_cast<std::size_t>(longest) * static_cast<std::size_t>(ranks));
  padded.resize(static_cast<std::size_t>(longest), 0.0);
  Teuchos::gatherAll(comm, longest, padded.data(), longest * ranks, all.data());
  std::vector<double> result;
  for (int rank = 0; rank < ranks; ++rank) {
    const auto first = all.begin() + static_cast<std::ptrdiff_t>(longest) * rank;
    result.insert(result.end(), first, first + sizes[static_cast<std::size_t>(rank)]);
  }
  return result;
}

Eigen::Vector3d vector(const std::array<double, 3>& x) { return Eigen::Vector3d(x.data()); }

/// Patches of the bodies that take part, and those of each side of "body/surface" on this rank.
struct Patches {
  std::vector<SurfacePart> parts;
  std::vector<std::vector<int>> of_sides;  ///< [bodies][sides of the surface] indices of parts
};

/// Entries of a part's row while it is summed up.
enum Entry { number, body, seed_x, seed_y, seed_z, middle_x, middle_y, middle_z, normal_x, normal_y, normal_z, area, shortest, sides, entries };

/// Three entries of a row.
Eigen::Map<Eigen::Vector3d> in_row(std::array<double, entries>& row, Entry first) { return Eigen::Map<Eigen::Vector3d>(&row[first]); }

Patches find_patches(const Mesh& mesh, const std::vector<char>& bodies, double angle) {
  const PlaceOfNode at = reference_places(mesh);
  std::vector<std::vector<GlobalOrdinal>> numbers(mesh.bodies.size());
  std::map<GlobalOrdinal, std::array<double, entries>> mine;
  for (std::size_t b = 0; b < mesh.bodies.size(); ++b) {
    if (!bodies[b]) continue;
    const SideSet& surface = whole_surface(mesh, b);
    numbers[b] = patches_of(mesh, surface, angle);
    for (LocalOrdinal s = 0; s < surface.owned; ++s) {
      const auto place = static_cast<std::size_t>(s);
      const Side& side = surface.sides[place];
      const Eigen::Vector3d middle = vector(middle_of(mesh, side)), normal = vector(normal_of(mesh, side));
      const double size = normal.norm();
      auto& row = mine.emplace(numbers[b][place], std::array<double, entries>{}).first->second;
      if (row[sides] == 0.0) row[shortest] = std::numeric_limits<double>::max();
      row[number] = static_cast<double>(numbers[b][place]);
      row[body] = static_cast<double>(b);
      if (side_number(mesh, side) == numbers[b][place]) in_row(row, seed_x) = middle;
      in_row(row, middle_x) += size * middle;
      in_row(row, normal_x) += normal;
      row[area] += size;
      row[shortest] = std::min(row[shortest], side_lengths(mesh, side, at).front());
      row[sides] += 1.0;
    }
  }
  std::vector<double> sent;
  for (const auto& [patch, row] : mine) sent.insert(sent.end(), row.begin(), row.end());
  std::map<GlobalOrdinal, std::array<double, entries>> all;
  const std::vector<double> received = gather(*mesh.comm, sent);
  for (auto row = received.begin(); row != received.end(); row += entries) {
    auto& sum = all.emplace(static_cast<GlobalOrdinal>(row[number]), std::array<double, entries>{}).first->second;
    if (sum[sides] == 0.0) sum[shortest] = std::numeric_limits<double>::max();
    sum[number] = row[number], sum[body] = row[body];
    for (int e = seed_x; e < entries; ++e)
      if (e != shortest) sum[static_cast<std::size_t>(e)] += row[e];
    sum[shortest] = std::min(sum[shortest], row[shortest]);
  }
  Patches patches;
  std::map<GlobalOrdinal, int> index;
  for (auto& [patch, sum] : all) {
    index[patch] = static_cast<int>(patches.parts.size());
    SurfacePart& part = patches.parts.emplace_back();
    part.body = static_cast<int>(sum[body]);
    part.number = patch;
    part.seed = in_row(sum, seed_x);
    part.centre = in_row(sum, middle_x) / sum[area];
    part.area = sum[area];
    part.shortest = sum[shortest];
    part.normal = in_row(sum, normal_x) / sum[area];
    part.turn = 1.0 - part.normal.norm();
    part.sides = static_cast<GlobalOrdinal>(sum[sides]);
  }
  for (const auto& of_body : numbers) {
    auto& of_sides = patches.of_sides.emplace_back();
    for (const GlobalOrdinal patch : of_body) of_sides.push_back(index.at(patch));
  }
  return patches;
}

/// The crossing that a point of a part sees: the nearest outside of another body along its normal, with nothing between.
std::optional<Crossing> seen(const std::vector<Crossing>& crossings, int own_part, const std::vector<SurfacePart>& parts, double tolerance,
                             double far) {
  const int own_body = parts[static_cast<std::size_t>(own_part)].body;
  std::optional<Crossing> nearest;
  for (const Crossing& crossing : crossings) {
    const bool is_other = parts[static_cast<std::size_t>(crossing.tag)].body != own_body;
    if (!is_other || crossing.along > -facing || std::abs(crossing.s) > far + tolerance) continue;
    const double low = std::min(0.0, crossing.s) + tolerance, high = std::max(0.0, crossing.s) - tolerance;
    const bool is_hidden = std::any_of(crossings.begin(), crossings.end(), [&](const Crossing& one) { return one.s > low && one.s < high; });
    if (!is_hidden && (!nearest || std::abs(crossing.s) < std::abs(nearest->s))) nearest = crossing;
  }
  return nearest;
}

/// Keeps those points that see another body behind them and lie within it. Along their normals they leave it before they would enter it. Across
/// them it ends no nearer than half as far as behind. So a hole's rim that lies a little in the seat of a bolt does not face the far side of its
/// head. A line that grazes a surface may miss it, so that what lies behind it alone tells nothing. A rigid surface has no inside. Collective.
/// @param seen  [lines] what they see; what is not within is taken back
void keep_overlaps(const Mesh& mesh, const std::vector<TaggedFacet>& facets, const std::vector<LineSegment>& lines,
                   const std::vector<SurfacePart>& parts, double tolerance, double length, std::vector<std::optional<Crossing>>& seen) {
  std::vector<LineSegment> ahead, across;
  std::vector<std::size_t> line_of, line_of_across;
  const auto body_of = [&](const Crossing& crossing) { return static_cast<std::size_t>(parts[static_cast<std::size_t>(crossing.tag)].body); };
  for (std::size_t line = 0; line < lines.size(); ++line) {
    if (!seen[line] || seen[line]->s >= -tolerance || is_rigid(mesh, body_of(*seen[line]))) continue;
    ahead.push_back({lines[line].x, lines[line].d, tolerance, length});
    line_of.push_back(line);
    const Eigen::Vector3d& n = lines[line].d;
    const Eigen::Vector3d first = mesh.dimension == 2 ? Eigen::Vector3d(-n[1], n[0], 0.0) : n.unitOrthogonal();
    for (const Eigen::Vector3d& d : {first, Eigen::Vector3d(n.cross(first))})
      for (const double sign : {1.0, -1.0}) {
        if (mesh.dimension == 2 && d[2] != 0.0) continue;
        across.push_back({lines[line].x, sign * d, tolerance, -0.5 * seen[line]->s});
        line_of_across.push_back(line);
      }
  }
  const auto found = crossings(*mesh.comm, mesh.dimension, facets, ahead), beside = crossings(*mesh.comm, mesh.dimension, facets, across);
  std::vector<std::size_t> outside;
  const auto first_of_body = [&](const std::vector<Crossing>& of_line, const Crossing& behind) {
    return std::find_if(of_line.begin(), of_line.end(), [&](const Crossing& one) { return body_of(one) == body_of(behind); });
  };
  for (std::size_t n = 0; n < ahead.size(); ++n) {
    const auto next = first_of_body(found[n], *seen[line_of[n]]);
    if (next == found[n].end() || !next->leaves) outside.push_back(line_of[n]);
  }
  for (std::size_t n = 0; n < across.size(); ++n)
    if (first_of_body(beside[n], *seen[line_of_across[n]]) != beside[n].end()) outside.push_back(line_of_across[n]);
  for (const std::size_t line : outside) seen[line].reset();
}

}  // namespace

FacingSurfaces find_facing_surfaces(const Mesh& mesh, const std::vector<char>& bodies, double angle, std::optional<double> reach) {
  const PlaceOfNode at = reference_places(mesh);
  const Patches patches = find_patches(mesh, bodies, angle);
  std::vector<TaggedFacet> facets;
  std::vector<LineSegment> lines;
  std::vector<int> part_of_line;
  std::vector<double> reach_of_line;
  double longest = 0.0;
  Box3 model;
  for (std::size_t b = 0; b < mesh.bodies.size(); ++b) {
    if (!bodies[b]) continue;
    const SideSet& surface = whole_surface(mesh, b);
    for (LocalOrdinal s = 0; s < surface.owned; ++s) {
      const Side& side = surface.sides[static_cast<std::size_t>(s)];
      const int part = patches.of_sides[b][static_cast<std::size_t>(s)];
      facets.push_back({places_of(mesh, side, at), part});
      const double far = reach.value_or(side_lengths(mesh, side, at).back());
      longest = std::max(longest, side_lengths(mesh, side, at).back());
      for (const Eigen::Vector3d& x : facets.back().points) model.enclose(x);
      for (const SurfacePoint& point : surface_points(mesh.dimension, facets.back().points)) {
        lines.push_back({point.x, point.normal, -far, far});
        part_of_line.push_back(part);
        reach_of_line.push_back(far);
      }
    }
  }
  const double length = boxes_over_ranks(*mesh.comm, {model}).front().diagonal(), tolerance = touching * length;
  double longest_of_all = 0.0;
  Teuchos::reduceAll(*mesh.comm, Teuchos::REDUCE_MAX, longest, Teuchos::outArg(longest_of_all));
  // Lines go on to where facets may come within the reach of contact, to see what stands behind.
  for (LineSegment& line : lines) line.low -= tolerance, line.high = std::max(line.high, longest_of_all) + tolerance;
  std::map<std::array<int, 2>, std::array<double, 2>> mine;  // gap, probes
  const auto found = crossings(*mesh.comm, mesh.dimension, facets, lines);
  const auto add = [](auto& all, const std::array<int, 2>& key, double gap, double probes) {
    auto& entry = all.emplace(key, std::array<double, 2>{std::numeric_limits<double>::max(), 0.0}).first->second;
    entry[0] = std::min(entry[0], gap);
    entry[1] += probes;
  };
  std::vector<std::optional<Crossing>> others;
  for (std::size_t line = 0; line < lines.size(); ++line)
    others.push_back(seen(found[line], part_of_line[line], patches.parts, tolerance, reach_of_line[line]));
  keep_overlaps(mesh, facets, lines, patches.parts, tolerance, length, others);
  for (std::size_t line = 0; line < lines.size(); ++line)
    if (const auto& other = others[line]) {
      const std::array<int, 2> key{std::min(part_of_line[line], other->tag), std::max(part_of_line[line], other->tag)};
      add(mine, key, std::abs(other->s) <= tolerance ? 0.0 : other->s, 1.0);
    }
  std::map<std::array<int, 2>, std::array<double, 2>> hidden;  // from and what is hidden: distance, probes
  for (std::size_t line = 0; line < lines.size(); ++line) {
    if (!others[line]) continue;
    const auto body_of = [&](int part) { return patches.parts[static_cast<std::size_t>(part)].body; };
    for (const Crossing& crossing : found[line])
      if (crossing.s > others[line]->s + tolerance && crossing.along < -facing && body_of(crossing.tag) != body_of(part_of_line[line]) &&
          body_of(crossing.tag) != body_of(others[line]->tag))
        add(hidden, {part_of_line[line], crossing.tag}, crossing.s, 1.0);
  }
  const auto over_ranks = [&](const std::map<std::array<int, 2>, std::array<double, 2>>& of_rank) {
    std::vector<double> sent;
    for (const auto& [key, entry] : of_rank) sent.insert(sent.end(), {static_cast<double>(key[0]), static_cast<double>(key[1]), entry[0], entry[1]});
    std::map<std::array<int, 2>, std::array<double, 2>> all;
    const std::vector<double> received = gather(*mesh.comm, sent);
    for (auto row = received.begin(); row != received.end(); row += 4) add(all, {static_cast<int>(row[0]), static_cast<int>(row[1])}, row[2], row[3]);
    return all;
  };
  FacingSurfaces result{patches.parts, {}, {}};
  for (const auto& [key, entry] : over_ranks(mine)) result.facing.push_back({key[0], key[1], entry[0], static_cast<long>(entry[1])});
  for (const auto& [key, entry] : over_ranks(hidden)) result.hidden.push_back({key[0], key[1], entry[0]});
  return result;
}

}  // namespace mortise
