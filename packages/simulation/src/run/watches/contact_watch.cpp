#include "run/watches/contact_watch.hpp"

#include <fmt/format.h>

#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_Import.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_Vector.hpp>
#include <algorithm>

#include "model/current_places.hpp"
#include "mortise/mesh/sets.hpp"
#include "surfaces/surface_view.hpp"

namespace mortise {
namespace {

[[noreturn]] void fail(const Mesh& mesh, const std::string& pair, const DeepestPoint& at, const std::string& what) {
  const auto& x = at.place;
  throw StepFailure(
      FailureKind::lost_contact,
      fmt::format("contact \"{}\": node {} of the slave at ({:.6g}, {:.6g}{}) {}; no facet of the master acts on it: the body has passed "
                  "through; please take a smaller \"maximum step\", or see which side of the master faces the slave",
                  pair, at.node, x[0], x[1], mesh.dimension == 3 ? fmt::format(", {:.6g}", x[2]) : "", what));
}

}  // namespace

ContactWatch::ContactWatch(const Model& model, const Scene& scene)
    : model_(model), scene_(scene), to_local_nodes_(model.mesh()->owned_nodes, model.mesh()->local_nodes) {
  const Mesh& mesh = *model.mesh();
  for (std::size_t p = 0; p < scene.contact.size(); ++p) {
    const ContactPairOptions& options = scene.contact[p].value;
    const SideSet &slave = require_side_set(mesh, options.slave), &master = require_side_set(mesh, options.master);
    const PairAtStart& start = model.surfaces_at_start().pairs[p];
    const double reach = options.contact.mortar.search_reach.value_or(start.reach.value_or(start.longest));
    // Couplings of the reference configuration do not change: what they do not cover they never will.
    const bool is_frozen = options.contact.geometry == ContactGeometry::reference;
    for (const SidesOfBody& of_slave : sides_by_body(mesh, slave))
      for (const SidesOfBody& of_master : sides_by_body(mesh, master)) {
        sides_.insert(sides_.end(), {of_slave, of_master});
        Pair pair{p,        *of_slave.set, *of_master.set, of_slave.body, of_master.body, is_frozen ? touching_depth * model.size().length : reach,
                  is_frozen};
        if (pair.slave_body != pair.master_body && !start.is_swallowed) pairs_.push_back(pair);
      }
  }
}

// A node that carries no multiplier counts as not covered although its neighbours act for it. Beyond the reach that makes no difference; where the
// reach is nothing, nodes beside a covered one count as covered.
std::vector<char> ContactWatch::covered(const Pair& pair, const ContactLaws& laws) const {
  const Mesh& mesh = *model_.mesh();
  std::vector<char> owned(static_cast<std::size_t>(mesh.owned_count()), 0);
  for (const ContactNodeState& node : node_states(laws, pair.index)) owned[node.owned_node] = node.covered > 0.0;
  std::vector<char> local = on_local_nodes(mesh, to_local_nodes_, owned);
  if (!pair.is_frozen) return local;
  for (const Side& side : pair.slave.sides) {
    const std::vector<LocalOrdinal> nodes = mesh.side_nodes(side);
    if (std::none_of(nodes.begin(), nodes.end(), [&](LocalOrdinal node) { return local[node]; })) continue;
    for (const LocalOrdinal node : nodes)
      if (node < mesh.owned_count()) owned[node] = 1;
  }
  return on_local_nodes(mesh, to_local_nodes_, owned);
}

void ContactWatch::examine(const PlacedBodies& bodies, const ContactLaws& laws) const {
  if (pairs_.empty()) return;
  const auto& [mesh, at, boxes, length, touching] = bodies;

  // Of each pair the probes beside nodes that are not covered and may be in the other body; how many there are, all, and those beside covered nodes.
  std::vector<std::vector<SurfaceProbe>> probes(pairs_.size());
  std::vector<double> mine, counts(3 * pairs_.size());
  for (std::size_t p = 0; p < pairs_.size(); ++p) {
    const Pair& pair = pairs_[p];
    const std::vector<char> is_covered = covered(pair, laws);
    double all = 0.0, acted_on = 0.0;
    for (const SurfaceProbe& probe : probes_of(mesh, pair.slave, at)) {
      all += 1.0;
      acted_on += is_covered[probe.node];
      if (is_covered[probe.node]) continue;
      if (may_penetrate(probe.point, boxes[pair.slave_body], boxes[pair.master_body], is_rigid(mesh, pair.master_body), touching))
        probes[p].push_back(probe);
    }
    mine.insert(mine.end(), {static_cast<double>(probes[p].size()), all, acted_on});
  }
  Teuchos::reduceAll(*mesh.comm, Teuchos::REDUCE_SUM, static_cast<int>(mine.size()), mine.data(), counts.data());

  for (std::size_t p = 0; p < pairs_.size(); ++p) {
    const Pair& pair = pairs_[p];
    const std::string &name = scene_.contact[pair.index].name, &master = mesh.bodies[pair.master_body].name;
    const bool rigid = is_rigid(mesh, pair.master_body);
    if (rigid && counts[3 * p + 2] == 0.0 &&
        look_ahead(bodies, {"", pair.slave, pair.slave_body}, {"", pair.master, pair.master_body},
                   model_.surfaces_at_start().pairs[pair.index].longest)
            .backs)
      throw StepFailure(
          FailureKind::lost_contact,
          fmt::format("contact \"{}\": the rigid body '{}' turns its back on the slave: no facet of it faces the slave any more, and most of "
                      "the slave sees its back: the body has passed through, or around it; please take a smaller \"maximum step\"",
                      name, master));
    if (counts[3 * p] == 0.0) continue;
    const auto own = tagged_surface(mesh, pair.slave_body, pair.slave, SurfaceTags::own, SurfaceTags::own, at);
    const auto other = tagged_surface(mesh, pair.master_body, pair.master, SurfaceTags::front, SurfaceTags::rest, at);
    const auto found =
        penetrations({*mesh.comm, mesh.dimension, own, other, boxes[pair.slave_body], boxes[pair.master_body], rigid, touching}, probes[p]);
    using Kind = Penetration::Kind;
    const auto depths = [&](Kind kind) {
      std::vector<double> depths;
      for (const Penetration& one : found)
        depths.push_back(one.kind == kind && (kind == Kind::swallowed || one.depth > pair.reach) ? one.depth : 0.0);
      return depths;
    };
    if (const DeepestPoint lost = deepest_point(mesh, at, probes[p], depths(Kind::overlap)); lost.depth > 0.0)
      fail(mesh, name, lost, fmt::format("lies {:.3g} behind the surface of '{}', beyond the search reach {:.3g}", lost.depth, master, pair.reach));
    if (const DeepestPoint lost = deepest_point(mesh, at, probes[p], depths(Kind::pierced)); lost.depth > 0.0)
      fail(mesh, name, lost, fmt::format("belongs to a body that '{}' lies in, {:.3g} deep, entered through its back", master, lost.depth));
    const std::vector<double> swallowed = depths(Kind::swallowed);
    const auto within = static_cast<double>(std::count_if(swallowed.begin(), swallowed.end(), [](double depth) { return depth > 0.0; }));
    double all = 0.0;
    Teuchos::reduceAll(*mesh.comm, Teuchos::REDUCE_SUM, within, Teuchos::outArg(all));
    if (all < most_of_a_surface * counts[3 * p + 1]) continue;
    const DeepestPoint lost = deepest_point(mesh, at, probes[p], swallowed);
    fail(mesh, name, lost,
         fmt::format("lies {} '{}', {:.3g} behind its surface, with most of the slave", rigid ? "behind" : "within", master, lost.depth));
  }
}

}  // namespace mortise
