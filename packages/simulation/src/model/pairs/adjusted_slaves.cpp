#include "model/pairs/adjusted_slaves.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "mortise/mesh/build_mesh.hpp"
#include "mortise/mesh/sets.hpp"
#include "mortise/simulation/model/surfaces_at_start.hpp"
#include "surfaces/body_surfaces.hpp"

namespace mortise {
namespace {

/// Slave nodes would be moved onto the chords of a round quadratic master, which is wrong by a part of its sagitta.
void refuse_curved_master(const Mesh& mesh, const Named<ContactPairOptions>& pair) {
  constexpr double flat = 1e-9;  // over the longest facet
  const PlaceOfNode at = reference_places(mesh);
  const SideSet& master = require_side_set(mesh, pair.value.master);
  const double inexact = deviation_from_parts(mesh, master, at);
  if (inexact <= flat * longest_facet(mesh, master, at)) return;
  throw InputError(
      pair.place,
      fmt::format("\"start\" = \"adjust\" moves slave nodes onto linear facets, and the quadratic facets of the master \"{}\" are curved: "
                  "they leave their linear parts by up to {:.3g}; please mesh both surfaces with the same points, or take linear elements",
                  pair.value.master.value, inexact));
}

}  // namespace

HeldNodes held_nodes(const Mesh& mesh, const Scene& scene) {
  HeldNodes held;
  held.components.resize(static_cast<std::size_t>(mesh.local_count()));
  for (const auto& [name, place, condition] : scene.boundary_conditions) {
    const auto set = mesh.node_sets.find(condition.set.value);
    if (set == mesh.node_sets.end()) continue;  // refused where conditions are made
    const std::array<bool, 3> given = {condition.x.has_value(), condition.y.has_value(), condition.z.has_value()};
    const auto axes = axes_of(condition);
    for (const LocalOrdinal node : set->second)
      for (std::size_t i = 0; i < 3; ++i) {
        if (!given[i]) continue;
        if (condition.x_axis.empty())
          held.components[static_cast<std::size_t>(node)][i] = true;
        else
          held.directions[node].push_back(axes[i]);
      }
  }
  return held;
}

std::vector<Adjustment> adjust_slaves(Mesh& mesh, const Scene& scene) {
  std::vector<Adjustment> done;
  const auto adjusts = [](const auto& pair) { return pair.value.start.mesh == MeshAtStart::adjusted; };
  if (std::none_of(scene.contact.begin(), scene.contact.end(), adjusts)) return std::vector<Adjustment>(scene.contact.size());
  const HeldNodes held = held_nodes(mesh, scene);
  for (const auto& pair : scene.contact) {
    done.emplace_back();
    if (!adjusts(pair)) continue;
    refuse_curved_master(mesh, pair);
    const double before = deepest_overlap(mesh, pair, mesh_size(mesh).length);
    done.back() = adjust_onto_master(mesh, require_side_set(mesh, pair.value.slave), require_side_set(mesh, pair.value.master),
                                     pair.value.start.tolerance, held);
    done.back().overlap = before;
  }
  return done;
}

}  // namespace mortise
