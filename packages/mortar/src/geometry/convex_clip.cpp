#include "mortise/mortar/convex_clip.hpp"

#include <algorithm>
#include <cmath>

namespace mortise {
namespace {

constexpr double coincide = 1e-12;  // of the first polygon's size

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

// True if the segments a b and l m lie within `tolerance` of one another wherever they are side by side.
bool coincident(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& l, const Eigen::Vector2d& m, double tolerance) {
  constexpr double sine = 1e-3, share = 0.01;  // with less in common than this share of the shorter one they are taken as they are
  const Eigen::Vector2d along = b - a, other = m - l;
  const double length = along.norm(), other_length = other.norm(), cross = along.x() * other.y() - along.y() * other.x();
  if (!(std::abs(cross) < sine * length * other_length)) return false;
  const double of_l = (l - a).dot(along) / length, of_m = (m - a).dot(along) / length;
  const double begin = std::max(0.0, std::min(of_l, of_m)), end = std::min(length, std::max(of_l, of_m));
  if (!(end - begin > share * std::min(length, other_length))) return false;
  const auto apart = [&](double s) { return doubled_area(a, b, l + (s - of_l) / (of_m - of_l) * other) / length; };
  return std::abs(apart(begin)) <= tolerance && std::abs(apart(end)) <= tolerance;
}

// The corners that are left of the second polygon's edge `line`, seen against its direction. Each edge of the common part has to end at two vertices
// that move with its line. So two vertices stand at one place where a corner that is kept lies on the line.
Corners cut(const Corners& corners, int line, const PlanePolygon& first, const PlanePolygon& second) {
  const auto first_count = static_cast<int>(first.size()), second_count = static_cast<int>(second.size());
  const auto [start, end] = nodes_of(line, first_count, second_count);
  const Eigen::Vector2d &from = node_position(end, first, second), &to = node_position(start, first, second);
  boost::container::static_vector<double, 16> area;
  for (const Corner& corner : corners) area.push_back(doubled_area(from, to, corner.vertex.position));
  Corners kept;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const std::size_t next = (i + 1) % corners.size();
    const bool inside = area[i] >= 0.0, next_inside = area[next] >= 0.0;
    if (inside) kept.push_back(corners[i]);
    if (inside == next_inside) continue;
    Corner crossing;
    crossing.vertex.edges = {corners[i].edge, line};
    crossing.edge = inside ? line : corners[i].edge;
    crossing.vertex.second_leaves = inside;
    const int node = common_node(crossing.vertex.edges, first_count, second_count);
    const double share = area[i] / (area[i] - area[next]);
    crossing.vertex.position = node >= 0 ? node_position(node, first, second)
                                         : Eigen::Vector2d((1.0 - share) * corners[i].vertex.position + share * corners[next].vertex.position);
    kept.push_back(crossing);
  }
  return kept;
}

}  // namespace

// Where edges coincide, the polygons on both sides of the second one's have to take the same of the two for their border. They take the first
// polygon's: it bounds the one that lies on its side, and leaves nothing of the other.
ClipPolygon clip_convex(const PlanePolygon& first, const PlanePolygon& second) {
  const auto first_count = static_cast<int>(first.size()), second_count = static_cast<int>(second.size());
  Corners corners;
  double size = 0.0;
  for (int a = 0; a < first_count; ++a) {
    corners.push_back({{first[a], {(a + first_count - 1) % first_count, a}}, a});
    size = std::max(size, (first[a] - first[0]).norm());
  }
  for (int line = first_count; line < first_count + second_count && corners.size() >= 3; ++line) {
    const auto [start, end] = nodes_of(line, first_count, second_count);
    const Eigen::Vector2d &from = node_position(end, first, second), &to = node_position(start, first, second);
    bool bounded = false;
    for (int a = 0; a < first_count && !bounded; ++a) {
      const Eigen::Vector2d& next = first[(a + 1) % first_count];
      if (!coincident(first[a], next, from, to, coincide * size)) continue;
      if ((next - first[a]).dot(to - from) < 0.0) return {};
      bounded = true;
    }
    if (!bounded) corners = cut(corners, line, first, second);
  }
  ClipPolygon polygon;
  if (corners.size() >= 3)
    for (const Corner& corner : corners) polygon.push_back(corner.vertex);
  return polygon;
}

bool EdgeCrossing::nearly_parallel() const {
  constexpr double sine = 1e-3;
  const double cross = across().dot(along);
  return cross * cross < sine * sine * along.squaredNorm() * other.squaredNorm();
}

std::optional<int> vertex_node(const ClipVertex& vertex, const PlanePolygon& first, const PlanePolygon& second) {
  const int node = common_node(vertex.edges, static_cast<int>(first.size()), static_cast<int>(second.size()));
  if (node < 0) return std::nullopt;
  return node;
}

EdgeCrossing edge_crossing(const ClipVertex& vertex, const PlanePolygon& first, const PlanePolygon& second) {
  const auto first_count = static_cast<int>(first.size()), second_count = static_cast<int>(second.size());
  EdgeCrossing crossing;
  crossing.first_nodes = nodes_of(vertex.edges[0], first_count, second_count);
  crossing.second_nodes = nodes_of(vertex.edges[1], first_count, second_count);
  const Eigen::Vector2d &a = node_position(crossing.first_nodes[0], first, second), &l = node_position(crossing.second_nodes[0], first, second);
  crossing.along = node_position(crossing.first_nodes[1], first, second) - a;
  crossing.other = node_position(crossing.second_nodes[1], first, second) - l;
  crossing.t = crossing.along.dot(vertex.position - a) / crossing.along.squaredNorm();
  crossing.u = crossing.other.dot(vertex.position - l) / crossing.other.squaredNorm();
  return crossing;
}

std::array<VertexPart, 4> vertex_parts(const EdgeCrossing& crossing) {
  const Eigen::Vector2d across = crossing.across();
  const Eigen::Matrix2d slide = crossing.along * across.transpose() / across.dot(crossing.along), stay = Eigen::Matrix2d::Identity() - slide;
  return {VertexPart{crossing.first_nodes[0], (1.0 - crossing.t) * stay}, VertexPart{crossing.first_nodes[1], crossing.t * stay},
          VertexPart{crossing.second_nodes[0], (1.0 - crossing.u) * slide}, VertexPart{crossing.second_nodes[1], crossing.u * slide}};
}

}  // namespace mortise
