#include "mortise/mortar/convex_clip.hpp"

#include <algorithm>
#include <cmath>

namespace mortise {
namespace {

constexpr double on_edge = 1e-12;  // of the first polygon's size

// The nodes of an edge: {start, end}, counted over both polygons.
std::array<int, 2> nodes_of(int edge, int first, int second) {
  if (edge < first) return {edge, (edge + 1) % first};
  return {edge, first + (edge - first + 1) % second};
}

// The node at which two edges of one polygon meet; -1: they belong to different ones, or do not meet.
int common_node(const std::array<int, 2>& edges, int first, int second) {
  if ((edges[0] < first) != (edges[1] < first)) return -1;
  const auto a = nodes_of(edges[0], first, second), b = nodes_of(edges[1], first, second);
  if (a[1] == b[0]) return a[1];
  if (b[1] == a[0]) return a[0];
  return -1;
}

const Eigen::Vector2d& node_position(int node, const PlanePolygon& first, const PlanePolygon& second) {
  const auto count = static_cast<int>(first.size());
  return node < count ? first[node] : second[node - count];
}

// A vertex and the edge that follows it.
struct Corner {
  ClipVertex vertex;
  int edge;
};
using Corners = boost::container::static_vector<Corner, 16>;

// The corners that are left of the second polygon's edge `line`, seen against its direction.
Corners cut(const Corners& corners, int line, const PlanePolygon& first, const PlanePolygon& second, double tolerance) {
  const auto first_count = static_cast<int>(first.size()), second_count = static_cast<int>(second.size());
  const auto [start, end] = nodes_of(line, first_count, second_count);
  const Eigen::Vector2d &from = node_position(end, first, second), &to = node_position(start, first, second);
  const double length = (to - from).norm();
  boost::container::static_vector<double, 16> distance;
  for (const Corner& corner : corners) distance.push_back(doubled_area(from, to, corner.vertex.position) / length);
  Corners kept;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const std::size_t next = (i + 1) % corners.size();
    const bool inside = distance[i] >= -tolerance, next_inside = distance[next] >= -tolerance;
    if (inside) kept.push_back(corners[i]);
    if (inside == next_inside) continue;
    if (inside && distance[i] <= tolerance) {
      kept.back().edge = line;
      continue;
    }
    if (next_inside && distance[next] <= tolerance) continue;
    Corner crossing;
    crossing.vertex.edges = {corners[i].edge, line};
    crossing.edge = inside ? line : corners[i].edge;
    const int node = common_node(crossing.vertex.edges, first_count, second_count);
    const double share = distance[i] / (distance[i] - distance[next]);
    crossing.vertex.position = node >= 0 ? node_position(node, first, second)
                                         : Eigen::Vector2d((1.0 - share) * corners[i].vertex.position + share * corners[next].vertex.position);
    kept.push_back(crossing);
  }
  return kept;
}

}  // namespace

ClipPolygon clip_convex(const PlanePolygon& first, const PlanePolygon& second) {
  const auto first_count = static_cast<int>(first.size()), second_count = static_cast<int>(second.size());
  Corners corners;
  double size = 0.0;
  for (int a = 0; a < first_count; ++a) {
    corners.push_back({{first[a], {(a + first_count - 1) % first_count, a}}, a});
    size = std::max(size, (first[a] - first[0]).norm());
  }
  for (int line = first_count; line < first_count + second_count && corners.size() >= 3; ++line)
    corners = cut(corners, line, first, second, on_edge * size);
  ClipPolygon polygon;
  if (corners.size() >= 3)
    for (const Corner& corner : corners) polygon.push_back(corner.vertex);
  return polygon;
}

boost::container::static_vector<VertexPart, 4> vertex_parts(const ClipVertex& vertex, const PlanePolygon& first, const PlanePolygon& second) {
  const auto first_count = static_cast<int>(first.size()), second_count = static_cast<int>(second.size());
  const int node = common_node(vertex.edges, first_count, second_count);
  if (node >= 0) return {VertexPart{node, Eigen::Matrix2d::Identity()}};
  const auto [a, b] = nodes_of(vertex.edges[0], first_count, second_count);
  const auto [l, m] = nodes_of(vertex.edges[1], first_count, second_count);
  const Eigen::Vector2d &x_a = node_position(a, first, second), &x_l = node_position(l, first, second);
  const Eigen::Vector2d along = node_position(b, first, second) - x_a, other = node_position(m, first, second) - x_l;
  const Eigen::Vector2d across(-other.y(), other.x());
  const Eigen::Matrix2d slide = along * across.transpose() / across.dot(along), stay = Eigen::Matrix2d::Identity() - slide;
  const double t = along.dot(vertex.position - x_a) / along.squaredNorm(), u = other.dot(vertex.position - x_l) / other.squaredNorm();
  return {VertexPart{a, (1.0 - t) * stay}, VertexPart{b, t * stay}, VertexPart{l, (1.0 - u) * slide}, VertexPart{m, u * slide}};
}

}  // namespace mortise
