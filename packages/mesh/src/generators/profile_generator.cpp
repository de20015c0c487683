// A polyline with rounded corners.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "generators/describe_cells.hpp"
#include "mortise/mesh/generators.hpp"

namespace mortise {
namespace {

using Eigen::Vector2d;

/// Arc of radius r that rounds the corner p between a and b: it starts and ends at the distance r tan(turn / 2) from p.
struct Rounding {
  Vector2d start = Vector2d::Zero(), end = Vector2d::Zero(), center = Vector2d::Zero();
  double setback = 0.0, sweep = 0.0;
};

Rounding round_corner(const Vector2d& a, const Vector2d& p, const Vector2d& b, double radius) {
  const Vector2d in = (p - a).normalized(), out = (b - p).normalized();
  Rounding rounding;
  rounding.sweep = std::atan2(in.x() * out.y() - in.y() * out.x(), in.dot(out));
  rounding.setback = radius * std::tan(0.5 * std::abs(rounding.sweep));
  rounding.start = p - rounding.setback * in;
  rounding.end = p + rounding.setback * out;
  rounding.center = rounding.start + std::copysign(radius, rounding.sweep) * Vector2d(-in.y(), in.x());
  return rounding;
}

int cells_for(double length, double size) { return std::max(1, static_cast<int>(std::ceil(length / size - 1e-9))); }

}  // namespace

void ProfileMesh::describe_shape(Parameters& parameters) {
  parameters.add("points", points,
                 Says("corners of the polyline, \"x1, y1, x2, y2, ...\"; the body lies to the left of the way along them").unit("length").required());
  parameters.add("radii", radii,
                 Says("radii of the arcs that round the points between the first and the last, one for each; 0: a sharp corner").unit("length"));
  parameters.add("cell size", cell_size, Says("largest length of the lines that the profile is cut into").unit("length").above(0.0).required());
  if (points.size() % 2 != 0 || (!points.empty() && points.size() < 4)) {
    parameters.error("points",
                     fmt::format("is \"{}\"; it needs x and y of two points or more, not {} number(s)", fmt::join(points, ", "), points.size()));
    points.clear();
  }
  const std::size_t inner = points.size() < 4 ? 0 : points.size() / 2 - 2;
  if (!radii.empty() && radii.size() != inner) {
    parameters.error("radii", fmt::format("is \"{}\"; it needs {} number(s), one for each point between the first and the last, not {}",
                                          fmt::join(radii, ", "), inner, radii.size()));
    radii.clear();
  }
  for (const double radius : radii)
    if (radius < 0.0) parameters.error("radii", fmt::format("one is {:g}; allowed: >= 0", radius));
}

PatchComplex ProfileMesh::build(CellShape, const Place& place) const {
  throw InputError(place, "a profile has no inside that could deform; please make the body \"rigid\", or choose another mesh");
}

CurveComplex ProfileMesh::build_surface(const Place& place) const {
  const std::size_t count = points.size() / 2;
  const auto point = [&](std::size_t k) { return Vector2d(points.at(2 * k), points.at(2 * k + 1)); };
  std::vector<Point> corners;
  std::vector<PatchComplex::Edge> edges;
  const auto add = [&](const Vector2d& end, const Rounding* arc) {
    const Vector2d start(corners.back()[0], corners.back()[1]);
    const double length = arc ? std::abs(arc->sweep) * (start - arc->center).norm() : (end - start).norm();
    if (length < 1e-9 * cell_size) return;  // two arcs that meet, or no turn at all
    if (length / cell_size > most_cells)
      throw InputError(place, fmt::format("\"cell size\" {:g} asks for more than {} lines on a length of {:g}; please make it larger", cell_size,
                                          most_cells, length));
    corners.push_back({end.x(), end.y()});
    const int last = static_cast<int>(corners.size()) - 1;
    PatchComplex::Edge edge{last - 1, last, Spacing(cells_for(length, cell_size))};
    if (arc) {
      edge.center = Point{arc->center.x(), arc->center.y()};
      edge.sweep = arc->sweep;
    }
    edges.push_back(edge);
  };
  corners.push_back({points.at(0), points.at(1)});
  double used = 0.0;  // of the straight piece before the corner, by the corner before it
  for (std::size_t k = 1; k < count; ++k) {
    const double length = (point(k) - point(k - 1)).norm();
    if (!(length > 0.0)) throw InputError(place, fmt::format("points {} and {} of the profile are the same", k, k + 1));
    const double radius = k + 1 < count && !radii.empty() ? radii[k - 1] : 0.0;
    Rounding arc;
    if (k + 1 < count && (point(k + 1) - point(k)).norm() > 0.0) arc = round_corner(point(k - 1), point(k), point(k + 1), radius);
    if (!(used + arc.setback <= length * (1.0 + 1e-12)))
      throw InputError(place, fmt::format("the radii of the profile do not fit between points {} and {}: the arcs need {:g} of a length of {:g}", k,
                                          k + 1, used + arc.setback, length));
    add(radius > 0.0 ? arc.start : point(k), nullptr);
    if (radius > 0.0) add(arc.end, &arc);
    used = arc.setback;
  }
  const std::vector<std::string> names(edges.size(), "profile");
  return CurveComplex(std::move(corners), std::move(edges), names, placement());
}

}  // namespace mortise
