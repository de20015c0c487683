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

/// Finding of a line about the other body, and its place.
struct Finding {
  Penetration penetration;
  bool is_sure = true;                               ///< no facet is met at a grazing angle on the way
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< of the facet of the other body that decided
  double at = 0.0;                                   ///< where the line crosses it
  LineSegment line{};
};

// From a probe the line first runs through the probe's own body. If it begins within the other one, the first facet of that which it crosses is one
// that it leaves by. A facet at a grazing angle may be crossed or missed by round-off: a line that runs within a face tells nothing of what lies
// behind.
Finding classify(const std::vector<Crossing>& crossings, bool rigid, double touching) {
  double own_end = std::numeric_limits<double>::max(), grazes = own_end;
  const Crossing* first = nullptr;
  for (const Crossing& crossing : crossings) {
    if (std::abs(crossing.along) < grazing_angle) {
      if (crossing.s > touching) grazes = std::min(grazes, crossing.s);
    } else if (crossing.tag == SurfaceTags::own) {
      if (crossing.leaves && crossing.s > touching) own_end = std::min(own_end, crossing.s);
    } else if (first == nullptr) {
      first = &crossing;
    }
  }
  if (first == nullptr || first->s <= touching) return {};
  Finding result{{}, true, first->normal, first->s};
  if (!first->leaves) {
    const bool within = rigid && own_end < std::numeric_limits<double>::max() && own_end - first->s > touching;
    if (!within) return {};
    result.penetration = {Penetration::Kind::pierced, own_end - first->s};
    result.is_sure = own_end <= grazes;
    return result;
  }
  const bool pushes_out = first->tag == SurfaceTags::front && first->s < own_end;
  result.penetration.kind = pushes_out ? Penetration::Kind::overlap : Penetration::Kind::swallowed;
  result.penetration.depth = first->s * std::abs(first->along);  // at corners the line is longer than the way out
  result.is_sure = first->s <= grazes;
  return result;
}

/// Lines from probes into their own body.
struct ProbeLines {
  std::vector<LineSegment> lines;
  std::vector<std::size_t> probe;

  void add(const BodiesToCompare& bodies, std::size_t p, const Eigen::Vector3d& x, const Eigen::Vector3d& d) {
    LineSegment line{x, d, -bodies.touching, bodies.own_box.diagonal() + bodies.other_box.diagonal()};
    // A line within a solid body ends in its box. A rigid one may be only a surface: the line goes on to the end of its own body.
    if (!bodies.other_is_rigid && !bodies.other_box.widened(bodies.touching).cut(line)) return;
    lines.push_back(line);
    probe.push_back(p);
  }
};

// A line may enter a rigid surface within its own body. The own body then lies in it as deep as it goes on behind the surface. The depth is along the
// surface's normal, as the line may run along the surface.
void measure_pierced(const BodiesToCompare& bodies, const std::vector<SurfaceProbe>& probes, const std::vector<Finding>& findings,
                     std::vector<Penetration>& result) {
  ProbeLines behind;
  for (std::size_t p = 0; p < findings.size(); ++p)
    if (result[p].kind == Penetration::Kind::pierced) {
      const Eigen::Vector3d at = probes[p].point.x + findings[p].at * findings[p].line.d;
      behind.lines.push_back({at, -findings[p].normal, -bodies.touching, result[p].depth});
      behind.probe.push_back(p);
    }
  const auto found = crossings(bodies.comm, bodies.dimension, bodies.own, behind.lines);
  for (std::size_t n = 0; n < behind.lines.size(); ++n) {
    Penetration& one = result[behind.probe[n]];
    const auto end = std::find_if(found[n].begin(), found[n].end(), [](const Crossing& crossing) { return crossing.leaves; });
    if (end != found[n].end()) one.depth = std::max(0.0, end->s);
    if (one.depth <= bodies.touching) one = {};
  }
}

}  // namespace

bool may_penetrate(const SurfacePoint& point, const Box3& own_box, const Box3& other_box, bool other_is_rigid, double touching) {
  const Box3 box = other_box.widened(touching);
  LineSegment line{point.x, -point.normal, 0.0, own_box.diagonal() + other_box.diagonal()};
  return other_is_rigid ? box.cut(line) : box.holds(point.x);
}

// A line that grazes a facet is tried once more, turned by 30 degrees away from the edge that it is next to.
std::vector<Penetration> penetrations(const BodiesToCompare& bodies, const std::vector<SurfaceProbe>& probes) {
  std::vector<TaggedFacet> facets = bodies.own;
  facets.insert(facets.end(), bodies.other.begin(), bodies.other.end());
  ProbeLines rays;
  for (std::size_t p = 0; p < probes.size(); ++p) {
    const SurfacePoint& point = probes[p].point;
    if (may_penetrate(point, bodies.own_box, bodies.other_box, bodies.other_is_rigid, bodies.touching)) rays.add(bodies, p, point.x, -point.normal);
  }
  std::vector<Finding> findings(probes.size());
  const auto follow = [&](const ProbeLines& along) {
    const auto found = crossings(bodies.comm, bodies.dimension, facets, along.lines, Grazing::counted);
    for (std::size_t n = 0; n < found.size(); ++n) {
      Finding& finding = findings[along.probe[n]] = classify(found[n], bodies.other_is_rigid, bodies.touching);
      finding.line = along.lines[n];
    }
  };
  const auto are_on_some_rank = [&](int mine) {
    int all = 0;
    Teuchos::reduceAll(bodies.comm, Teuchos::REDUCE_MAX, mine, Teuchos::outArg(all));
    return all != 0;
  };
  follow(rays);
  ProbeLines turned;
  for (std::size_t p = 0; p < probes.size(); ++p)
    if (const SurfacePoint& point = probes[p].point; !findings[p].is_sure && !point.inward.isZero(0.0))
      turned.add(bodies, p, point.x, (0.5 * point.inward - std::sqrt(0.75) * point.normal).normalized());
  if (are_on_some_rank(turned.lines.empty() ? 0 : 1)) follow(turned);
  std::vector<Penetration> result(probes.size());
  int pierced = 0;
  for (std::size_t p = 0; p < probes.size(); ++p) {
    if (findings[p].is_sure) result[p] = findings[p].penetration;
    pierced = pierced || result[p].kind == Penetration::Kind::pierced;
  }
  if (are_on_some_rank(pierced)) measure_pierced(bodies, probes, findings, result);
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
