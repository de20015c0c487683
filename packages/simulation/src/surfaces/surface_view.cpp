#include "surfaces/surface_view.hpp"

#include <Teuchos_CommHelpers.hpp>
#include <algorithm>
#include <cmath>

namespace mortise {
namespace {

constexpr double back_behind = 0.1;  ///< of a facet: a back no further behind the slave than that may have been meant to touch it

double sum(const Communicator& comm, double mine) {
  double all = 0.0;
  Teuchos::reduceAll(comm, Teuchos::REDUCE_SUM, mine, Teuchos::outArg(all));
  return all;
}

double least(const Communicator& comm, double mine) {
  double all = 0.0;
  Teuchos::reduceAll(comm, Teuchos::REDUCE_MIN, mine, Teuchos::outArg(all));
  return all;
}

}  // namespace

SurfaceView look(const PlacedBodies& bodies, const NamedSurface& from, const NamedSurface& to) {
  const Mesh& mesh = bodies.mesh;
  const std::vector<SurfaceProbe> probes = probes_of(mesh, from.set, bodies.at);
  const auto own = tagged_surface(mesh, from.body, from.set, SurfaceTags::own, SurfaceTags::own, bodies.at);
  const auto other = tagged_surface(mesh, to.body, to.set, SurfaceTags::front, SurfaceTags::rest, bodies.at);
  const auto found = penetrations(
      {*mesh.comm, mesh.dimension, own, other, bodies.boxes[from.body], bodies.boxes[to.body], is_rigid(mesh, to.body), bodies.touching}, probes);
  std::vector<double> depths, swallowed;
  for (const Penetration& one : found) {
    depths.push_back(one.kind == Penetration::Kind::overlap ? one.depth : 0.0);
    swallowed.push_back(one.kind == Penetration::Kind::swallowed ? one.depth : 0.0);
  }
  const auto within = std::count_if(swallowed.begin(), swallowed.end(), [](double depth) { return depth > 0.0; });
  SurfaceView view;
  view.probes = sum(*mesh.comm, static_cast<double>(probes.size()));
  view.swallowed = sum(*mesh.comm, static_cast<double>(within));
  view.deepest = deepest_point(mesh, bodies.at, probes, depths);
  view.swallowed_at = deepest_point(mesh, bodies.at, probes, swallowed);
  return view;
}

std::optional<double> distance_to_back(const PlacedBodies& bodies, const DeepestPoint& deepest, const NamedSurface& to) {
  const Mesh& mesh = bodies.mesh;
  std::vector<LineSegment> lines;
  if (mesh.comm->getRank() == 0) lines.push_back({deepest.place, deepest.normal, bodies.touching, bodies.length});
  double mine = std::numeric_limits<double>::max();
  for (const auto& found :
       crossings(*mesh.comm, mesh.dimension, tagged_surface(mesh, to.body, to.set, SurfaceTags::front, SurfaceTags::rest, bodies.at), lines))
    for (const Crossing& crossing : found)
      if (crossing.leaves) mine = std::min(mine, crossing.s * std::abs(crossing.along));
  const double distance = least(*mesh.comm, mine);
  return distance < std::numeric_limits<double>::max() ? std::optional(distance) : std::nullopt;
}

// Lines are as long as the next front needs: surfaces that touch cost next to nothing.
Outlook look_ahead(const PlacedBodies& bodies, const NamedSurface& slave, const NamedSurface& master, double longest) {
  const Mesh& mesh = bodies.mesh;
  const std::vector<SurfaceProbe> probes = probes_of(mesh, slave.set, bodies.at);
  std::vector<TaggedFacet> fronts;
  for (LocalOrdinal s = 0; s < master.set.owned; ++s) fronts.push_back({places_of(mesh, master.set.sides[s], bodies.at), SurfaceTags::front});
  const double all = sum(*mesh.comm, static_cast<double>(probes.size()));
  for (double reach = longest;; reach *= 4.0) {
    std::vector<LineSegment> lines;
    for (const SurfaceProbe& probe : probes) {
      LineSegment line{probe.point.x, probe.point.normal, -back_behind * longest, std::min(reach, bodies.length)};
      const double low = line.low;
      if (!bodies.boxes[master.body].widened(-low).cut(line)) continue;
      line.low = low;
      lines.push_back(line);
    }
    double nearest = std::numeric_limits<double>::max(), backs = 0.0;
    for (const auto& found : crossings(*mesh.comm, mesh.dimension, fronts, lines)) {
      bool back = false;
      for (const Crossing& crossing : found) {
        back = back || crossing.leaves;
        if (!crossing.leaves && crossing.s >= -bodies.touching) nearest = std::min(nearest, crossing.s);
      }
      backs += back;
    }
    const double gap = least(*mesh.comm, nearest);
    if (gap < std::numeric_limits<double>::max()) return {gap, false};
    if (reach >= bodies.length) return {std::nullopt, sum(*mesh.comm, backs) >= most_of_a_surface * all};
  }
}

}  // namespace mortise
