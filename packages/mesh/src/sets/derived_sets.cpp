// Sets that are derived from others.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_Import.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <tuple>

#include "mortise/core/names.hpp"
#include "mortise/mesh/sets.hpp"
#include "mortise/mesh/surface_patches.hpp"

namespace mortise {

void SetOptions::describe(Parameters& parameters) {
  parameters.add("of", of, Says("the sets it is taken from, their union: \"body/side\", or \"body\" for all nodes of a body").required());
  parameters.add("also in", also_in, "sets that contain each node or side that is kept");
  parameters.add("not in", not_in, "sets that contain no node or side that is kept");
  parameters.add("where", where,
                 Says("expression of x, y and z; kept are nodes, or sides by their middle, where it is > 0 in the reference position"));
  parameters.add("box", box,
                 Says("box that contains what is kept: its lowest and its highest corner, \"x, y, x, y\" or \"x, y, z, x, y, z\"").unit("length"));
  parameters.add("sphere", sphere,
                 Says("circle or ball that contains what is kept: its middle and radius, \"x, y, r\" or \"x, y, z, r\"").unit("length"));
  parameters.add("normal", normal, "outward normal of the sides that are kept, \"x, y\" or \"x, y, z\"");
  parameters.add("angle", angle, Says("largest angle between the normal of a side and \"normal\"").unit("degrees").at_least(0.0).at_most(180.0));
  parameters.add(
      "patch", patch,
      Says("a point, \"x, y\" or \"x, y, z\": the smooth part of the surface around the side nearest to it is kept; edges bound it").unit("length"));
  parameters.add("patch angle", patch_angle,
                 Says("angle between the normals of two sides above which they meet at an edge").unit("degrees").at_least(0.0).at_most(180.0));
  parameters.add("nearest", nearest,
                 Says("of all that fulfils the rest, the one node or side nearest to this point, \"x, y\" or \"x, y, z\"").unit("length"));
  parameters.add("kind", kind, {{"nodes", SetKind::nodes}, {"sides", SetKind::sides}}, Says("nodes or sides"));
  if (!normal.empty() && kind == SetKind::nodes) parameters.error("normal", "only sides have a normal; please add \"kind\" (string, sides)");
  if (!patch.empty() && kind == SetKind::nodes) parameters.error("patch", "a patch is made of sides; please add \"kind\" (string, sides)");
}

namespace {

using Position = std::array<double, 3>;

/// Runs `select` on every rank; an error of any rank (a `where` that is not finite somewhere) surfaces on all.
template <class Select>
void collectively(const Communicator& comm, Select&& select) {
  std::vector<Diagnostic> diagnostics;
  try {
    select();
  } catch (const InputError& error) {
    diagnostics = error.diagnostics();
  }
  throw_if_any(comm, diagnostics);
}

/// The conditions that have as many numbers as they need.
void check_numbers(const Named<SetOptions>& set, int dimension) {
  const auto d = static_cast<std::size_t>(dimension);
  const auto check = [&](const char* name, const std::vector<double>& numbers, std::size_t needed) {
    if (!numbers.empty() && numbers.size() != needed)
      throw InputError(set.place,
                       fmt::format("\"{}\" of set \"{}\" has {} numbers; in {}D it needs {}", name, set.name, numbers.size(), dimension, needed));
  };
  const SetOptions& options = set.value;
  check("box", options.box, 2 * d);
  check("sphere", options.sphere, d + 1);
  check("normal", options.normal, d);
  check("patch", options.patch, d);
  check("nearest", options.nearest, d);
  for (std::size_t i = 0; i + d < options.box.size(); ++i)
    if (options.box[i] > options.box[i + d])
      throw InputError(set.place, fmt::format("\"box\" of set \"{}\" begins at {} and ends at {} in direction {}; please give the lower corner first",
                                              set.name, options.box[i], options.box[i + d], "xyz"[i]));
  if (!options.normal.empty() && std::all_of(options.normal.begin(), options.normal.end(), [](double n) { return n == 0.0; }))
    throw InputError(set.place, fmt::format("\"normal\" of set \"{}\" is zero; it has to have a direction", set.name));
}

/// Do the conditions on places hold?
bool lies_within(const SetOptions& options, int dimension, const Position& x) {
  if (!(options.where(0.0, x[0], x[1], x[2]) > 0.0)) return false;
  for (int i = 0; i < dimension && !options.box.empty(); ++i)
    if (x[i] < options.box[i] || x[i] > options.box[dimension + i]) return false;
  if (options.sphere.empty()) return true;
  double squared = 0.0;
  for (int i = 0; i < dimension; ++i) squared += (x[i] - options.sphere[i]) * (x[i] - options.sphere[i]);
  return squared <= options.sphere.back() * options.sphere.back();
}

double squared_distance_to(const std::vector<double>& point, const Position& x) {
  double squared = 0.0;
  for (std::size_t i = 0; i < point.size(); ++i) squared += (x[i] - point[i]) * (x[i] - point[i]);
  return squared;
}

double least_over_ranks(const Communicator& comm, double mine) {
  double least = mine;
  Teuchos::reduceAll(comm, Teuchos::REDUCE_MIN, mine, Teuchos::outArg(least));
  return least;
}

/// Keeps of `members` the one nearest to a point; of several the one of the lowest number. Collective.
template <class Member, class At, class Number>
void keep_nearest(const Communicator& comm, const std::vector<double>& point, std::vector<Member>& members, const At& at, const Number& number) {
  double distance = std::numeric_limits<double>::max();
  for (const Member& member : members) distance = std::min(distance, squared_distance_to(point, at(member)));
  const double least = least_over_ranks(comm, distance);
  GlobalOrdinal lowest = std::numeric_limits<GlobalOrdinal>::max(), of_all = lowest;
  for (const Member& member : members)
    if (squared_distance_to(point, at(member)) == least) lowest = std::min(lowest, number(member));
  Teuchos::reduceAll(comm, Teuchos::REDUCE_MIN, lowest, Teuchos::outArg(of_all));
  members.erase(std::remove_if(members.begin(), members.end(), [&](const Member& member) { return number(member) != of_all; }), members.end());
}

void require_any(const Communicator& comm, LocalOrdinal owned, const Named<SetOptions>& set, const char* what) {
  const GlobalOrdinal local = owned;
  GlobalOrdinal total = 0;
  Teuchos::reduceAll(comm, Teuchos::REDUCE_SUM, 1, &local, &total);
  if (total > 0) return;
  const SetOptions& options = set.value;
  std::vector<std::string> conditions;
  if (!options.also_in.value.empty()) conditions.push_back("is in " + quoted_list(options.also_in.value));
  if (!options.not_in.value.empty()) conditions.push_back("is not in " + quoted_list(options.not_in.value));
  if (!options.where.is_constant()) conditions.push_back("has " + options.where.source() + " > 0");
  if (options.where.is_constant() && !(options.where() > 0.0)) conditions.push_back("has " + options.where.source() + " > 0");
  if (!options.box.empty()) conditions.push_back(fmt::format("lies in the box {}", fmt::join(options.box, ", ")));
  if (!options.sphere.empty()) conditions.push_back(fmt::format("lies in the sphere {}", fmt::join(options.sphere, ", ")));
  if (!options.normal.empty())
    conditions.push_back(fmt::format("has a normal within {} degrees of {}", options.angle, fmt::join(options.normal, ", ")));
  throw InputError(set.place, fmt::format("set \"{}\" is empty: no {} of {}{}{}", set.name, what, quoted_list(options.of.value),
                                          conditions.empty() ? "" : " ", fmt::join(conditions, " and ")));
}

/// Marks of local nodes: how many of the sets have each.
std::vector<char> nodes_in(const Mesh& mesh, const Located<std::vector<std::string>>& names, bool in_all) {
  std::vector<char> marks(static_cast<std::size_t>(mesh.local_count()), static_cast<char>(in_all ? 1 : 0));
  for (const std::string& name : names.value) {
    std::vector<char> of_set(marks.size(), 0);
    for (const LocalOrdinal node : require_node_set(mesh, {name, names.place})) of_set[static_cast<std::size_t>(node)] = 1;
    for (std::size_t n = 0; n < marks.size(); ++n) marks[n] = static_cast<char>(in_all ? marks[n] & of_set[n] : marks[n] | of_set[n]);
  }
  return marks;
}

std::vector<LocalOrdinal> derived_nodes(const Mesh& mesh, const Named<SetOptions>& set) {
  const SetOptions& options = set.value;
  const auto any = nodes_in(mesh, options.of, false), all = nodes_in(mesh, options.also_in, true), none = nodes_in(mesh, options.not_in, false);
  std::vector<LocalOrdinal> kept;
  collectively(*mesh.comm, [&] {
    for (LocalOrdinal node = 0; node < mesh.local_count(); ++node) {
      const auto n = static_cast<std::size_t>(node);
      if (any[n] && all[n] && !none[n] && lies_within(options, mesh.dimension, mesh.coordinates[n])) kept.push_back(node);
    }
  });
  if (!options.nearest.empty())
    keep_nearest(
        *mesh.comm, options.nearest, kept, [&](LocalOrdinal node) { return mesh.coordinates[static_cast<std::size_t>(node)]; },
        [&](LocalOrdinal node) { return mesh.local_nodes->getGlobalElement(node); });
  return kept;
}

using SideKey = std::tuple<LocalOrdinal, LocalOrdinal, int>;
SideKey key_of(const Side& side) { return {side.block, side.element, side.side}; }

std::vector<SideKey> keys_of(const SideSet& set) {
  std::vector<SideKey> keys;
  for (const Side& side : set.sides) keys.push_back(key_of(side));
  std::sort(keys.begin(), keys.end());
  return keys;
}

bool has_normal(const SetOptions& options, const Mesh& mesh, const Side& side) {
  if (options.normal.empty()) return true;
  const Position n = normal_of(mesh, side);
  double along = 0.0, wanted = 0.0;
  for (std::size_t i = 0; i < options.normal.size(); ++i) along += n[i] * options.normal[i], wanted += options.normal[i] * options.normal[i];
  const double cosine = along / (std::sqrt(wanted) * std::hypot(n[0], n[1], n[2]));
  return cosine >= std::cos(options.angle * M_PI / 180.0) - 1e-12;
}

/// The sides of several sets, each once.
SideSet union_of(const Mesh& mesh, const Located<std::vector<std::string>>& names) {
  SideSet all;
  std::vector<SideKey> before;  // of the sets that have been gone through
  for (const std::string& name : names.value) {
    const SideSet& source = require_side_set(mesh, {name, names.place});
    for (const Side& side : source.sides)
      if (!std::binary_search(before.begin(), before.end(), key_of(side))) all.sides.push_back(side);
    const auto keys = keys_of(source);
    before.insert(before.end(), keys.begin(), keys.end());
    std::sort(before.begin(), before.end());
  }
  return all;
}

void put_owned_sides_first(const Mesh& mesh, SideSet& set) {
  const auto is_owned = [&](const Side& side) { return side.element < mesh.blocks[side.block].owned; };
  std::stable_partition(set.sides.begin(), set.sides.end(), is_owned);
  set.owned = static_cast<LocalOrdinal>(std::count_if(set.sides.begin(), set.sides.end(), is_owned));
}

/// The patch around the side nearest to a point. Collective.
void keep_patch(const Mesh& mesh, const SetOptions& options, SideSet& set) {
  std::vector<Side> nearest = set.sides;
  keep_nearest(
      *mesh.comm, options.patch, nearest, [&](const Side& side) { return middle_of(mesh, side); },
      [&](const Side& side) { return side_number(mesh, side); });
  const std::vector<GlobalOrdinal> patches = patches_of(mesh, set, options.patch_angle);
  GlobalOrdinal mine = 0, wanted = 0;
  for (std::size_t s = 0; s < patches.size(); ++s)
    if (!nearest.empty() && key_of(set.sides[s]) == key_of(nearest.front())) mine = patches[s];
  Teuchos::reduceAll(*mesh.comm, Teuchos::REDUCE_MAX, mine, Teuchos::outArg(wanted));
  std::vector<Side> kept;
  for (std::size_t s = 0; s < patches.size(); ++s)
    if (patches[s] == wanted) kept.push_back(set.sides[s]);
  set.sides = std::move(kept);
}

SideSet derived_sides(const Mesh& mesh, const Named<SetOptions>& set) {
  const SetOptions& options = set.value;
  SideSet all = union_of(mesh, options.of);
  put_owned_sides_first(mesh, all);
  if (!options.patch.empty()) keep_patch(mesh, options, all);
  std::vector<std::vector<SideKey>> with, without;
  for (const std::string& name : options.also_in.value) with.push_back(keys_of(require_side_set(mesh, {name, options.also_in.place})));
  for (const std::string& name : options.not_in.value) without.push_back(keys_of(require_side_set(mesh, {name, options.not_in.place})));
  SideSet kept;
  collectively(*mesh.comm, [&] {
    for (const Side& side : all.sides) {
      const auto has = [key = key_of(side)](const std::vector<SideKey>& keys) { return std::binary_search(keys.begin(), keys.end(), key); };
      if (!std::all_of(with.begin(), with.end(), has) || std::any_of(without.begin(), without.end(), has)) continue;
      if (lies_within(options, mesh.dimension, middle_of(mesh, side)) && has_normal(options, mesh, side)) kept.sides.push_back(side);
    }
  });
  if (!options.nearest.empty())
    keep_nearest(
        *mesh.comm, options.nearest, kept.sides, [&](const Side& side) { return middle_of(mesh, side); },
        [&](const Side& side) { return side_number(mesh, side); });
  put_owned_sides_first(mesh, kept);
  return kept;
}

/// Nodes of the sides, on every rank that has the node: the owner has all sides at a node and tells the others.
std::vector<LocalOrdinal> nodes_of_sides(const Mesh& mesh, const SideSet& set) {
  Vector owned(mesh.owned_nodes), local(mesh.local_nodes);
  {
    auto marks = owned.getLocalViewHost(Tpetra::Access::ReadWrite);
    for (const auto& side : set.sides)
      for (const LocalOrdinal node : mesh.side_nodes(side))
        if (node < mesh.owned_count()) marks(node, 0) = 1.0;
  }
  local.doImport(owned, Import(mesh.owned_nodes, mesh.local_nodes), Tpetra::INSERT);
  const auto marks = local.getLocalViewHost(Tpetra::Access::ReadOnly);
  std::vector<LocalOrdinal> nodes;
  for (LocalOrdinal n = 0; n < mesh.local_count(); ++n)
    if (marks(n, 0) != 0.0) nodes.push_back(n);
  return nodes;
}

}  // namespace

void add_set(Mesh& mesh, const Named<SetOptions>& set) {
  if (mesh.node_sets.count(set.name)) throw InputError(set.place, fmt::format("there is already a set named \"{}\"", set.name));
  check_numbers(set, mesh.dimension);
  if (set.value.kind == SetKind::nodes) {
    auto kept = derived_nodes(mesh, set);
    const auto owned = std::lower_bound(kept.begin(), kept.end(), mesh.owned_count()) - kept.begin();
    require_any(*mesh.comm, static_cast<LocalOrdinal>(owned), set, "node");
    mesh.node_sets[set.name] = std::move(kept);
    return;
  }
  SideSet kept = derived_sides(mesh, set);
  require_any(*mesh.comm, kept.owned, set, "side");
  mesh.node_sets[set.name] = nodes_of_sides(mesh, kept);
  mesh.side_sets[set.name] = std::move(kept);
}

void add_sets(Mesh& mesh, const std::vector<Named<SetOptions>>& sets) {
  std::vector<const Named<SetOptions>*> waiting;
  for (const auto& set : sets) waiting.push_back(&set);
  std::set<std::string> failed;
  std::vector<Diagnostic> diagnostics;
  const auto needs = [](const Named<SetOptions>& set, const auto& holds) {
    for (const auto* names : {&set.value.of, &set.value.also_in, &set.value.not_in})
      if (std::any_of(names->value.begin(), names->value.end(), holds)) return true;
    return false;
  };
  for (bool goes_on = true; goes_on;) {
    goes_on = false;
    const std::vector<const Named<SetOptions>*> before = std::move(waiting);
    waiting.clear();
    std::set<std::string> later;
    for (const auto* set : before) later.insert(set->name);
    for (const auto* set : before) {
      if (needs(*set, [&](const std::string& name) { return later.count(name) > 0; })) {
        waiting.push_back(set);
        continue;
      }
      goes_on = true;
      later.erase(set->name);
      if (needs(*set, [&](const std::string& name) { return failed.count(name) > 0; })) {
        failed.insert(set->name);  // what is wrong has been said
        continue;
      }
      try {
        add_set(mesh, *set);
      } catch (const InputError& error) {
        failed.insert(set->name);
        diagnostics.insert(diagnostics.end(), error.diagnostics().begin(), error.diagnostics().end());
      }
    }
  }
  for (const auto* set : waiting) diagnostics.push_back({set->place, fmt::format("set \"{}\" is made of itself, or of sets that are", set->name)});
  if (!diagnostics.empty()) throw InputError(diagnostics);
}

}  // namespace mortise
