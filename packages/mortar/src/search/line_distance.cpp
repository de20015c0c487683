#include "search/line_distance.hpp"

#include <cmath>

#include "mortise/mortar/segment_2d.hpp"
#include "mortise/mortar/segment_3d.hpp"

namespace mortise {

std::optional<double> line_distance(const Eigen::Vector2d& x, const Eigen::Vector2d& n, const FacetPoints<2>& facet) {
  const MasterLine<double> line = {{{{facet[0].x(), facet[0].y()}, {facet[1].x(), facet[1].y()}}}};
  const Point2<double> normal{n.x(), n.y()};
  if (!faces({line.y[0], line.y[1]}, normal)) return std::nullopt;
  const auto hit = project_onto(line, {x.x(), x.y()}, normal);
  if (std::abs(hit.eta) > 1.0 + on_facet) return std::nullopt;
  return hit.distance;
}

std::optional<double> line_distance(const Eigen::Vector3d& x, const Eigen::Vector3d& n, const FacetPoints<3>& facet) {
  Eigen::Matrix3d frame;
  frame.row(0) = n.unitOrthogonal().transpose();
  frame.row(1) = n.cross(n.unitOrthogonal()).transpose();
  frame.row(2) = n.transpose();
  FacetVectors nodes;
  for (const Eigen::Vector3d& y : facet) nodes.push_back(frame * (y - x));
  if (!faces(nodes)) return std::nullopt;
  const Eigen::Vector2d origin = Eigen::Vector2d::Zero();
  for (std::size_t a = 0; a < nodes.size(); ++a) {  // clockwise, seen along n
    const Eigen::Vector2d here = nodes[a].head<2>(), next = nodes[(a + 1) % nodes.size()].head<2>();
    if (doubled_area(next, here, origin) < -on_facet * (next - here).squaredNorm()) return std::nullopt;
  }
  return height_at(nodes, facet_coordinates(nodes, linear_parts(3, nodes.size()).front(), origin));
}

}  // namespace mortise
