#include "surfaces/rounded_facets.hpp"

#include <Eigen/Geometry>
#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_Import.hpp>
#include <Tpetra_MultiVector.hpp>
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "mortise/mortar/facet_surface.hpp"
#include "mortise/mortar/quadratic_facet.hpp"
#include "mortise/shape/quadrature.hpp"
#include "surfaces/facet_kinks.hpp"

namespace mortise {
namespace {

/// Normal of the smooth surface at a node, by the facets around it.
struct NodeNormal {
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< 0: the node is a corner
  bool is_inside = false;                            ///< the surface goes on around the node
};

bool is_linear(int dimension, std::size_t nodes) { return nodes == facet_corners(dimension, nodes); }

/// Of local nodes. Collective.
std::vector<NodeNormal> node_normals(const Mesh& mesh, const SideSet& set, const PlaceOfNode& at) {
  std::map<LocalOrdinal, std::vector<Eigen::Vector3d>> around;
  std::map<std::pair<LocalOrdinal, LocalOrdinal>, int> facets_at_edge;
  for (const Side& side : set.sides) {
    const std::vector<LocalOrdinal> nodes = mesh.side_nodes(side);
    const std::size_t corners = facet_corners(mesh.dimension, nodes.size());
    const Eigen::Vector3d normal = facet_normal(mesh.dimension, places_of(mesh, side, at));
    for (std::size_t a = 0; a < corners; ++a) {
      around[nodes[a]].push_back(normal);
      if (mesh.dimension == 3) ++facets_at_edge[std::minmax(nodes[a], nodes[(a + 1) % corners])];
    }
  }
  std::map<LocalOrdinal, bool> ends;
  for (const auto& [edge, count] : facets_at_edge)
    if (count == 1) ends[edge.first] = ends[edge.second] = true;
  MultiVector owned(mesh.owned_nodes, 4), local(mesh.local_nodes, 4);
  {
    const auto values = owned.getLocalViewHost(Tpetra::Access::OverwriteAll);
    for (LocalOrdinal node = 0; node < mesh.owned_count(); ++node) {
      for (int i = 0; i < 4; ++i) values(node, i) = 0.0;
      const auto found = around.find(node);
      if (found == around.end()) continue;
      const std::vector<Eigen::Vector3d>& normals = found->second;
      Eigen::Vector3d mean = Eigen::Vector3d::Zero();
      bool is_corner = false;
      for (const Eigen::Vector3d& one : normals) {
        mean += one;
        for (const Eigen::Vector3d& other : normals) is_corner = is_corner || one.dot(other) < std::cos(kink_angle);
      }
      if (is_corner) continue;
      mean.normalize();
      for (int i = 0; i < 3; ++i) values(node, i) = mean[i];
      values(node, 3) = mesh.dimension == 2 ? normals.size() > 1 : ends.count(node) == 0;
    }
  }
  local.doImport(owned, Import(mesh.owned_nodes, mesh.local_nodes), Tpetra::INSERT);
  const auto values = local.getLocalViewHost(Tpetra::Access::ReadOnly);
  std::vector<NodeNormal> result(static_cast<std::size_t>(mesh.local_count()));
  for (LocalOrdinal node = 0; node < mesh.local_count(); ++node)
    result[static_cast<std::size_t>(node)] = {{values(node, 0), values(node, 1), values(node, 2)}, values(node, 3) != 0.0};
  return result;
}

// A smooth curve from a to b, of length L, leaves its chord by the slope p at a and comes back by q at b: p = -n_a . (b - a) / L, q = n_b . (b - a) /
// L. Hermite's cubic is  L (p + q) / 8  above its middle; of an arc, p = q = L / 2R, that is the sagitta L^2 / 8R. Beyond the end of the surface the
// curvature goes on: there the facets of one side alone say too little of the normal.
double lift(const Eigen::Vector3d& along, const NodeNormal& from, const NodeNormal& to) {
  if (from.normal.isZero(0.0) && to.normal.isZero(0.0)) return 0.0;
  double p = -from.normal.dot(along), q = to.normal.dot(along);
  if (from.normal.isZero(0.0) || (!from.is_inside && std::abs(p) < std::abs(q))) p = q;
  if (to.normal.isZero(0.0) || (!to.is_inside && std::abs(q) < std::abs(p))) q = p;
  return 0.125 * (p + q);
}

/// A point of a linear facet with the weights of the gap there.
struct WeightedPoint {
  Eigen::Vector2d xi;
  std::vector<double> weights;  ///< [nodes]
};

/// gauss_legendre(3) on equal parts of [-1, 1]: what the master leaves has a kink at each of its nodes.
std::vector<LinePoint> line_points(int parts) {
  std::vector<LinePoint> points;
  for (int part = 0; part < parts; ++part)
    for (const LinePoint& point : gauss_legendre(3)) points.push_back({-1.0 + (2.0 * part + 1.0 + point.xi) / parts, point.weight / parts});
  return points;
}

// Dual functions of a line are 2 N_a - N_b = 3 N_a - 1, those of a quadrilateral products of these, and those of a triangle 4 N_a - 1.
std::vector<WeightedPoint> gap_points(int dimension, std::size_t nodes, bool dual) {
  std::vector<WeightedPoint> points;
  const auto line = line_points(dimension == 2 ? 16 : 3);
  const auto function = [&](double N) { return dual ? 3.0 * N - 1.0 : N; };
  if (dimension == 2) {
    for (const LinePoint& point : line) {
      const double N = 0.5 * (1.0 - point.xi);
      points.push_back({{point.xi, 0.0}, {point.weight * function(N), point.weight * function(1.0 - N)}});
    }
    return points;
  }
  if (nodes == 4) {
    for (const LinePoint& one : line)
      for (const LinePoint& other : line) {
        const double w = one.weight * other.weight, s = function(0.5 * (1.0 - one.xi)), S = function(0.5 * (1.0 + one.xi)),
                     t = function(0.5 * (1.0 - other.xi)), T = function(0.5 * (1.0 + other.xi));
        points.push_back({{one.xi, other.xi}, {w * s * t, w * S * t, w * S * T, w * s * T}});
      }
    return points;
  }
  for (const auto& point : triangle_rule(7)) {
    const double x = point.xi[0], y = point.xi[1];
    const auto of_triangle = [&](double N) { return point.weight * (dual ? 4.0 * N - 1.0 : N); };
    points.push_back({{x, y}, {of_triangle(1.0 - x - y), of_triangle(x), of_triangle(y)}});
  }
  return points;
}

/// Where the line meets the nearest facet of the master that faces it, within its length.
std::optional<double> nearest(const std::vector<Crossing>& crossings) {
  constexpr double facing = 0.5;  // cosine
  std::optional<double> s;
  for (const Crossing& crossing : crossings)
    if (crossing.along < -facing && (!s || std::abs(crossing.s) < std::abs(*s))) s = crossing.s;
  return s;
}

}  // namespace

RoundedFacets round_facets(const Mesh& mesh, const SideSet& set, const PlaceOfNode& at) {
  const std::vector<NodeNormal> normals = node_normals(mesh, set, at);
  RoundedFacets result;
  double mine[2] = {0.0, 0.0}, all[2];
  for (const Side& side : set.sides) {
    const std::vector<LocalOrdinal> nodes = mesh.side_nodes(side);
    FacetPlaces& facet = result.facets.emplace_back(places_of(mesh, side, at));
    if (!is_linear(mesh.dimension, nodes.size())) continue;
    const std::size_t corners = nodes.size(), edges = mesh.dimension == 2 ? 1 : corners;
    for (std::size_t a = 0; a < edges; ++a) {
      const std::size_t b = (a + 1) % corners;
      const NodeNormal &from = normals[static_cast<std::size_t>(nodes[a])], &to = normals[static_cast<std::size_t>(nodes[b])];
      const Eigen::Vector3d along = facet[b] - facet[a], mean = from.normal + to.normal;
      const double height = lift(along, from, to);
      facet.push_back(0.5 * (facet[a] + facet[b]) + (height != 0.0 ? Eigen::Vector3d(height * mean.normalized()) : Eigen::Vector3d::Zero()));
      mine[0] = std::max(mine[0], height);
      mine[1] = std::max(mine[1], -height);
    }
  }
  Teuchos::reduceAll(*mesh.comm, Teuchos::REDUCE_MAX, 2, mine, all);
  result.highest = all[0];
  result.deepest = all[1];
  return result;
}

// Let the facet -l <= x <= l, h = 2 l, leave the parts c (l^2 - x^2)(l^2 - y^2) of a surface, which a quadrilateral of 8 nodes lacks. In its middle
// that is c l^4. At the middle of an edge its normal is off by 2 c l^3, the angle to that of the neighbour is 4 c l^3 = a: c l^4 = a l / 4 = h a / 8.
double height_of_kinks(const Mesh& mesh, const SideSet& set, const PlaceOfNode& at, bool with_linear) {
  struct AtNode {
    Eigen::Vector3d normal;
    double length;
  };
  std::map<LocalOrdinal, std::vector<AtNode>> around;
  for (const Side& side : set.sides) {
    const std::vector<LocalOrdinal> nodes = mesh.side_nodes(side);
    if (is_linear(mesh.dimension, nodes.size()) && !with_linear) continue;
    const FacetPlaces facet = places_of(mesh, side, at);
    for (std::size_t a = 0; a < nodes.size(); ++a)
      if (nodes[a] < mesh.owned_count())
        around[nodes[a]].push_back({facet_point(mesh.dimension, facet, facet_node(mesh.dimension, nodes.size(), a)).normal.normalized(),
                                    side_lengths(mesh, side, at).back()});
  }
  double mine = 0.0, largest = 0.0;
  for (const auto& [node, all] : around)
    for (std::size_t a = 0; a < all.size(); ++a)
      for (std::size_t b = 0; b < a; ++b)
        if (const double angle = std::acos(std::clamp(all[a].normal.dot(all[b].normal), -1.0, 1.0)); angle < kink_angle)
          mine = std::max(mine, 0.125 * angle * std::max(all[a].length, all[b].length));
  Teuchos::reduceAll(*mesh.comm, Teuchos::REDUCE_MAX, mine, Teuchos::outArg(largest));
  return largest;
}

std::vector<double> gaps_of_round_surfaces(const Mesh& mesh, const SideSet& slave, const SideSet& master, const PlaceOfNode& at, bool dual) {
  const RoundedFacets of_slave = round_facets(mesh, slave, at), of_master = round_facets(mesh, master, at);
  const double reach = std::max(longest_facet(mesh, slave, at), longest_facet(mesh, master, at));
  std::vector<TaggedFacet> flat, round;
  for (LocalOrdinal s = 0; s < master.owned; ++s) {
    flat.push_back({places_of(mesh, master.sides[static_cast<std::size_t>(s)], at), 0});
    round.push_back({of_master.facets[static_cast<std::size_t>(s)], 0});
  }
  // One line at each point of each facet around owned nodes; of quadratic facets at their nodes.
  std::vector<LineSegment> lines;
  std::vector<double> own;                                          // what the slave's smooth surface is ahead of the facet there
  std::vector<std::vector<std::pair<LocalOrdinal, double>>> parts;  // what counts for which node
  for (std::size_t s = 0; s < slave.sides.size(); ++s) {
    const std::vector<LocalOrdinal> nodes = mesh.side_nodes(slave.sides[s]);
    if (std::none_of(nodes.begin(), nodes.end(), [&](LocalOrdinal node) { return node < mesh.owned_count(); })) continue;
    const FacetPlaces facet = places_of(mesh, slave.sides[s], at);
    const auto add = [&](const Eigen::Vector2d& xi, std::vector<std::pair<LocalOrdinal, double>> weights) {
      const FacetPoint point = facet_point(mesh.dimension, facet, xi);
      const Eigen::Vector3d n = point.normal.normalized();
      lines.push_back({point.x, n, -reach, reach});
      own.push_back(n.dot(facet_point(mesh.dimension, of_slave.facets[s], xi).x - point.x));
      parts.push_back(std::move(weights));
    };
    if (!is_linear(mesh.dimension, nodes.size())) {
      for (std::size_t a = 0; a < nodes.size(); ++a) add(facet_node(mesh.dimension, nodes.size(), a), {{nodes[a], 1.0}});
      continue;
    }
    const double size = mesh.dimension == 2
                            ? (facet[1] - facet[0]).norm()
                            : facet_point(3, facet, nodes.size() == 4 ? Eigen::Vector2d(0.0, 0.0) : Eigen::Vector2d(0.3, 0.3)).normal.norm();
    for (const WeightedPoint& point : gap_points(mesh.dimension, nodes.size(), dual)) {
      std::vector<std::pair<LocalOrdinal, double>> weights;
      for (std::size_t a = 0; a < nodes.size(); ++a) weights.emplace_back(nodes[a], size * point.weights[a]);
      add(point.xi, std::move(weights));
    }
  }
  const auto on_flat = crossings(*mesh.comm, mesh.dimension, flat, lines), on_round = crossings(*mesh.comm, mesh.dimension, round, lines);
  std::vector<double> sum(static_cast<std::size_t>(mesh.owned_count()), 0.0), weight = sum;
  for (std::size_t n = 0; n < lines.size(); ++n) {
    const auto to_flat = nearest(on_flat[n]), to_round = nearest(on_round[n]);
    const double more = (to_flat && to_round ? *to_round - *to_flat : 0.0) - own[n];
    for (const auto& [node, w] : parts[n])
      if (node < mesh.owned_count()) {
        sum[static_cast<std::size_t>(node)] += w * more;
        weight[static_cast<std::size_t>(node)] += w;
      }
  }
  for (std::size_t node = 0; node < sum.size(); ++node)
    if (weight[node] > 0.0) sum[node] /= weight[node];
  return sum;
}

}  // namespace mortise
