// Surfaces of rigid bodies: profiles, and the surface of a patch mesh.

#include "mortise/mesh/curve_complex.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "mesh_test_support.hpp"

namespace mortise {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

ProfileMesh profile(std::vector<double> points, std::vector<double> radii, double cell_size) {
  ProfileMesh mesh;
  mesh.points = std::move(points);
  mesh.radii = std::move(radii);
  mesh.cell_size = cell_size;
  return mesh;
}

TEST(Profile, StraightPiecesAreCutIntoCellsOfTheGivenSize) {
  const CurveComplex curve = profile({0, 0, 3, 0, 3, 2}, {}, 1.0).build_surface({});
  EXPECT_EQ(curve.element_count(), 5);
  EXPECT_EQ(curve.node_count(), 6);
  EXPECT_THAT(curve.side_names(), ElementsAre("profile"));
  double length = 0.0;
  for (GlobalOrdinal line = 0; line < curve.element_count(); ++line) {
    const auto nodes = curve.element_nodes(line);
    const Point a = curve.coordinate(nodes[0]), b = curve.coordinate(nodes[1]);
    length += std::hypot(b[0] - a[0], b[1] - a[1]);
    EXPECT_NEAR(std::hypot(b[0] - a[0], b[1] - a[1]), 1.0, 1e-14);
  }
  EXPECT_NEAR(length, 5.0, 1e-13);
}

// A right angle rounded by radius r: the arc starts and ends r from the corner, turns by 90 degrees about a centre at r from both pieces.
TEST(Profile, ArcsTouchBothPieces) {
  const double r = 0.5;
  const CurveComplex curve = profile({0, 0, 3, 0, 3, 2}, {r}, 0.01).build_surface({});
  const Point center{3.0 - r, r};
  int on_arc = 0;
  for (GlobalOrdinal node = 0; node < curve.node_count(); ++node) {
    const Point x = curve.coordinate(node);
    const bool on_first = std::abs(x[1]) < 1e-12 && x[0] <= center[0] + 1e-12, on_last = std::abs(x[0] - 3.0) < 1e-12 && x[1] >= center[1] - 1e-12;
    const bool round = std::abs(std::hypot(x[0] - center[0], x[1] - center[1]) - r) < 1e-12 && x[0] >= center[0] - 1e-12 && x[1] <= center[1] + 1e-12;
    EXPECT_TRUE(on_first || on_last || round) << x[0] << " " << x[1];
    on_arc += round;
  }
  EXPECT_EQ(on_arc, 1 + static_cast<int>(std::ceil(0.25 * 2.0 * 3.14159265358979 * r / 0.01)));
}

TEST(Profile, SaysWhatHasNoMeaning) {
  const auto error = [](const ProfileMesh& mesh) { return input_error_of([&] { mesh.build_surface({}); }); };
  EXPECT_THAT(error(profile({0, 0, 1, 0, 1, 1}, {2.0}, 0.1)), HasSubstr("do not fit between points 1 and 2"));
  EXPECT_THAT(error(profile({0, 0, 0, 0}, {}, 0.1)), HasSubstr("are the same"));
  EXPECT_THAT(input_error_of([] { profile({0, 0, 1, 0}, {}, 0.1).build(CellShape::quadrilateral4, {}); }), HasSubstr("has no inside"));
}

/// The sides of the elements of a patch mesh and the lines of its surface are the same segments, in the same direction, under the same names.
TEST(CurveComplex, IsTheSurfaceOfEveryMesh) {
  for (const auto& example : example_meshes()) {
    SCOPED_TRACE(example.name);
    const PatchComplex patches = example.options->build(CellShape::quadrilateral4, {});
    const CurveComplex curve = example.options->build_surface({});
    using Segment = std::array<double, 4>;
    const auto segment = [](const Point& a, const Point& b) {
      const auto rounded = [](double v) { return std::round(v * 1e9) / 1e9 + 0.0; };
      return Segment{rounded(a[0]), rounded(a[1]), rounded(b[0]), rounded(b[1])};
    };
    std::map<Segment, std::string> expected, found;
    for (GlobalOrdinal element = 0; element < patches.element_count(); ++element)
      for (const auto& side : patches.surface_sides(element)) {
        const auto nodes = patches.element_nodes(element);
        expected[segment(patches.coordinate(nodes[side.side]), patches.coordinate(nodes[(side.side + 1) % 4]))] = patches.side_names()[side.name];
      }
    for (GlobalOrdinal line = 0; line < curve.element_count(); ++line) {
      const auto nodes = curve.element_nodes(line);
      found[segment(curve.coordinate(nodes[0]), curve.coordinate(nodes[1]))] = curve.side_names()[curve.surface_sides(line)[0].name];
    }
    EXPECT_EQ(found, expected);
    for (GlobalOrdinal node = 0; node < curve.node_count(); ++node)
      for (const GlobalOrdinal line : curve.elements_of_node(node)) {
        const auto nodes = curve.element_nodes(line);
        EXPECT_TRUE(nodes[0] == node || nodes[1] == node);
      }
  }
}

}  // namespace
}  // namespace mortise
