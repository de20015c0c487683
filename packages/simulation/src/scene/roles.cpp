#include "scene/roles.hpp"

#include <fmt/format.h>

#include <Teuchos_CommHelpers.hpp>
#include <algorithm>
#include <cmath>
#include <utility>

#include "mortise/mesh/build_mesh.hpp"
#include "mortise/mesh/sets.hpp"
#include "mortise/simulation/scene/scene_bodies.hpp"
#include "scene/automatic_pairs.hpp"
#include "surfaces/body_surfaces.hpp"

namespace mortise {
namespace {

constexpr double same_modulus = 2.0;  ///< ratio below which the finer side is the better slave
constexpr double same_facet = 1.01;
constexpr double similar_facet = 2.0;  ///< ratio below which the side that faces fewer bodies is the better slave

}  // namespace

SurfaceTraits surface_traits(const Mesh& mesh, const Scene& scene, const Located<std::string>& name) {
  const SideSet& set = require_side_set(mesh, name);
  const PlaceOfNode at = reference_places(mesh);
  double mine[2] = {0.0, -std::numeric_limits<double>::max()}, all[2];  // largest modulus, minus the shortest side
  for (LocalOrdinal s = 0; s < set.owned; ++s) {
    mine[0] = std::max(mine[0], youngs_modulus(scene, mesh, mesh.blocks[set.sides[s].block]));
    mine[1] = std::max(mine[1], -side_lengths(mesh, set.sides[s], at).front());
  }
  Teuchos::reduceAll(*mesh.comm, Teuchos::REDUCE_MAX, 2, mine, all);
  return {all[0], -all[1]};
}

RoleChoice better_slave(const SurfaceTraits& first, const SurfaceTraits& second) {
  if (std::isinf(first.modulus) != std::isinf(second.modulus)) return {std::isinf(second.modulus), false, "the other one is rigid"};
  const auto choose = [](double a, double b, const char* what) {
    return RoleChoice{a < b, false, fmt::format("{}, {:.3g} against {:.3g}", what, std::min(a, b), std::max(a, b))};
  };
  const auto differ = [](double a, double b, double factor) { return std::max(a, b) > factor * std::min(a, b); };
  if (differ(first.modulus, second.modulus, same_modulus)) return choose(first.modulus, second.modulus, "its body is softer");
  // A slave facet that lies across the edges of two masters has both gaps, and weights of a linear function: a jump from 0 to g counts as -g/2.
  if (first.faces != second.faces && !differ(first.facet, second.facet, similar_facet))
    return {first.faces < second.faces, false,
            fmt::format("it faces fewer bodies, {} against {}", std::min(first.faces, second.faces), std::max(first.faces, second.faces))};
  if (differ(first.facet, second.facet, same_facet)) return choose(first.facet, second.facet, "its facets are shorter");
  return {true, true, "both are alike, and it was given as the slave"};
}

// A facet of the master of length H is straight, so slave nodes at distances h < H would have to lie on a straight line. But a stiff slave keeps its
// own shape, which leaves that line by H^2/8 of its curvature against the master. Where the contact zone has the half width a and the pressure p that
// is H^2/(8 a) p/E_m. To bend the slave by as much takes pressures of E_s/H times that: p E_s/E_m H/(8 a), with both signs. Where that exceeds p,
// nodes open until as many bear the force as the master has nodes to answer with: (H/h)^(d - 1) times p. Measured with discs on a block (Hertz),
// E_s/E_m from 1 to 1000, H/h from 1 to 8, a/H of 2 and 4: an excess of 0.2 E_s/E_m H/a, up to H/h - 1. Taken for two facets in half of the zone.
double excess_of_peak(const SurfaceTraits& slave, const SurfaceTraits& master, int dimension) {
  if (std::isinf(slave.modulus) || std::isinf(master.modulus)) return 0.0;
  const double stiffer = slave.modulus / master.modulus, finer = master.facet / slave.facet;
  if (stiffer <= 1.0 || finer <= 1.0) return 0.0;
  return std::min(0.1 * stiffer, std::pow(finer, dimension - 1) - 1.0);
}

void assign_roles(const Communicator& comm, Scene& scene) {
  const auto open = [](const auto& pair) { return pair.value.roles == ContactRoles::automatic; };
  if (std::none_of(scene.contact.begin(), scene.contact.end(), open) && scene.automatic_contact.pairs == ContactSearch::none) return;
  const RCP<Mesh> mesh = build_mesh(Teuchos::rcpFromRef(comm), body_descriptions(comm, scene), contact_sides(scene), {});
  add_sets(*mesh, scene.sets);
  add_automatic_pairs(*mesh, scene);
  for (auto& pair : scene.contact) {
    if (!open(pair)) continue;
    Located<std::string>&slave = pair.value.slave, &master = pair.value.master;
    if (!better_slave(surface_traits(*mesh, scene, slave), surface_traits(*mesh, scene, master)).is_first) std::swap(slave, master);
  }
}

}  // namespace mortise
