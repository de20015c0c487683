#include "mortise/simulation/model/surfaces_at_start.hpp"

#include <fmt/format.h>

#include <Teuchos_CommHelpers.hpp>
#include <algorithm>
#include <limits>
#include <set>

#include "mortise/mesh/sets.hpp"
#include "surfaces/rounded_facets.hpp"
#include "surfaces/surface_view.hpp"

namespace mortise {
namespace {

constexpr double meant_to_touch = 1e-6;  ///< of depths, over the size of the model: less was meant to touch

OverlapPlace place_of(const DeepestPoint& deepest, const std::string& surface) {
  return {deepest.depth, deepest.node, surface, {deepest.place[0], deepest.place[1], deepest.place[2]}};
}

/// A pair, or what it has of two bodies, while it is examined.
struct Examined {
  std::size_t index;  ///< of the pair in the scene
  const Named<ContactPairOptions>& options;
  SidesOfBody slave_sides, master_sides;
  NamedSurface slave, master;
  SurfaceView from_slave, from_master;
  PairAtStart result;
  bool deepest_is_slave = true;

  const DeepestPoint& deepest() const { return deepest_is_slave ? from_slave.deepest : from_master.deepest; }
  const NamedSurface& penetrating() const { return deepest_is_slave ? slave : master; }
  const NamedSurface& penetrated() const { return deepest_is_slave ? master : slave; }
  bool overlaps() const { return result.overlap.depth > 0.0; }
};

std::string where(const Mesh& mesh, const DeepestPoint& point, const std::string& surface) {
  return to_string(mesh.dimension, place_of(point, surface));
}

/// Distances that facets leave of the arcs of two surfaces, one of which is hollow where the other is convex.
std::array<double, 2> conforming_arcs(const RoundedFacets& slave, const RoundedFacets& master, double least) {
  const bool slave_is_hollow = slave.deepest > slave.highest, master_is_hollow = master.deepest > master.highest;
  if (slave.arc() <= least || master.arc() <= least || slave_is_hollow == master_is_hollow) return {0.0, 0.0};
  return {slave.arc(), master.arc()};
}

Examined examine(const PlacedBodies& bodies, std::size_t index, const Named<ContactPairOptions>& options, const SidesOfBody& slave,
                 const SidesOfBody& master) {
  const Mesh& mesh = bodies.mesh;
  Examined pair{
      index, options, slave, master, {options.value.slave.value, *slave.set, slave.body}, {options.value.master.value, *master.set, master.body},
      {},    {},      {}};
  PairAtStart& result = pair.result;
  result.facets = {longest_facet(mesh, pair.slave.set, bodies.at), longest_facet(mesh, pair.master.set, bodies.at)};
  result.longest = std::max(result.facets[0], result.facets[1]);
  if (pair.slave.body == pair.master.body) return pair;  // what lies within a body lies within itself
  pair.from_slave = look(bodies, pair.slave, pair.master);
  pair.from_master = look(bodies, pair.master, pair.slave);
  pair.deepest_is_slave = pair.from_slave.deepest.depth >= pair.from_master.deepest.depth;
  result.arcs = conforming_arcs(round_facets(mesh, pair.slave.set, bodies.at), round_facets(mesh, pair.master.set, bodies.at), bodies.touching);
  result.is_swallowed = pair.from_slave.swallowed >= most_of_a_surface * pair.from_slave.probes;
  if (pair.deepest().depth > 0.0) result.overlap = place_of(pair.deepest(), pair.penetrating().name);
  return pair;
}

/// Adds the findings on two bodies to those of a pair whose surfaces belong to several bodies.
void add(PairAtStart& pair, const PairAtStart& of_bodies) {
  pair.longest = std::max(pair.longest, of_bodies.longest);
  if (of_bodies.overlap.depth > pair.overlap.depth) pair.overlap = of_bodies.overlap;
  if (of_bodies.gap) pair.gap = std::min(pair.gap.value_or(*of_bodies.gap), *of_bodies.gap);
  for (std::size_t side = 0; side < 2; ++side) {
    pair.arcs[side] = std::max(pair.arcs[side], of_bodies.arcs[side]);
    pair.facets[side] = std::max(pair.facets[side], of_bodies.facets[side]);
  }
  if (of_bodies.reach) pair.reach = std::max(pair.reach.value_or(0.0), *of_bodies.reach);
  pair.is_swallowed = pair.is_swallowed || of_bodies.is_swallowed;
}

// Half a facet beyond the overlap, so that the first iterations do not leave it; not more than the facet that is reached anyway.
std::optional<double> needed_reach(const PairAtStart& pair) {
  const double reach = pair.overlap.depth + 0.5 * pair.longest;
  return reach > pair.longest ? std::optional(reach) : std::nullopt;
}

void complain_of_overlap(const PlacedBodies& bodies, Examined& pair, std::vector<Diagnostic>& diagnostics) {
  const auto& [name, place, options] = pair.options;
  const auto say = [&, &place = place](const std::string& text) { diagnostics.push_back({place, text}); };
  const OverlapPlace& overlap = pair.result.overlap;
  const std::string what =
      fmt::format("the surfaces overlap by {:.3g} at the start, deepest at {}", overlap.depth, to_string(bodies.mesh.dimension, overlap));
  if (options.start.initial_overlap == InitialOverlap::error) {
    // Facets that pass through the nodes of one smooth surface may overlap by what they leave of it. Of quadratic ones that is of fourth
    // order, and no pressure to speak of; linear ones have to be said to be round.
    const bool is_round = options.start.facets == FacetShape::round;
    const auto left = [&](const NamedSurface& one) { return height_of_kinks(bodies.mesh, one.set, bodies.at, is_round); };
    if (overlap.depth <= left(pair.slave) + left(pair.master)) return;
    say(what + "; \"initial overlap\" says that this is an error: please move the bodies apart, or take \"interference\"");
    return;
  }
  const bool has_back = !is_rigid(bodies.mesh, pair.penetrated().body);
  const std::optional<double> back = has_back ? distance_to_back(bodies, pair.deepest(), pair.penetrated()) : std::nullopt;
  if (back && *back < overlap.depth) {
    say(
        fmt::format("{}: more than half of the {:.3g} that body '{}' is thick there, so that it is open to which side contact has to push; please "
                    "start apart and move a body in by a boundary condition",
                    what, overlap.depth + *back, bodies.mesh.bodies[pair.penetrated().body].name));
    return;
  }
  if (const auto& reach = options.contact.mortar.search_reach; reach && *reach < overlap.depth) {
    say(fmt::format(
        "{}, beyond the search reach {:.3g}: nothing would push them apart; please give a \"search reach\" above {:.3g}, or none: then it "
        "covers the overlap",
        what, *reach, overlap.depth));
    return;
  }
  if (!options.contact.mortar.search_reach) pair.result.reach = needed_reach(pair.result);
}

void complain_of_sides(const PlacedBodies& bodies, Examined& pair, bool bodies_have_fronts, std::vector<Diagnostic>& diagnostics) {
  const auto& [name, place, options] = pair.options;
  const SurfaceView& view = pair.from_slave;
  const std::string& master_body = bodies.mesh.bodies[pair.master.body].name;
  const bool rigid = is_rigid(bodies.mesh, pair.master.body);
  if (!bodies_have_fronts && view.swallowed > 0.0 && (!rigid || pair.result.is_swallowed)) {
    diagnostics.push_back(
        {place,
         fmt::format("the slave \"{}\" begins {} '{}': from {} no front of \"{}\" lies within the slave's own body, so that nothing says to which "
                     "side it is to be pushed; the surface behind it is {:.3g} away; please move the bodies apart, or name the sides that face one "
                     "another",
                     pair.slave.name, rigid ? "behind the rigid body" : "within body", master_body,
                     where(bodies.mesh, view.swallowed_at, pair.slave.name), pair.master.name, view.swallowed_at.depth)});
    return;
  }
  const Outlook outlook = look_ahead(bodies, pair.slave, pair.master, pair.result.longest);
  pair.result.gap = outlook.gap;
  if (pair.result.gap && *pair.result.gap <= bodies.touching) pair.result.gap = 0.0;
  if (outlook.backs)
    diagnostics.push_back(
        {place,
         fmt::format("the master \"{}\" turns its back on the slave \"{}\": no facet of it faces the slave, so nothing will ever be pressed on "
                     "it. A profile's body lies to the left of the way along its points: please give them in reverse, or take another side",
                     pair.master.name, pair.slave.name)});
}

std::vector<StrayOverlap> stray_overlaps(const PlacedBodies& bodies, const std::set<std::pair<std::size_t, std::size_t>>& connected) {
  const Mesh& mesh = bodies.mesh;
  std::vector<StrayOverlap> strays;
  for (std::size_t a = 0; a < mesh.bodies.size(); ++a)
    for (std::size_t b = a + 1; b < mesh.bodies.size(); ++b) {
      if (connected.count({a, b}) > 0 || (is_rigid(mesh, a) && is_rigid(mesh, b))) continue;
      const bool open = is_rigid(mesh, a) || is_rigid(mesh, b);  // the solid side has no box
      if (!open && !bodies.boxes[a].meets(bodies.boxes[b])) continue;
      const NamedSurface first{mesh.bodies[a].name + "/surface", whole_surface(mesh, a), a},
          second{mesh.bodies[b].name + "/surface", whole_surface(mesh, b), b};
      const SurfaceView forward = look(bodies, first, second), backward = look(bodies, second, first);
      const bool from_first = forward.deepest.depth >= backward.deepest.depth;
      const DeepestPoint& deepest = from_first ? forward.deepest : backward.deepest;
      if (deepest.depth > 0.0)
        strays.push_back({mesh.bodies[a].name, mesh.bodies[b].name, place_of(deepest, from_first ? first.name : second.name)});
      else if (const SurfaceView& within = forward.swallowed > 0.0 ? forward : backward; within.swallowed > 0.0 && !open) {
        strays.push_back(
            {mesh.bodies[a].name, mesh.bodies[b].name, place_of(within.swallowed_at, forward.swallowed > 0.0 ? first.name : second.name)});
        strays.back().overlap.depth = 0.0;
      }
    }
  return strays;
}

/// The nearest front of a master body that a point of the slave sees behind a front of another one.
struct HiddenFront {
  double distance = std::numeric_limits<double>::max();
  std::size_t hidden = 0;  ///< body
};

/// @param reach  how far behind counts
/// Collective; over all ranks.
std::optional<HiddenFront> find_hidden_front(const PlacedBodies& bodies, const SideSet& slave, const std::vector<SidesOfBody>& masters,
                                             double reach) {
  constexpr double facing = 0.5;   // cosine of the angle between opposite normals
  constexpr double hardly = 1e-3;  // of the reach
  const Mesh& mesh = bodies.mesh;
  std::vector<TaggedFacet> facets;
  for (const SidesOfBody& master : masters)
    for (LocalOrdinal s = 0; s < master.set->owned; ++s)
      facets.push_back({places_of(mesh, master.set->sides[static_cast<std::size_t>(s)], bodies.at), static_cast<int>(master.body)});
  std::vector<LineSegment> lines;
  for (const SurfaceProbe& probe : probes_of(mesh, slave, bodies.at)) lines.push_back({probe.point.x, probe.point.normal, -bodies.touching, reach});
  double mine[2] = {-std::numeric_limits<double>::max(), 0.0}, all[2];
  for (const auto& found : crossings(*mesh.comm, mesh.dimension, facets, lines)) {
    const Crossing* first = nullptr;
    for (const Crossing& crossing : found) {
      if (crossing.along > -facing) continue;
      if (first == nullptr) first = &crossing;
      const bool is_behind = crossing.tag != first->tag && crossing.s > first->s + hardly * reach;  // neighbours meet at edges
      if (!is_behind || -crossing.s <= mine[0]) continue;
      mine[0] = -crossing.s, mine[1] = crossing.tag;
    }
  }
  Teuchos::reduceAll(*mesh.comm, Teuchos::REDUCE_MAX, mine[0], Teuchos::outArg(all[0]));
  if (mine[0] < all[0]) mine[1] = 0.0;
  Teuchos::reduceAll(*mesh.comm, Teuchos::REDUCE_MAX, mine[1], Teuchos::outArg(all[1]));
  if (all[0] == -std::numeric_limits<double>::max()) return std::nullopt;
  return HiddenFront{-all[0], static_cast<std::size_t>(all[1])};
}

}  // namespace

std::string to_string(int dimension, const OverlapPlace& overlap) {
  const auto& x = overlap.place;
  return fmt::format("node {} of \"{}\" at ({:.6g}, {:.6g}{})", overlap.node, overlap.surface, x[0], x[1],
                     dimension == 3 ? fmt::format(", {:.6g}", x[2]) : "");
}

SurfacesAtStart examine_surfaces(const Mesh& mesh, const Scene& scene, double length) {
  const PlaceOfNode at = reference_places(mesh);
  const PlacedBodies bodies{mesh, at, body_boxes(mesh, at), length, meant_to_touch * length};
  std::vector<Examined> pairs;
  std::set<std::pair<std::size_t, std::size_t>> connected, with_fronts;
  for (std::size_t p = 0; p < scene.contact.size(); ++p) {
    const auto& options = scene.contact[p];
    for (const SidesOfBody& slave : sides_by_body(mesh, require_side_set(mesh, options.value.slave)))
      for (const SidesOfBody& master : sides_by_body(mesh, require_side_set(mesh, options.value.master))) {
        const Examined& pair = pairs.emplace_back(examine(bodies, p, options, slave, master));
        const auto both = std::minmax(slave.body, master.body);
        connected.insert(both);
        if (pair.overlaps()) with_fronts.insert(both);
      }
  }
  for (const auto& tie : scene.ties)
    for (const SidesOfBody& slave : sides_by_body(mesh, require_side_set(mesh, tie.value.slave)))
      for (const SidesOfBody& master : sides_by_body(mesh, require_side_set(mesh, tie.value.master)))
        connected.insert(std::minmax(slave.body, master.body));
  std::vector<Diagnostic> diagnostics;
  SurfacesAtStart result;
  result.pairs.resize(scene.contact.size());
  for (Examined& pair : pairs) {
    if (pair.overlaps())
      complain_of_overlap(bodies, pair, diagnostics);
    else
      complain_of_sides(bodies, pair, with_fronts.count(std::minmax(pair.slave.body, pair.master.body)) > 0, diagnostics);
    add(result.pairs[pair.index], pair.result);
  }
  for (std::size_t p = 0; p < scene.contact.size(); ++p) {
    const auto& [name, place, options] = scene.contact[p];
    const auto masters = sides_by_body(mesh, require_side_set(mesh, options.master));
    if (masters.size() < 2) continue;
    const double reach = options.contact.mortar.search_reach.value_or(result.pairs[p].longest);
    if (const auto hidden = find_hidden_front(bodies, require_side_set(mesh, options.slave), masters, reach))
      diagnostics.push_back(
          {place,
           fmt::format(
               "from the slave the master's surface of body '{}' stands behind that of another body, {:.3g} away and within the search reach {:.3g}: "
               "both would act on the same facets; please give a \"search reach\" of {:.3g}, or each body a pair of its own",
               mesh.bodies[hidden->hidden].name, hidden->distance, reach, 0.5 * hidden->distance)});
  }
  if (!diagnostics.empty()) throw InputError(diagnostics);
  result.strays = stray_overlaps(bodies, connected);
  return result;
}

double deepest_overlap(const Mesh& mesh, const Named<ContactPairOptions>& pair, double length) {
  const PlaceOfNode at = reference_places(mesh);
  const PlacedBodies bodies{mesh, at, body_boxes(mesh, at), length, meant_to_touch * length};
  double depth = 0.0;
  for (const SidesOfBody& slave : sides_by_body(mesh, require_side_set(mesh, pair.value.slave)))
    for (const SidesOfBody& master : sides_by_body(mesh, require_side_set(mesh, pair.value.master)))
      depth = std::max(depth, examine(bodies, 0, pair, slave, master).result.overlap.depth);
  return depth;
}

}  // namespace mortise
