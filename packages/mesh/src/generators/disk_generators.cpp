// Quarter and half disks around an inner patch, so that no cell degenerates at the centre.

#include <boost/math/constants/constants.hpp>
#include <cmath>

#include "generators/describe_cells.hpp"
#include "mortise/mesh/generators.hpp"

namespace mortise {
namespace {

// Corners of the inner patch, as shares of the radius: on the axes, and both coordinates on the diagonal.
constexpr double inner_axis = PolarCells::inner, inner_diagonal = 0.38;

}  // namespace

PatchComplex DiskMesh::build_quarters(CellShape cell, const Place& place, bool lower_left, bool upper_right) const {
  const double R = radius, p = inner_axis * R, d = inner_diagonal * R, m = R * std::sqrt(0.5);
  const auto [along, across, beyond] = spacings(place);
  const Spacing inner(along.cells()), radial(across.cells());
  const Point center{0.0, 0.0};

  std::vector<Point> corners;
  std::vector<PatchComplex::Edge> edges;
  std::vector<PatchComplex::Patch> patches;
  const auto corner = [&](double x, double y) { return corners.push_back({x, y}), static_cast<int>(corners.size()) - 1; };
  const int o = corner(0.0, 0.0), s = corner(p, 0.0), b = corner(R, 0.0);
  edges.push_back({o, s, inner});
  edges.push_back({s, b, radial});
  const std::string horizontal = upper_right ? "" : "diameter", vertical = lower_left ? "" : "axis";

  // A quarter between the vertical half axis o-v-a and the horizontal one o-h-e, with q and m on the diagonal. Mirrored quarters run
  // clockwise, so their patches are listed the other way round.
  const auto quarter = [&](int v, int a, int h, int e, double sx, double sy, const Spacing& arc) {
    const int q = corner(sx * d, sy * d), middle = corner(sx * m, sy * m);
    edges.push_back({v, q, inner});
    edges.push_back({q, h, beyond});
    edges.push_back({middle, q, radial});
    edges.push_back({a, middle, arc, center});
    edges.push_back({middle, e, beyond, center});
    const auto patch = [&](const std::array<int, 4>& c, const std::array<std::string, 4>& names) {
      const bool counterclockwise = sx * sy < 0.0;
      if (counterclockwise)
        patches.push_back({c, names});
      else
        patches.push_back({{c[1], c[0], c[3], c[2]}, {names[0], names[3], names[2], names[1]}});
    };
    patch({v, q, h, o}, {"", "", horizontal, vertical});
    patch({a, middle, q, v}, {"arc", "", "", vertical});
    patch({middle, e, h, q}, {"arc", horizontal, "", ""});
  };

  const int v = corner(0.0, -p), a = corner(0.0, -R);
  edges.push_back({o, v, beyond});
  edges.push_back({a, v, across});
  quarter(v, a, s, b, 1.0, -1.0, along);
  if (lower_left) {
    const int h = corner(-p, 0.0), e = corner(-R, 0.0);
    edges.push_back({o, h, inner});
    edges.push_back({h, e, radial});
    quarter(v, a, h, e, -1.0, -1.0, along);
  }
  if (upper_right) {
    const int top_v = corner(0.0, p), top = corner(0.0, R);
    edges.push_back({o, top_v, beyond});
    edges.push_back({top, top_v, radial});
    quarter(top_v, top, s, b, 1.0, 1.0, inner);
  }
  return PatchComplex(cell, std::move(corners), std::move(edges), std::move(patches), placement());
}

PatchComplex QuarterDiskMesh::build(CellShape cell, const Place& place) const { return build_quarters(cell, place, false, false); }

void HalfDiskMesh::describe_shape(Parameters& parameters) {
  DiskMesh::describe_shape(parameters);
  parameters.add("half", half, {{"lower", DiskHalf::lower}, {"right", DiskHalf::right}},
                 Says("lower: y <= 0, its flat side \"diameter\" on top; right: x >= 0, its flat side \"axis\" on x = 0"));
}

PatchComplex HalfDiskMesh::build(CellShape cell, const Place& place) const {
  return build_quarters(cell, place, half == DiskHalf::lower, half == DiskHalf::right);
}

void FullDiskMesh::describe_shape(Parameters& parameters) {
  parameters.add("radius", radius, Says("radius of the disk").unit("length").above(0.0));
  parameters.add("cells around", cells_around, Says("number of cells on each quarter of the circle").at_least(1).at_most(most_cells).required());
  describe_cells(parameters, cells_across, grading_across, "cells across", "grading across", "from the circle to the inner patch");
}

PatchComplex FullDiskMesh::build(CellShape cell, const Place& place) const {
  const double d = inner_diagonal * radius, m = radius * std::sqrt(0.5);
  const Spacing around(cells_around), across = grading_across.spacing(radius - d / std::sqrt(0.5), cells_across, place);
  const Point center{0.0, 0.0};
  // Corners k of the inner patch, corners 4 + k on the circle, both counterclockwise from the lower left.
  std::vector<PatchComplex::Edge> edges;
  std::vector<PatchComplex::Patch> patches{{{0, 1, 2, 3}, {}}};
  for (int k = 0; k < 4; ++k) {
    const int next = (k + 1) % 4;
    edges.push_back({k, next, around});
    edges.push_back({4 + k, 4 + next, around, center});
    edges.push_back({4 + k, k, across});
    patches.push_back({{4 + k, 4 + next, next, k}, {side, "", "", ""}});
  }
  return PatchComplex(cell, {{-d, -d}, {d, -d}, {d, d}, {-d, d}, {-m, -m}, {m, -m}, {m, m}, {-m, m}}, std::move(edges), std::move(patches),
                      placement());
}

}  // namespace mortise
