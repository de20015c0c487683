// Bodies of one patch: block, wedge, ring sector.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <boost/math/constants/constants.hpp>
#include <cmath>

#include "generators/describe_cells.hpp"
#include "mortise/mesh/generators.hpp"

namespace mortise {
namespace {

double distance(const Point& a, const Point& b) { return std::hypot(b[0] - a[0], b[1] - a[1]); }

/// A patch with straight edges, its corners counterclockwise from bottom left.
PatchComplex quadrilateral(CellShape cell, const std::array<Point, 4>& corners, const Spacing& x, const Spacing& y, const Placement& placement) {
  return PatchComplex(cell, {corners.begin(), corners.end()}, {{0, 1, x}, {1, 2, y}, {3, 2, x}, {0, 3, y}},
                      {{{0, 1, 2, 3}, {"bottom", "right", "top", "left"}}}, placement);
}

}  // namespace

void BlockMesh::describe_shape(Parameters& parameters) {
  parameters.add("width", width, Says("extent in x of the rectangle, which starts at the origin").unit("length").above(0.0));
  parameters.add("height", height, Says("extent in y of the rectangle").unit("length").above(0.0));
  parameters.add("bottom radius", bottom_radius,
                 Says("radius of the arc, bulging outward, that the bottom side is; 0: it is straight").unit("length").at_least(0.0));
  parameters.add("corners", corners,
                 Says("corners of a general quadrilateral in place of the rectangle, counterclockwise from bottom left: \"x1, y1, ..., x4, y4\"")
                     .unit("length"));
  if (!corners.empty() && corners.size() != 8) {
    parameters.error("corners",
                     fmt::format("is \"{}\"; it needs eight numbers (x and y of four corners), not {}", fmt::join(corners, ", "), corners.size()));
    corners.clear();
  }
  describe_cells(parameters, cells_x, grading_x, "cells x", "grading x", "from left to right");
  describe_cells(parameters, cells_y, grading_y, "cells y", "grading y", "from bottom to top");
}

PatchComplex BlockMesh::build(CellShape cell, const Place& place) const {
  std::array<Point, 4> points{{{0.0, 0.0}, {width, 0.0}, {width, height}, {0.0, height}}};
  if (!corners.empty())
    for (int k = 0; k < 4; ++k) points[k] = {corners.at(2 * k), corners.at(2 * k + 1)};
  const Spacing x = grading_x.spacing(distance(points[0], points[1]), cells_x, place);
  const Spacing y = grading_y.spacing(distance(points[0], points[3]), cells_y, place);
  if (bottom_radius == 0.0) return quadrilateral(cell, points, x, y, placement());
  const double chord = distance(points[0], points[1]), height_of_center = std::sqrt(bottom_radius * bottom_radius - 0.25 * chord * chord);
  if (!(2.0 * bottom_radius > chord))
    throw InputError(place, fmt::format("the bottom side is {:g} long, which an arc of radius {:g} cannot span; please take a radius above {:g}",
                                        chord, bottom_radius, 0.5 * chord));
  const Point along{(points[1][0] - points[0][0]) / chord, (points[1][1] - points[0][1]) / chord};
  const Point center{0.5 * (points[0][0] + points[1][0]) - height_of_center * along[1],
                     0.5 * (points[0][1] + points[1][1]) + height_of_center * along[0]};
  return PatchComplex(cell, {points.begin(), points.end()}, {{0, 1, x, center}, {1, 2, y}, {3, 2, x}, {0, 3, y}},
                      {{{0, 1, 2, 3}, {"bottom", "right", "top", "left"}}}, placement());
}

void WedgeMesh::describe_shape(Parameters& parameters) {
  parameters.add("width", width, Says("extent in x, from the origin").unit("length").above(0.0));
  parameters.add("left height", left_height, Says("height at x = 0").unit("length").above(0.0));
  parameters.add("right height", right_height, Says("height at x = width").unit("length").above(0.0));
  describe_cells(parameters, cells_x, grading_x, "cells x", "grading x", "from left to right");
  describe_cells(parameters, cells_y, grading_y, "cells y", "grading y", "from bottom to top");
}

PatchComplex WedgeMesh::build(CellShape cell, const Place& place) const {
  const Spacing x = grading_x.spacing(width, cells_x, place), y = grading_y.spacing(left_height, cells_y, place);
  return quadrilateral(cell, {{{0.0, 0.0}, {width, 0.0}, {width, right_height}, {0.0, left_height}}}, x, y, placement());
}

void RingSectorMesh::describe_shape(Parameters& parameters) {
  parameters.add("inner radius", inner_radius, Says("radius of the side \"inner\"").unit("length").above(0.0));
  parameters.add("outer radius", outer_radius, Says("radius of the side \"outer\"").unit("length").above(0.0));
  parameters.add("start angle", start_angle, Says("where the sector starts, counterclockwise from the x axis").unit("degrees"));
  parameters.add("end angle", end_angle, Says("where the sector ends").unit("degrees"));
  if (outer_radius <= inner_radius)
    parameters.error("outer radius", fmt::format("is {:g}; it has to be larger than \"inner radius\", {:g}", outer_radius, inner_radius));
  if (end_angle <= start_angle || end_angle - start_angle >= 360.0)
    parameters.error("end angle",
                     fmt::format("is {:g}; it has to lie above \"start angle\", {:g}, by less than 360 degrees", end_angle, start_angle));
  describe_cells(parameters, cells_radial, grading_radial, "cells across", "grading across", "from the inner to the outer radius", "cells radial",
                 "grading radial");
  describe_cells(parameters, cells_around, grading_around, "cells around", "grading around",
                 "from the start to the end angle (sizes on the inner arc)");
}

PatchComplex RingSectorMesh::build(CellShape cell, const Place& place) const {
  constexpr double degree = boost::math::constants::pi<double>() / 180.0;
  const double first = start_angle * degree, last = end_angle * degree, sweep = last - first;
  const Spacing radial = grading_radial.spacing(outer_radius - inner_radius, cells_radial, place);
  const Spacing around = grading_around.spacing(inner_radius * sweep, cells_around, place);
  const auto polar = [](double radius, double angle) { return Point{radius * std::cos(angle), radius * std::sin(angle)}; };
  const Point center{0.0, 0.0};
  return PatchComplex(cell, {polar(inner_radius, first), polar(outer_radius, first), polar(outer_radius, last), polar(inner_radius, last)},
                      {{0, 1, radial}, {1, 2, around, center, sweep}, {3, 2, radial}, {0, 3, around, center, sweep}},
                      {{{0, 1, 2, 3}, {"start", "outer", "end", "inner"}}}, placement());
}

}  // namespace mortise
