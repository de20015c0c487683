// Surfaces of rigid bodies in 3D.

#include "mortise/mesh/shell_complex.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "volume_test_support.hpp"

namespace mortise {
namespace {

using ::testing::HasSubstr;

/// Positions of a quadrilateral's corners, from the least one on.
using Quadrilateral = std::array<SpatialPoint, 4>;

Quadrilateral from_least(Quadrilateral corners) {
  for (SpatialPoint& corner : corners)
    for (double& x : corner) x = std::round(x * 1e9) / 1e9 + 0.0;
  std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
  return corners;
}

/// The sides of hexahedra and the facets of the surface are the same quadrilaterals, seen from the same side, under the same names.
TEST(ShellComplex, IsTheSurfaceOfEveryMesh) {
  for (const auto& example : example_volumes()) {
    SCOPED_TRACE(example.name);
    const ShellComplex shell = example.options->build_surface({});
    std::map<Quadrilateral, std::string> expected, found;
    std::visit(
        [&](const auto& complex) {
          for (GlobalOrdinal element = 0; element < complex.element_count(); ++element)
            for (const auto& side : complex.surface_sides(element)) {
              const std::string& name = complex.side_names()[side.name];
              const auto& names = shell.side_names();
              if (std::find(names.begin(), names.end(), name) == names.end()) continue;
              const auto nodes = complex.element_nodes(element);
              const auto& corners = topology(CellShape::hexahedron8).sides[side.side].nodes;
              Quadrilateral facet;
              for (int a = 0; a < 4; ++a) {
                const auto x = complex.coordinate(nodes[corners[a]]);
                facet[a] = {};
                std::copy(x.begin(), x.end(), facet[a].begin());
              }
              expected[from_least(facet)] = name;
            }
        },
        example.options->build(CellShape::hexahedron8, {}));
    for (GlobalOrdinal element = 0; element < shell.element_count(); ++element) {
      const auto nodes = shell.element_nodes(element);
      const auto sides = shell.surface_sides(element);
      ASSERT_EQ(sides.size(), 1u);
      EXPECT_EQ(sides[0].side, the_cell_itself);
      found[from_least({shell.coordinate(nodes[0]), shell.coordinate(nodes[1]), shell.coordinate(nodes[2]), shell.coordinate(nodes[3])})] =
          shell.side_names()[sides[0].name];
    }
    EXPECT_FALSE(found.empty());
    EXPECT_EQ(found, expected);
  }
}

/// Every node is at one place and in the elements that say so; on the sides that its elements are on.
TEST(ShellComplex, NodesElementsAndSidesAgree) {
  for (const auto& example : example_volumes()) {
    SCOPED_TRACE(example.name);
    const ShellComplex shell = example.options->build_surface({});
    std::vector<std::vector<GlobalOrdinal>> elements(shell.node_count());
    std::map<SpatialPoint, GlobalOrdinal> at;
    for (GlobalOrdinal element = 0; element < shell.element_count(); ++element)
      for (const GlobalOrdinal node : shell.element_nodes(element)) elements.at(node).push_back(element);
    for (GlobalOrdinal node = 0; node < shell.node_count(); ++node) {
      EXPECT_EQ(shell.elements_of_node(node), elements[node]);
      SpatialPoint x = shell.coordinate(node);
      for (double& component : x) component = std::round(component * 1e9) / 1e9 + 0.0;
      EXPECT_TRUE(at.insert({x, node}).second) << "two nodes at the same place";
      std::vector<int> names;
      for (const GlobalOrdinal element : elements[node]) names.push_back(shell.surface_sides(element)[0].name);
      std::sort(names.begin(), names.end());
      names.erase(std::unique(names.begin(), names.end()), names.end());
      EXPECT_EQ(shell.sides_of_node(node), names);
    }
  }
}

TEST(ShellComplex, SweepsAProfile) {
  auto profile = std::make_shared<ProfileMesh>();
  profile->points = {3.0, 0.0, 0.0, 0.0};  // the body lies below
  profile->cell_size = 1.0;
  ExtrudedMesh plane;
  plane.profile = {"profile", profile, {}};
  plane.length = 2.0;
  plane.cells_z = 4;
  const ShellComplex shell = plane.build_surface({});
  EXPECT_EQ(shell.element_count(), 12);
  EXPECT_EQ(shell.node_count(), 20);
  const auto nodes = shell.element_nodes(0);
  const auto x = [&](int a) { return Eigen::Vector3d(shell.coordinate(nodes[a]).data()); };
  EXPECT_NEAR((x(1) - x(0)).cross(x(3) - x(0)).normalized().y(), 1.0, 1e-14);
  EXPECT_THAT(input_error_of([&] { plane.build(CellShape::hexahedron8, {}); }), HasSubstr("has no inside"));
}

TEST(ShellComplex, RefusesPatchesThatDoNotFit) {
  EXPECT_THROW(ShellComplex({{{0, 1, 2, 3}, {2, 2}, "a"}, {{1, 4, 5, 2}, {2, 3}, "a"}}, [](const auto&) { return SpatialPoint{}; }, {}),
               std::logic_error);
}

}  // namespace
}  // namespace mortise
