#include "run/diagnosis/parts_apart.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>

#include "mortise/core/over_ranks.hpp"
#include "mortise/mesh/sets.hpp"
#include "run/diagnosis/held_bodies.hpp"
#include "surfaces/body_surfaces.hpp"

namespace mortise {
namespace {

/// Two surfaces of a pair, of one body each.
struct Sides {
  SidesOfBody slave, master;
};

std::vector<Sides> sides_of_pairs(const Mesh& mesh, const Scene& scene) {
  std::vector<Sides> all;
  for (const auto& pair : scene.contact)
    for (const SidesOfBody& slave : sides_by_body(mesh, require_side_set(mesh, pair.value.slave)))
      for (const SidesOfBody& master : sides_by_body(mesh, require_side_set(mesh, pair.value.master)))
        if (slave.body != master.body) all.push_back({slave, master});
  return all;
}

/// The outer force on each body along what is not prescribed. Collective.
std::vector<Eigen::Vector3d> loads_on_bodies(const Model& model, const SystemEvaluation& at) {
  const Mesh& mesh = *model.mesh();
  const Vector outer = outer_forces(model, at);
  const auto forces = outer.getLocalViewHost(Tpetra::Access::ReadOnly);
  const auto fixed = model.supports().fixed->getLocalViewHost(Tpetra::Access::ReadOnly);
  std::vector<double> mine(3 * mesh.bodies.size(), 0.0);
  for (LocalOrdinal node = 0; node < mesh.owned_count(); ++node)
    for (int i = 0; i < mesh.dimension; ++i)
      if (fixed(node, i) == 0.0) mine[3 * static_cast<std::size_t>(mesh.body_of_node[node]) + i] -= forces(model.space().row(node, i), 0);
  const std::vector<double> all = sum_over_ranks(*mesh.comm, mine);
  std::vector<Eigen::Vector3d> loads;
  for (std::size_t b = 0; b < mesh.bodies.size(); ++b) loads.emplace_back(all[3 * b], all[3 * b + 1], all[3 * b + 2]);
  return loads;
}

/// Distance that `moving` may go in the direction d until it meets `still`; none: it never does. Lines start at points of either surface. Collective.
std::optional<double> way_to(const Mesh& mesh, const PlaceOfNode& at, const SideSet& moving, const SideSet& still, const Eigen::Vector3d& d,
                             double length) {
  constexpr double never = std::numeric_limits<double>::max();
  double mine = never;
  for (const bool from_moving : {true, false}) {
    const SideSet &from = from_moving ? moving : still, &to = from_moving ? still : moving;
    const Eigen::Vector3d along = from_moving ? d : Eigen::Vector3d(-d);
    std::vector<LineSegment> lines;
    for (const SurfaceProbe& probe : probes_of(mesh, from, at))
      if (probe.point.normal.dot(along) > 0.0) lines.push_back({probe.point.x, along, 0.0, length});
    std::vector<TaggedFacet> facets;
    for (LocalOrdinal s = 0; s < to.owned; ++s) facets.push_back({places_of(mesh, to.sides[static_cast<std::size_t>(s)], at), 0});
    for (const auto& found : crossings(*mesh.comm, mesh.dimension, facets, lines))
      for (const Crossing& crossing : found)
        if (!crossing.leaves) mine = std::min(mine, crossing.s);
  }
  const double least = least_over_ranks(*mesh.comm, mine);
  return least < never ? std::optional(least) : std::nullopt;
}

}  // namespace

// The load takes the body that it acts on along until this meets another one; a free one goes on with it, a held one stops both.
std::string advise_parts_apart(const FailedTry& failed, const Model& model, const Scene& scene, const SemiSmoothSystem& system) {
  constexpr double hardly = 1e-6;  // of the largest component of a direction
  const Mesh& mesh = *model.mesh();
  if (!model.contact() || failed.from.context.time > 0.0 || failed.failure.kind() == FailureKind::input) return {};
  const std::vector<int> loose = bodies_held_by_contact_only(model);
  const auto is_loose = [&](std::size_t body) { return std::find(loose.begin(), loose.end(), static_cast<int>(body)) != loose.end(); };
  if (loose.empty()) return {};
  for (std::size_t p = 0; p < model.surfaces_at_start().pairs.size(); ++p) {
    const auto& touched = model.bodies_of_pairs()[p];
    const PairAtStart& start = model.surfaces_at_start().pairs[p];
    if (std::any_of(touched.begin(), touched.end(), [&](int body) { return is_loose(static_cast<std::size_t>(body)); }) &&
        !(start.gap.value_or(0.0) > 0.0))
      return {};
  }
  const std::vector<Eigen::Vector3d> loads = loads_on_bodies(model, system.evaluate(*failed.from.x, failed.context));
  const auto heaviest = std::max_element(loose.begin(), loose.end(), [&](int a, int b) {
    return loads[static_cast<std::size_t>(a)].norm() < loads[static_cast<std::size_t>(b)].norm();
  });
  Eigen::Vector3d d = loads[static_cast<std::size_t>(*heaviest)];
  if (!(d.norm() > 0.0)) return {};
  for (int i = 0; i < 3; ++i)
    if (std::abs(d[i]) < hardly * d.norm()) d[i] = 0.0;
  d.normalize();

  std::map<std::size_t, double> moved{{static_cast<std::size_t>(*heaviest), 0.0}};
  const PlaceOfNode start = reference_places(mesh);
  const PlaceOfNode at = [&](LocalOrdinal node) {
    const auto found = moved.find(static_cast<std::size_t>(mesh.body_of_node[node]));
    return found == moved.end() ? start(node) : Eigen::Vector3d(start(node) + found->second * d);
  };
  const std::vector<Sides> pairs = sides_of_pairs(mesh, scene);
  while (true) {
    std::optional<double> least;
    std::size_t met = 0;
    for (const Sides& pair : pairs) {
      const bool slave_moves = moved.count(pair.slave.body) > 0;
      if (slave_moves == (moved.count(pair.master.body) > 0)) continue;
      const SidesOfBody &moving = slave_moves ? pair.slave : pair.master, &still = slave_moves ? pair.master : pair.slave;
      const auto way = way_to(mesh, at, *moving.set, *still.set, d, model.parts().length);
      if (way && (!least || *way < *least)) least = way, met = still.body;
    }
    if (!least) return {};
    for (auto& [body, way] : moved) way += *least;
    if (!is_loose(met)) break;
    moved[met] = 0.0;
  }
  std::vector<std::string> translations;
  for (const auto& [body, way] : moved) {
    const auto of_scene =
        std::find_if(scene.bodies.begin(), scene.bodies.end(), [&, b = body](const auto& one) { return one.name == mesh.bodies[b].name; });
    if (of_scene == scene.bodies.end()) return {};  // of a pattern
    std::vector<std::string> numbers;
    const std::vector<double>& given = of_scene->value.mesh.options->translation;
    for (std::size_t i = 0; i < given.size(); ++i) numbers.push_back(fmt::format("{:.6g}", given[i] + way * d[static_cast<Eigen::Index>(i)]));
    translations.push_back(fmt::format("--set \"bodies/{}/mesh/translation={}\"", mesh.bodies[body].name, fmt::join(numbers, ",")));
  }
  return fmt::format(
      "bodies that contact alone holds touch nothing at the start, and the load carries '{}' {:.3g} far until it is held: what closes "
      "across a gap under a load has no stiffness before; please move the bodies until they touch, {}, or press them together by a "
      "prescribed displacement first",
      mesh.bodies[static_cast<std::size_t>(*heaviest)].name, moved.at(static_cast<std::size_t>(*heaviest)), fmt::join(translations, " "));
}

}  // namespace mortise
