#include "surfaces/penetration.hpp"

#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_Map.hpp>
#include <algorithm>
#include <cmath>
#include <limits>

namespace mortise {
namespace {

/// Depths that differ by less than this share are equal.
constexpr double equal_depth = 1e-6;

// From a probe the line first runs through the probe's own body. If it begins within the other one, the first facet of that which it crosses is one
// that it leaves by.
Penetration classify(const std::vector<Crossing>& crossings, bool rigid, double touching) {
  double own_end = std::numeric_limits<double>::max();
  const Crossing* first = nullptr;
  for (const Crossing& crossing : crossings) {
    if (crossing.tag == SurfaceTags::own) {
      if (crossing.leaves && crossing.s > touching) own_end = std::min(own_end, crossing.s);
    } else if (first == nullptr) {
      first = &crossing;
    }
  }
  Penetration result;
  if (first == nullptr || first->s <= touching) return result;
  if (!first->leaves) {
    const bool within = rigid && own_end < std::numeric_limits<double>::max() && own_end - first->s > touching;
    return within ? Penetration{Penetration::Kind::pierced, own_end - first->s} : result;
  }
  const bool pushes_out = first->tag == SurfaceTags::front && first->s < own_end;
  result.kind = pushes_out ? Penetration::Kind::overlap : Penetration::Kind::swallowed;
  result.depth = first->s * std::abs(first->along);  // at corners the line is longer than the way out
  return result;
}

}  // namespace

bool may_penetrate(const SurfacePoint& point, const Box3& own_box, const Box3& other_box, bool other_is_rigid, double touching) {
  const Box3 box = other_box.widened(touching);
  LineSegment line{point.x, -point.normal, 0.0, own_box.diagonal() + other_box.diagonal()};
  return other_is_rigid ? box.cut(line) : box.holds(point.x);
}

// What is within a solid body ends in its box. A rigid one may have no more than a surface: the line goes on to the end of its own body.
std::vector<Penetration> penetrations(const BodiesToCompare& bodies, const std::vector<SurfaceProbe>& probes) {
  const Box3 box = bodies.other_box.widened(bodies.touching);
  std::vector<LineSegment> lines;
  std::vector<std::size_t> probe_of;
  for (std::size_t p = 0; p < probes.size(); ++p) {
    const SurfacePoint& point = probes[p].point;
    if (!may_penetrate(point, bodies.own_box, bodies.other_box, bodies.other_is_rigid, bodies.touching)) continue;
    LineSegment line{point.x, -point.normal, -bodies.touching, bodies.own_box.diagonal() + bodies.other_box.diagonal()};
    if (!bodies.other_is_rigid) box.cut(line);
    lines.push_back(line);
    probe_of.push_back(p);
  }
  std::vector<TaggedFacet> facets = bodies.own;
  facets.insert(facets.end(), bodies.other.begin(), bodies.other.end());
  const auto found = crossings(bodies.comm, bodies.dimension, facets, lines);
  std::vector<Penetration> result(probes.size());
  for (std::size_t n = 0; n < lines.size(); ++n) result[probe_of[n]] = classify(found[n], bodies.other_is_rigid, bodies.touching);
  return result;
}

DeepestPoint deepest_point(const Mesh& mesh, const PlaceOfNode& at, const std::vector<SurfaceProbe>& probes, const std::vector<double>& depths) {
  const Communicator& comm = *mesh.comm;
  DeepestPoint deepest;
  double mine = 0.0;
  for (const double depth : depths) mine = std::max(mine, depth);
  Teuchos::reduceAll(comm, Teuchos::REDUCE_MAX, mine, Teuchos::outArg(deepest.depth));
  if (!(deepest.depth > 0.0)) return deepest;
  const auto none = std::numeric_limits<GlobalOrdinal>::max();
  GlobalOrdinal least = none;
  const SurfaceProbe* found = nullptr;
  for (std::size_t p = 0; p < probes.size(); ++p) {
    if (depths[p] < (1.0 - equal_depth) * deepest.depth) continue;
    const GlobalOrdinal id = mesh.local_nodes->getGlobalElement(probes[p].node);
    if (id < least) least = id, found = &probes[p];
  }
  Teuchos::reduceAll(comm, Teuchos::REDUCE_MIN, least, Teuchos::outArg(deepest.node));
  int rank = found != nullptr && least == deepest.node ? comm.getRank() : comm.getSize(), from = 0;
  Teuchos::reduceAll(comm, Teuchos::REDUCE_MIN, rank, Teuchos::outArg(from));
  double values[6] = {};
  if (rank == from) {
    Eigen::Map<Eigen::Vector3d>(values + 0) = at(found->node);
    Eigen::Map<Eigen::Vector3d>(values + 3) = found->point.normal;
  }
  Teuchos::broadcast(comm, from, 6, values);
  deepest.place = Eigen::Map<Eigen::Vector3d>(values);
  deepest.normal = Eigen::Map<Eigen::Vector3d>(values + 3);
  return deepest;
}

}  // namespace mortise
