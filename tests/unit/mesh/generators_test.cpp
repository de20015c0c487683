// The built-in kinds of meshes: where their sides lie, their areas, the shape of their cells, their parameters and errors.

#include "mortise/mesh/generators.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <boost/math/constants/constants.hpp>
#include <cmath>

#include "mesh_test_support.hpp"
#include "mortise/input/read_parameters.hpp"
#include "mortise/input/xml.hpp"

namespace mortise {
namespace {

constexpr double pi = boost::math::constants::pi<double>();

double area(const PatchComplex& complex) {
  double sum = 0.0;
  const int corners = topology(complex.shape()).nodes;
  for (GlobalOrdinal e = 0; e < complex.element_count(); ++e)
    for (int a = 0; a < corners; ++a) {
      const Point p = complex.coordinate(complex.element_nodes(e)[a]), q = complex.coordinate(complex.element_nodes(e)[(a + 1) % corners]);
      sum += 0.5 * (p[0] * q[1] - p[1] * q[0]);
    }
  return sum;
}

/// Degrees.
double smallest_angle(const PatchComplex& complex) {
  double smallest = 180.0;
  const int corners = topology(complex.shape()).nodes;
  for (GlobalOrdinal e = 0; e < complex.element_count(); ++e)
    for (int a = 0; a < corners; ++a) {
      const auto nodes = complex.element_nodes(e);
      const Point p = complex.coordinate(nodes[a]), q = complex.coordinate(nodes[(a + 1) % corners]);
      const Point r = complex.coordinate(nodes[(a + corners - 1) % corners]);
      const double ux = q[0] - p[0], uy = q[1] - p[1], vx = r[0] - p[0], vy = r[1] - p[1];
      smallest = std::min(smallest, std::atan2(ux * vy - uy * vx, ux * vx + uy * vy) * 180.0 / pi);
    }
  return smallest;
}

/// Positions of the nodes on a side, in no particular order.
std::vector<Point> side_points(const PatchComplex& complex, const std::string& side) {
  std::vector<Point> points;
  for (GlobalOrdinal n = 0; n < complex.node_count(); ++n)
    for (const int name : complex.sides_of_node(n))
      if (complex.side_names()[name] == side) points.push_back(complex.coordinate(n));
  return points;
}

/// The nodes of `side` are exactly those at which `distance` vanishes.
template <class Distance>
void expect_side(const PatchComplex& complex, const std::string& side, Distance&& distance) {
  SCOPED_TRACE(side);
  std::size_t there = 0;
  for (GlobalOrdinal n = 0; n < complex.node_count(); ++n) there += std::abs(distance(complex.coordinate(n))) < 1e-12;
  const auto points = side_points(complex, side);
  EXPECT_EQ(points.size(), there);
  for (const Point& x : points) EXPECT_NEAR(distance(x), 0.0, 1e-12);
}

double radius_of(const Point& x) { return std::hypot(x[0], x[1]); }

TEST(BlockMesh, IsTheRectangleWithItsSides) {
  BlockMesh block;
  block.width = 4.0;
  block.height = 2.0;
  block.cells_x = 5;
  block.cells_y = 3;
  for (const auto cell : {CellShape::quadrilateral4, CellShape::triangle3}) {
    const auto complex = block.build(cell, {});
    EXPECT_EQ(complex.node_count(), 6 * 4);
    EXPECT_EQ(complex.element_count(), cell == CellShape::triangle3 ? 30 : 15);
    EXPECT_NEAR(area(complex), 8.0, 1e-13);
    expect_side(complex, "bottom", [](const Point& x) { return x[1]; });
    expect_side(complex, "top", [](const Point& x) { return x[1] - 2.0; });
    expect_side(complex, "left", [](const Point& x) { return x[0]; });
    expect_side(complex, "right", [](const Point& x) { return x[0] - 4.0; });
  }
}

TEST(BlockMesh, IsFineNearTheCornerThatItIsGradedToward) {
  BlockMesh block;
  block.width = block.height = 100.0;
  block.grading_x.smallest_cell = block.grading_y.smallest_cell = 0.125;
  block.grading_x.refined_length = block.grading_y.refined_length = 2.0;
  block.grading_y.toward = FineEnd::end;
  const auto complex = block.build(CellShape::quadrilateral4, {});
  auto top = side_points(complex, "top"), left = side_points(complex, "left");
  std::sort(top.begin(), top.end());
  std::sort(left.begin(), left.end());
  for (int i = 0; i < 16; ++i) {
    EXPECT_NEAR(top[i][0], 0.125 * i, 1e-12);
    EXPECT_NEAR(left[left.size() - 1 - i][1], 100.0 - 0.125 * i, 1e-10);
  }
  EXPECT_NEAR(smallest_angle(complex), 90.0, 1e-9);
}

TEST(WedgeMesh, HasAnInclinedTop) {
  WedgeMesh wedge;
  wedge.width = 4.0;
  wedge.left_height = 1.0;
  wedge.right_height = 3.0;
  wedge.cells_x = 4;
  wedge.cells_y = 3;
  const auto complex = wedge.build(CellShape::quadrilateral4, {});
  EXPECT_NEAR(area(complex), 8.0, 1e-13);
  expect_side(complex, "top", [](const Point& x) { return x[1] - 1.0 - 0.5 * x[0]; });
  expect_side(complex, "right", [](const Point& x) { return x[0] - 4.0; });
}

TEST(RingSectorMesh, FollowsItsCircles) {
  RingSectorMesh ring;
  ring.inner_radius = 2.0;
  ring.outer_radius = 3.0;
  ring.start_angle = 30.0;
  ring.end_angle = 300.0;
  ring.cells_radial = 4;
  ring.cells_around = 27;
  const auto complex = ring.build(CellShape::quadrilateral4, {});
  expect_side(complex, "inner", [](const Point& x) { return radius_of(x) - 2.0; });
  expect_side(complex, "outer", [](const Point& x) { return radius_of(x) - 3.0; });
  for (const Point& x : side_points(complex, "start")) EXPECT_NEAR(std::atan2(x[1], x[0]), pi / 6.0, 1e-13);
  for (const Point& x : side_points(complex, "end")) EXPECT_NEAR(std::atan2(x[1], x[0]), -pi / 3.0, 1e-13);
  // Chords of 10 degrees under the arcs: area = n/2 sin(10 degrees) (R^2 - r^2).
  EXPECT_NEAR(area(complex), 0.5 * 27 * std::sin(pi / 18.0) * 5.0, 1e-12);
}

TEST(DiskMesh, SidesLieOnTheCircleAndOnTheFlatSides) {
  for (const auto& mesh : example_meshes()) {
    if (!std::dynamic_pointer_cast<DiskMesh>(mesh.options)) continue;
    SCOPED_TRACE(mesh.name);
    const auto complex = mesh.options->build(CellShape::quadrilateral4, {});
    expect_side(complex, "arc", [](const Point& x) { return radius_of(x) - 1.0; });
    if (mesh.name != "right half disk") expect_side(complex, "diameter", [](const Point& x) { return x[1]; });
    if (mesh.name != "lower half disk") expect_side(complex, "axis", [](const Point& x) { return x[0]; });
    double lowest = 0.0;
    for (const Point& x : side_points(complex, "arc")) lowest = std::min(lowest, x[1]);
    EXPECT_NEAR(lowest, -1.0, 1e-15);
  }
}

TEST(FullDiskMesh, IsThePolygonOnItsCircle) {
  FullDiskMesh disk;
  disk.radius = 3.0;
  disk.cells_around = 5;
  disk.cells_across = 4;
  expect_side(disk.build(CellShape::triangle6, {}), "arc", [](const Point& x) { return radius_of(x) - 3.0; });
  const auto complex = disk.build(CellShape::quadrilateral4, {});
  EXPECT_EQ(complex.element_count(), 5 * 5 + 4 * 5 * 4);
  EXPECT_NEAR(area(complex), 0.5 * 20 * std::sin(0.1 * pi) * 9.0, 1e-12);
  EXPECT_GT(smallest_angle(complex), 40.0);
  expect_side(complex, "arc", [](const Point& x) { return radius_of(x) - 3.0; });
}

TEST(DiskMesh, AreaConvergesWithOrderTwo) {
  for (const bool half : {false, true}) {
    double last = 0.0;
    for (const int cells : {4, 8, 16, 32}) {
      QuarterDiskMesh quarter;
      HalfDiskMesh lower;
      DiskMesh& disk = half ? static_cast<DiskMesh&>(lower) : quarter;
      disk.radius = 3.0;
      disk.cells_along = disk.cells_across = disk.cells_beyond = cells;
      const double exact = (half ? 0.5 : 0.25) * pi * 9.0, error = exact - area(disk.build(CellShape::triangle3, {}));
      // A chord over the angle h takes R^2 (h - sin h) / 2 from the disk.
      const double h = 0.25 * pi / cells;
      EXPECT_NEAR(error, (half ? 4 : 2) * cells * 0.5 * 9.0 * (h - std::sin(h)), 1e-11);
      if (last > 0.0) EXPECT_NEAR(std::log2(last / error), 2.0, 0.02);
      last = error;
    }
  }
}

TEST(DiskMesh, KeepsItsAnglesWhenGradedTowardTheLowestPoint) {
  // As for Hertz: n cells per half width a, a / R from 1/50 to 1/20.
  for (const double a : {0.02, 0.05})
    for (const int n : {2, 4, 8, 16})
      for (const auto half : {DiskHalf::lower, DiskHalf::right}) {
        HalfDiskMesh disk;
        disk.half = half;
        disk.grading_along.smallest_cell = disk.grading_across.smallest_cell = a / n;
        disk.grading_along.refined_length = 2.0 * a;
        disk.grading_across.refined_length = a;
        disk.grading_along.growth = disk.grading_across.growth = 1.25;
        const auto complex = disk.build(CellShape::quadrilateral4, {});
        EXPECT_GT(smallest_angle(complex), 20.0) << "a = " << a << ", n = " << n;
        // The cells next to the lowest point are a / n long, seen along the arc.
        int within = 0;
        for (const Point& x : side_points(complex, "arc")) within += x[1] < 0.0 && x[0] > 1e-12 && std::asin(x[0]) < a * (1.0 + 1e-9);
        EXPECT_GE(within, n);
      }
}

TEST(MeshOptions, RotationAndTranslationMoveEveryNode) {
  for (const auto& mesh : example_meshes()) {
    const auto before = mesh.options->build(CellShape::quadrilateral4, {});
    mesh.options->rotation = 30.0;
    mesh.options->translation = {5.0, -2.0};
    const auto after = mesh.options->build(CellShape::quadrilateral4, {});
    const double c = std::sqrt(0.75), s = 0.5;
    for (GlobalOrdinal n = 0; n < before.node_count(); ++n) {
      const Point x = before.coordinate(n), y = after.coordinate(n);
      EXPECT_NEAR(y[0], c * x[0] - s * x[1] + 5.0, 1e-13);
      EXPECT_NEAR(y[1], s * x[0] + c * x[1] - 2.0, 1e-13);
    }
  }
}

struct MeshList {
  Choice<MeshOptions> mesh;
  void describe(Parameters& parameters) { parameters.choose(mesh, mesh_registry(), Says("the mesh")); }
};

/// Reads a mesh from lines of a scene that starts in line 1; returns what is wrong.
std::string errors_of(const std::string& lines) {
  MeshList list;
  std::vector<Diagnostic> diagnostics;
  read_parameters(list, parse_xml("<ParameterList name=\"mesh\">\n" + lines + "</ParameterList>\n", "scene.xml"), Symbols{}, {}, diagnostics);
  std::string text;
  for (const auto& diagnostic : diagnostics) text += to_string(diagnostic) + "\n";
  return text;
}

std::string parameter(const std::string& name, const std::string& type, const std::string& value) {
  return "<Parameter name=\"" + name + "\" type=\"" + type + "\" value=\"" + value + "\"/>\n";
}

TEST(MeshOptions, EveryKindIsReadFromAScene) {
  const std::string cells = parameter("cells x", "int", "3") + parameter("cells y", "int", "2");
  EXPECT_EQ(errors_of(parameter("type", "string", "block") + cells), "");
  EXPECT_EQ(errors_of(parameter("type", "string", "wedge") + cells), "");
  EXPECT_THAT(errors_of(parameter("type", "string", "ring sector") + parameter("cells around", "int", "4") + parameter("cells radial", "int", "3")),
              ::testing::HasSubstr("unknown parameter \"cells radial\"; it is called \"cells across\" now"));
  EXPECT_EQ(errors_of(parameter("type", "string", "ring sector") + parameter("cells across", "int", "3") + parameter("cells around", "int", "4")),
            "");
  const std::string disk = parameter("cells along", "int", "3") + parameter("cells across", "int", "3");
  EXPECT_EQ(errors_of(parameter("type", "string", "quarter disk") + disk), "");
  EXPECT_EQ(errors_of(parameter("type", "string", "half disk") + disk + parameter("half", "string", "right")), "");
}

TEST(MeshOptions, MistakesAreNamedWithTheirLine) {
  using ::testing::HasSubstr;
  const std::string block = parameter("type", "string", "block"), cells = parameter("cells x", "int", "3") + parameter("cells y", "int", "2");
  EXPECT_THAT(errors_of(block), ::testing::AllOf(HasSubstr("cells x"), HasSubstr("cells y"), HasSubstr("smallest cell")));
  EXPECT_THAT(errors_of(block + cells + parameter("corners", "string", "0, 0, 1, 0, 1, 1")), HasSubstr("scene.xml:5: error"));
  EXPECT_THAT(errors_of(block + cells + parameter("translation", "string", "1, 2, 3")), HasSubstr("needs two numbers"));
  EXPECT_THAT(errors_of(block + cells + "<ParameterList name=\"grading x\">\n" + parameter("smallest cell", "double", "0.1") + "</ParameterList>\n"),
              HasSubstr("either \"cells x\" or a \"smallest cell\""));
  EXPECT_THAT(errors_of(block + cells + parameter("width", "double", "-1")), HasSubstr("scene.xml:5: error"));
  EXPECT_THAT(errors_of(parameter("type", "string", "ring sector") + parameter("cells across", "int", "3") + parameter("cells around", "int", "4") +
                        parameter("inner radius", "double", "5")),
              HasSubstr("larger than \"inner radius\""));
  EXPECT_THAT(errors_of(parameter("type", "string", "half disc")), HasSubstr("half disk"));
}

}  // namespace
}  // namespace mortise
