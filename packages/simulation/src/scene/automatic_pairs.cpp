#include "scene/automatic_pairs.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Teuchos_CommHelpers.hpp>
#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <set>

#include "mortise/core/names.hpp"
#include "mortise/input/expression.hpp"
#include "mortise/mesh/sets.hpp"
#include "mortise/mesh/surface_patches.hpp"
#include "mortise/simulation/scene/scene_bodies.hpp"
#include "scene/roles.hpp"
#include "surfaces/body_surfaces.hpp"
#include "surfaces/facing_patches.hpp"

namespace mortise {

void AutomaticContactOptions::describe(Parameters& parameters) {
  parameters.add("pairs", pairs, {{"none", ContactSearch::none}, {"automatic", ContactSearch::automatic}},
                 "automatic: finds pairs of surfaces of different bodies that face one another at the start and are not tied. The log and "
                 "effective.xml list them with the choice of their sides");
  parameters.add("bodies", bodies, "bodies that may touch one another; empty: all");
  parameters.add(
      "reach", reach,
      Says("surfaces further apart are left alone; left out: as far as the longest edge of the facet that looks").unit("length").at_least(0.0));
  parameters.add(
      "patch angle", angle,
      Says("surfaces are split into patches at edges where the normals of facets differ by more").unit("degrees").at_least(0.0).at_most(180.0));
  start.describe(parameters);
  contact.describe(parameters);
  parameters.list("heat", heat, "heat across the pairs, in a scene with temperatures");
}

namespace {

constexpr double same_curvature = 0.01;  ///< of SurfacePart::turn, below which no side is the more curved one
constexpr double same_place = 1e-9;      ///< over the size of a part
constexpr double about_to_touch = 0.1;   ///< gap over the shortest facet, up to which a body counts among those that a part faces

std::vector<char> bodies_that_take_part(const Mesh& mesh, const Located<std::vector<std::string>>& names) {
  std::vector<std::string> known;
  for (const MeshBody& body : mesh.bodies) known.push_back(body.name);
  std::vector<char> chosen(known.size(), names.value.empty() ? 1 : 0);
  for (const std::string& name : names.value) {
    const auto found = std::find(known.begin(), known.end(), name);
    if (found == known.end()) throw InputError(names.place, unknown_name("body", name, known));
    chosen[static_cast<std::size_t>(found - known.begin())] = 1;
  }
  return chosen;
}

/// Surfaces of bodies that are tied to one another make no pairs. Collective.
void leave_out_tied(const Mesh& mesh, const Scene& scene, FacingSurfaces& found) {
  std::set<std::pair<std::size_t, std::size_t>> tied;
  for (const auto& tie : scene.ties)
    for (const SidesOfBody& slave : sides_by_body(mesh, require_side_set(mesh, tie.value.slave)))
      for (const SidesOfBody& master : sides_by_body(mesh, require_side_set(mesh, tie.value.master)))
        tied.insert(std::minmax(slave.body, master.body));
  const auto body = [&](int part) { return static_cast<std::size_t>(found.parts[static_cast<std::size_t>(part)].body); };
  const auto are_tied = [&](const FacingParts& pair) { return tied.count(std::minmax(body(pair.first), body(pair.second))) > 0; };
  found.facing.erase(std::remove_if(found.facing.begin(), found.facing.end(), are_tied), found.facing.end());
}

/// A part, or what of it lies nearer to one of those that face it than to the others.
struct Zone {
  int part = 0;
  std::optional<int> facing;  ///< the part that it was split off for
};

/// Two zones that become a pair.
struct Edge {
  int first = 0, second = 0;
  double gap = 0.0;  ///< FacingParts::gap
};

class PairMaker {
 public:
  PairMaker(const Mesh& mesh, Scene& scene, FacingSurfaces found) : mesh_(mesh), scene_(scene), found_(std::move(found)) {
    std::vector<double> mine(mesh.bodies.size(), 0.0);  // the stiffest material of each body; infinite for a rigid one
    for (const Block& block : mesh.blocks)
      mine[static_cast<std::size_t>(block.body)] = std::max(mine[static_cast<std::size_t>(block.body)], youngs_modulus(scene, mesh, block));
    modulus_ = mine;
  }

  void add_pairs() {
    make_zones();
    if (!choose_sides()) {
      split_parts();
      choose_sides();
    }
    // One slave has all of its masters in one pair, and slaves of one body that have the same bodies as masters are one.
    std::map<int, std::vector<int>> masters;
    for (const Edge& edge : edges_) {
      const bool first = is_slave_[static_cast<std::size_t>(edge.first)];
      masters[first ? edge.first : edge.second].push_back(first ? edge.second : edge.first);
    }
    std::map<std::pair<int, std::set<int>>, std::array<std::set<int>, 2>> pairs;
    for (const auto& [slave, of_slave] : masters) {
      std::set<int> bodies;
      for (const int master : of_slave) bodies.insert(part(master).body);
      auto& [slaves, all_masters] = pairs[{part(slave).body, bodies}];
      slaves.insert(slave);
      all_masters.insert(of_slave.begin(), of_slave.end());
    }
    for (const auto& [bodies, sides] : pairs) add_pair(sides[0], sides[1]);
  }

 private:
  const SurfacePart& part(int zone) const { return found_.parts[static_cast<std::size_t>(zones_[static_cast<std::size_t>(zone)].part)]; }
  bool is_rigid_part(const SurfacePart& one) const { return mesh_.bodies[static_cast<std::size_t>(one.body)].is_surface; }

  SurfaceTraits traits(int zone) const {
    const SurfacePart& one = part(zone);
    std::set<int> bodies;
    for (const Edge& edge : edges_)
      if ((edge.first == zone || edge.second == zone) && edge.gap <= about_to_touch * one.shortest)
        bodies.insert(part(edge.first == zone ? edge.second : edge.first).body);
    return {modulus_[static_cast<std::size_t>(one.body)], one.shortest, std::max(1, static_cast<int>(bodies.size()))};
  }

  void make_zones() {
    std::map<int, int> zone_of_part;
    const auto zone = [&](int p) {
      const auto [found, is_new] = zone_of_part.try_emplace(p, static_cast<int>(zones_.size()));
      if (is_new) zones_.push_back({p, std::nullopt});
      return found->second;
    };
    for (const FacingParts& pair : found_.facing) {
      if (is_rigid_part(found_.parts[static_cast<std::size_t>(pair.first)]) && is_rigid_part(found_.parts[static_cast<std::size_t>(pair.second)]))
        continue;
      const int first = zone(pair.first), second = zone(pair.second);
      edges_.push_back({first, second, pair.gap});
    }
  }

  /// Each zone for each that faces it.
  void split_parts() {
    std::vector<Zone> zones;
    std::vector<Edge> edges;
    for (const Edge& edge : edges_) {
      const Zone &one = zones_[static_cast<std::size_t>(edge.first)], &other = zones_[static_cast<std::size_t>(edge.second)];
      const auto first = static_cast<int>(zones.size());
      zones.push_back({one.part, other.part});
      zones.push_back({other.part, one.part});
      edges.push_back({first, first + 1, edge.gap});
    }
    zones_ = std::move(zones);
    edges_ = std::move(edges);
  }

  /// Above 0: the first is the better slave.
  double better(int first, int second) const {
    const SurfacePart &one = part(first), &other = part(second);
    if (is_rigid_part(one) != is_rigid_part(other)) return is_rigid_part(other) ? 1e300 : -1e300;
    const RoleChoice choice = better_slave(traits(first), traits(second));
    const double weight = std::min(one.area, other.area);
    if (!choice.is_tie) return choice.is_first ? weight : -weight;
    if (std::abs(one.turn - other.turn) > same_curvature) return one.turn > other.turn ? weight : -weight;
    for (int i = 0; i < 3; ++i)
      if (const double apart = one.centre[i] - other.centre[i]; std::abs(apart) > same_place * std::max(one.area, other.area))
        return apart < 0.0 ? 1e-6 * weight : -1e-6 * weight;
    // Surfaces that lie on one another: flat ones face different ways. Closed ones around one another are not equally curved.
    constexpr double same_direction = 1e-6;
    for (int i = 0; i < 3; ++i)
      if (const double apart = one.normal[i] - other.normal[i]; std::abs(apart) > same_direction) return apart > 0.0 ? 1e-7 * weight : -1e-7 * weight;
    return one.number < other.number ? 1e-9 * weight : -1e-9 * weight;
  }

  /// Slaves and masters alternate along edges. Of the two ways for zones that hang together the better one is taken.
  /// @return false if some zone would have to be both, or two rigid ones would be slaves
  bool choose_sides() {
    std::vector<int> side(zones_.size(), 0);  // +1 and -1
    is_slave_.assign(zones_.size(), 0);
    for (std::size_t start = 0; start < zones_.size(); ++start) {
      if (side[start] != 0) continue;
      side[start] = 1;
      std::vector<int> members{static_cast<int>(start)};
      for (std::size_t next = 0; next < members.size(); ++next)
        for (const Edge& edge : edges_) {
          if (edge.first != members[next] && edge.second != members[next]) continue;
          const int other = edge.first == members[next] ? edge.second : edge.first;
          int& of_other = side[static_cast<std::size_t>(other)];
          const int wanted = -side[static_cast<std::size_t>(members[next])];
          if (of_other == 0) members.push_back(other);
          if (of_other != 0 && of_other != wanted) return false;
          of_other = wanted;
        }
      double votes = 0.0;  // for +1
      for (const Edge& edge : edges_)
        if (std::find(members.begin(), members.end(), edge.first) != members.end())
          votes += side[static_cast<std::size_t>(edge.first)] * better(edge.first, edge.second);
      for (const int zone : members) {
        is_slave_[static_cast<std::size_t>(zone)] = (side[static_cast<std::size_t>(zone)] > 0) == (votes >= 0.0);
        if (is_slave_[static_cast<std::size_t>(zone)] && is_rigid_part(part(zone))) return false;
      }
    }
    return true;
  }

  /// A side set that has the part's sides and no others.
  std::optional<std::string> named_set(const SurfacePart& one) {
    const std::string body = mesh_.bodies[static_cast<std::size_t>(one.body)].name + "/";
    const SideSet& surface = mesh_.side_sets.at(body + "surface");
    if (patches_.count(one.body) == 0) patches_[one.body] = patches_of(mesh_, surface, scene_.automatic_contact.angle);
    const std::vector<GlobalOrdinal>& patches = patches_.at(one.body);
    std::set<std::array<LocalOrdinal, 3>> mine;
    for (LocalOrdinal s = 0; s < surface.owned; ++s)
      if (patches[static_cast<std::size_t>(s)] == one.number) {
        const Side& side = surface.sides[static_cast<std::size_t>(s)];
        mine.insert({side.block, side.element, side.side});
      }
    for (const auto& [name, set] : mesh_.side_sets) {
      if (name.rfind(body, 0) != 0) continue;
      std::set<std::array<LocalOrdinal, 3>> of_set;
      for (LocalOrdinal s = 0; s < set.owned; ++s)
        of_set.insert({set.sides[static_cast<std::size_t>(s)].block, set.sides[static_cast<std::size_t>(s)].element,
                       set.sides[static_cast<std::size_t>(s)].side});
      const int differs = of_set == mine ? 0 : 1;
      int anywhere = 0;
      Teuchos::reduceAll(*mesh_.comm, Teuchos::REDUCE_MAX, differs, Teuchos::outArg(anywhere));
      if (anywhere == 0) return name;
    }
    return std::nullopt;
  }

  std::string free_set_name(const std::string& wanted) const {
    const auto is_taken = [&](const std::string& name) {
      return mesh_.node_sets.count(name) > 0 ||
             std::any_of(scene_.sets.begin(), scene_.sets.end(), [&](const auto& set) { return set.name == name; });
    };
    std::string name = wanted;
    for (int n = 2; is_taken(name); ++n) name = fmt::format("{} {}", wanted, n);
    return name;
  }

  std::vector<double> in_dimension(const Eigen::Vector3d& x) const { return {x.data(), x.data() + mesh_.dimension}; }

  /// The name of the set of a zone, which is added to the scene if there is none yet.
  std::string set_of(int zone) {
    const Zone& of = zones_[static_cast<std::size_t>(zone)];
    const auto key = std::pair(of.part, of.facing.value_or(-1));
    if (const auto found = sets_.find(key); found != sets_.end()) return found->second;
    const SurfacePart& one = part(zone);
    if (!of.facing)
      if (const auto name = named_set(one)) return sets_[key] = *name;
    const std::string& body = mesh_.bodies[static_cast<std::size_t>(one.body)].name;
    Named<SetOptions> set;
    set.name = free_set_name(body + " patch");
    set.place = scene_.automatic_contact.bodies.place;
    set.value.of = {{body + "/surface"}, set.place};
    set.value.kind = SetKind::sides;
    set.value.patch = in_dimension(one.seed);
    set.value.patch_angle = scene_.automatic_contact.angle;
    if (of.facing) set.value.where = nearer_to(of.part, *of.facing, set.place);
    scene_.sets.push_back(set);
    return sets_[key] = set.name;
  }

  /// An expression above 0 where a point of a part is nearer to the centre of one that faces it than to those of all others. For each other one
  ///   |x - c_o|^2 - |x - c|^2 = 2 (c - c_o) . x + |c_o|^2 - |c|^2
  ScalarFunction nearer_to(int of, int facing, const Place& place) const {
    const Eigen::Vector3d c = found_.parts[static_cast<std::size_t>(facing)].centre;
    std::vector<std::string> conditions;
    for (const FacingParts& pair : found_.facing) {
      if (pair.first != of && pair.second != of) continue;
      const int other = pair.first == of ? pair.second : pair.first;
      if (other == facing) continue;
      const Eigen::Vector3d o = found_.parts[static_cast<std::size_t>(other)].centre, slope = 2.0 * (c - o);
      conditions.push_back(
          fmt::format("{:.17g} + ({:.17g})*x + ({:.17g})*y + ({:.17g})*z", o.squaredNorm() - c.squaredNorm(), slope[0], slope[1], slope[2]));
    }
    if (conditions.empty()) return ScalarFunction(1.0);
    const std::string text = conditions.size() == 1 ? conditions.front() : fmt::format("min({})", fmt::join(conditions, ", "));
    return parse_expression(text, scene_.symbols, place);
  }

  /// The names of the sets of zones, as one set if there are several.
  std::string set_of_all(const std::set<int>& zones, const std::string& name, const Place& place) {
    std::vector<std::string> sets;
    for (const int zone : zones)
      if (const std::string one = set_of(zone); std::find(sets.begin(), sets.end(), one) == sets.end()) sets.push_back(one);
    if (sets.size() == 1) return sets.front();
    Named<SetOptions> all;
    all.name = free_set_name(name);
    all.place = place;
    all.value.of = {sets, place};
    all.value.kind = SetKind::sides;
    scene_.sets.push_back(all);
    return all.name;
  }

  /// True if all bodies of the parts have a temperature.
  bool have_temperatures(const std::set<int>& parts) const {
    return std::all_of(parts.begin(), parts.end(), [&](int number) {
      return std::all_of(mesh_.blocks.begin(), mesh_.blocks.end(),
                         [&](const Block& block) { return block.body != part(number).body || has_temperature(scene_, mesh_, block); });
    });
  }

  void add_pair(const std::set<int>& slaves, const std::set<int>& masters) {
    std::vector<std::string> bodies;
    for (const int master : masters) {
      const std::string& body = mesh_.bodies[static_cast<std::size_t>(part(master).body)].name;
      if (std::find(bodies.begin(), bodies.end(), body) == bodies.end()) bodies.push_back(body);
    }
    Named<ContactPairOptions> pair;
    const std::string wanted =
        fmt::format("{} on {}", mesh_.bodies[static_cast<std::size_t>(part(*slaves.begin()).body)].name, fmt::join(bodies, " and "));
    pair.name = wanted;
    const auto is_taken = [&] {
      return std::any_of(scene_.contact.begin(), scene_.contact.end(), [&](const auto& one) { return one.name == pair.name; });
    };
    for (int n = 2; is_taken(); ++n) pair.name = fmt::format("{} {}", wanted, n);
    pair.place = scene_.automatic_contact.bodies.place;
    pair.value.slave = {set_of_all(slaves, "slaves of " + pair.name, pair.place), pair.place};
    pair.value.master = {set_of_all(masters, "masters of " + pair.name, pair.place), pair.place};
    pair.value.start = scene_.automatic_contact.start;
    pair.value.contact = scene_.automatic_contact.contact;
    pair.value.heat = scene_.automatic_contact.heat;
    if (!have_temperatures(slaves) || !have_temperatures(masters)) {  // heat does not enter a body without one
      pair.value.heat.conductance = {};
      pair.value.heat.gap = {};
    }
    pair.value.reason = reason(slaves, masters);
    if (const auto behind = hidden_master(slaves, masters)) {
      auto& reach = pair.value.contact.mortar.search_reach;
      reach = std::min(reach.value_or(std::numeric_limits<double>::max()), 0.5 * behind->distance);
      pair.value.reason += fmt::format("; its search reach is half of the {:.3g} to body '{}', which stands behind another master", behind->distance,
                                       mesh_.bodies[static_cast<std::size_t>(found_.parts[static_cast<std::size_t>(behind->hidden)].body)].name);
    }
    scene_.contact.push_back(pair);
  }

  /// The nearest of the masters that stands behind another one, seen from the slaves: within the search reach it would count beside that.
  std::optional<HiddenPart> hidden_master(const std::set<int>& slaves, const std::set<int>& masters) const {
    const auto has = [&](const std::set<int>& zones, int wanted) {
      return std::any_of(zones.begin(), zones.end(), [&](int zone) { return zones_[static_cast<std::size_t>(zone)].part == wanted; });
    };
    std::optional<HiddenPart> nearest;
    for (const HiddenPart& one : found_.hidden)
      if (has(slaves, one.from) && has(masters, one.hidden) && (!nearest || one.distance < nearest->distance)) nearest = one;
    return nearest;
  }

  /// Why the slaves are the slaves, for the log.
  std::string reason(const std::set<int>& slaves, const std::set<int>& masters) const {
    std::vector<std::string> reasons;
    for (const Edge& edge : edges_) {
      const int slave = is_slave_[static_cast<std::size_t>(edge.first)] ? edge.first : edge.second,
                master = slave == edge.first ? edge.second : edge.first;
      if (slaves.count(slave) == 0 || masters.count(master) == 0) continue;
      const SurfacePart &one = part(slave), &other = part(master);
      const RoleChoice choice = better_slave(traits(slave), traits(master));
      std::string why = choice.reason;
      if (!choice.is_tie && !choice.is_first) why = fmt::format("of the other side {}, but no surface is slave and master at once", choice.reason);
      if (choice.is_tie)
        why = std::abs(one.turn - other.turn) > same_curvature ? "it is the more curved one" : "both are alike, and it was taken by its place";
      if (std::find(reasons.begin(), reasons.end(), why) == reasons.end() && reasons.size() < 3) reasons.push_back(why);
    }
    return fmt::format("{}", fmt::join(reasons, "; "));
  }

  const Mesh& mesh_;
  Scene& scene_;
  FacingSurfaces found_;
  std::vector<double> modulus_;  ///< [bodies]
  std::vector<Zone> zones_;
  std::vector<Edge> edges_;
  std::vector<char> is_slave_;                         ///< [zones]
  std::map<int, std::vector<GlobalOrdinal>> patches_;  ///< of the sides of the bodies' surfaces, where they were asked for
  std::map<std::pair<int, int>, std::string> sets_;    ///< names by part and what it faces
};

}  // namespace

void add_automatic_pairs(const Mesh& mesh, Scene& scene) {
  const AutomaticContactOptions& options = scene.automatic_contact;
  if (options.pairs == ContactSearch::none) return;
  FacingSurfaces found = find_facing_surfaces(mesh, bodies_that_take_part(mesh, options.bodies), options.angle, options.reach);
  const bool any_faces = !found.facing.empty();
  leave_out_tied(mesh, scene, found);
  if (found.facing.empty() && any_faces)
    throw InputError(
        options.bodies.place,
        "all surfaces that face one another belong to bodies that are tied to one another, which make no pairs; please leave out \"automatic "
        "contact\", or name the pairs in \"contact\"");
  if (found.facing.empty())
    throw InputError(
        options.bodies.place,
        fmt::format("no surfaces of different bodies face one another within {}; please give a \"reach\" as long as the gaps that may close, or "
                    "leave out \"automatic contact\"",
                    options.reach ? fmt::format("{:g}", *options.reach) : "an edge of their facets"));
  PairMaker(mesh, scene, std::move(found)).add_pairs();
  scene.automatic_contact.pairs = ContactSearch::none;
}

}  // namespace mortise
