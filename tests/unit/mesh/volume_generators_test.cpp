// The built-in kinds of 3D meshes: where their sides lie, their parameters and errors.

#include "mortise/mesh/volume_generators.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Teuchos_DefaultSerialComm.hpp>

#include "mortise/input/read_parameters.hpp"
#include "mortise/input/xml.hpp"
#include "volume_test_support.hpp"

namespace mortise {
namespace {

using ::testing::HasSubstr;

/// The nodes of `side` are exactly those at which `distance` vanishes.
template <class Distance>
void expect_side(const VolumeMesh& options, const std::string& side, const Distance& distance) {
  for (const auto cell : cells_of(options))
    with_volume(options, cell, [&](const auto& complex) {
      SCOPED_TRACE(side);
      const auto& names = complex.side_names();
      const int wanted = static_cast<int>(std::find(names.begin(), names.end(), side) - names.begin());
      for (GlobalOrdinal n = 0; n < complex.node_count(); ++n) {
        const auto of_node = complex.sides_of_node(n);
        const bool is_there = std::abs(distance(complex.coordinate(n))) < 1e-12;
        EXPECT_EQ(std::count(of_node.begin(), of_node.end(), wanted), is_there ? 1 : 0) << "node " << n;
      }
    });
}

std::shared_ptr<VolumeMesh> example(const std::string& name) {
  for (const auto& mesh : example_volumes())
    if (mesh.name == name) return mesh.options;
  throw std::logic_error("no such example");
}

TEST(BrickMesh, SidesLieOnItsPlanes) {
  const auto brick = example("brick");
  expect_side(*brick, "left", [](const SpatialPoint& x) { return x[0]; });
  expect_side(*brick, "right", [](const SpatialPoint& x) { return x[0] - 3.0; });
  expect_side(*brick, "front", [](const SpatialPoint& x) { return x[1]; });
  expect_side(*brick, "back", [](const SpatialPoint& x) { return x[1] - 2.0; });
  expect_side(*brick, "bottom", [](const SpatialPoint& x) { return x[2]; });
  expect_side(*brick, "top", [](const SpatialPoint& x) { return x[2] - 1.5; });
  with_volume(*brick, CellShape::hexahedron8, [](const auto& complex) {
    EXPECT_EQ(complex.node_count(), 5 * 4 * 3);
    EXPECT_EQ(complex.element_count(), 4 * 3 * 2);
    // Graded toward the bottom by 2: layers of 0.5 and 1.
    EXPECT_NEAR(complex.coordinate(5 * 4)[2], 0.5, 1e-14);
  });
  with_volume(*brick, CellShape::tetrahedron4, [](const auto& complex) { EXPECT_EQ(complex.element_count(), 6 * 4 * 3 * 2); });
  with_volume(*brick, CellShape::wedge6, [](const auto& complex) { EXPECT_EQ(complex.element_count(), 2 * 4 * 3 * 2); });
}

TEST(CylinderMesh, SidesLieOnTheMantleAndOnTheEnds) {
  const auto cylinder = example("cylinder");
  cylinder->rotation = 0.0;
  expect_side(*cylinder, "mantle", [](const SpatialPoint& x) { return std::hypot(x[0], x[1]) - 2.0; });
  expect_side(*cylinder, "bottom", [](const SpatialPoint& x) { return x[2]; });
  expect_side(*cylinder, "top", [](const SpatialPoint& x) { return x[2] - 1.5; });
}

TEST(RevolvedMesh, TurnsAboutTheYAxisFromXTowardZ) {
  const auto ring = example("revolved ring");
  const auto radius = [](const SpatialPoint& x) { return std::hypot(x[0] - 1.0, x[2] - 3.0); };
  expect_side(*ring, "left", [&](const SpatialPoint& x) { return radius(x) - 1.0; });
  expect_side(*ring, "right", [&](const SpatialPoint& x) { return radius(x) - 3.0; });
  expect_side(*ring, "bottom", [](const SpatialPoint& x) { return x[1] - 2.0; });
  expect_side(*ring, "top", [](const SpatialPoint& x) { return x[1] - 3.0; });
  const auto angle = [](const SpatialPoint& x) { return std::atan2(x[2] - 3.0, x[0] - 1.0) * 180.0 / boost::math::constants::pi<double>(); };
  expect_side(*ring, "start", [&](const SpatialPoint& x) { return angle(x); });
  expect_side(*ring, "end", [&](const SpatialPoint& x) { return angle(x) + 160.0; });
}

TEST(RevolvedMesh, IsAListWhereItsProfileReachesTheAxis) {
  auto disk = std::make_shared<HalfDiskMesh>();
  disk->half = DiskHalf::right;
  disk->cells_along = disk->cells_across = 3;
  RevolvedMesh ball;
  ball.profile = {"half disk", disk, {}};
  ball.cells_around = 5;
  const Place place{"scene.xml", 5, "bodies/ball"};
  const auto made = ball.listed(CellShape::hexahedron8, place);
  ASSERT_TRUE(made);
  EXPECT_EQ(made->cells.size(), 2u);  // hexahedra, and wedges on the axis
  disk->translation = {2.0, 0.0};
  EXPECT_FALSE(ball.listed(CellShape::hexahedron8, place));
  disk->translation = {-0.5, 0.0};
  EXPECT_THAT(input_error_of([&] { ball.listed(CellShape::hexahedron8, place); }),
              ::testing::AllOf(HasSubstr("scene.xml:5: error: bodies/ball"), HasSubstr("reaches x = "), HasSubstr("x >= 0")));
}

TEST(VolumeMesh, RefusesCellsThatItCannotBeMadeOf) {
  const Place place{"scene.xml", 5, "bodies/die"};
  for (const auto& mesh : example_volumes()) {
    SCOPED_TRACE(mesh.name);
    EXPECT_THAT(input_error_of([&] { mesh.options->complex(CellShape::pyramid5, place); }),
                ::testing::AllOf(HasSubstr("scene.xml:5: error: bodies/die"), HasSubstr("cannot be made of "), HasSubstr("pyramids; please choose")));
  }
  EXPECT_THAT(input_error_of([&] { example("sphere octant")->complex(CellShape::wedge15, place); }),
              ::testing::AllOf(HasSubstr("scene.xml:5: error: bodies/die"), HasSubstr("cannot be made of wedges")));
}

TEST(SphereOctantMesh, SidesLieOnTheSphereAndOnThePlanes) {
  const auto octant = example("sphere octant");
  expect_side(*octant, "sphere", [](const SpatialPoint& x) { return std::hypot(x[0], x[1], x[2]) - 1.0; });
  expect_side(*octant, "x plane", [](const SpatialPoint& x) { return x[0]; });
  expect_side(*octant, "y plane", [](const SpatialPoint& x) { return x[1]; });
  expect_side(*octant, "equator", [](const SpatialPoint& x) { return x[2]; });
  with_volume(*octant, CellShape::hexahedron8, [](const auto& complex) {
    EXPECT_EQ(complex.element_count(), 3 * 3 * 2 + 4 * (3 * 3 + 2 * 3 * 2));
    for (GlobalOrdinal n = 0; n < complex.node_count(); ++n) {
      const SpatialPoint x = complex.coordinate(n);
      EXPECT_TRUE(x[0] > -1e-15 && x[1] > -1e-15 && x[2] < 1e-15);
    }
  });
}

TEST(SphereOctantMesh, VolumeConvergesWithOrderTwoAndWithFourIfQuadratic) {
  for (const auto cell : {CellShape::hexahedron8, CellShape::tetrahedron4, CellShape::hexahedron20, CellShape::tetrahedron10}) {
    const bool is_quadratic = topology(cell).nodes > topology(cell).corners;
    double last = 0.0;
    for (const int cells : {3, 6, 12}) {
      SphereOctantMesh octant;
      octant.radius = 3.0;
      octant.cells_along = octant.cells_beyond = octant.cells_across = cells;
      octant.grading_along.ratio = octant.grading_across.ratio = 2.0;
      double volume = 0.0;
      with_volume(octant, cell, [&](const auto& complex) {
        for (GlobalOrdinal e = 0; e < complex.element_count(); ++e) {
          Positions x;
          for (const GlobalOrdinal node : complex.element_nodes(e)) x.push_back(Eigen::Vector3d::Map(complex.coordinate(node).data()));
          volume += volume_of_cell(cell, x);
        }
      });
      const double error = boost::math::constants::pi<double>() * 27.0 / 6.0 - volume;
      if (last > 0.0) EXPECT_NEAR(std::log2(std::abs(last / error)), is_quadratic ? 4.0 : 2.0, 0.1);
      last = error;
    }
  }
}

/// Over all corners of hexahedra: the volume that the three unit vectors along its edges span.
double least_scaled_jacobian(const Mesh& mesh) {
  constexpr int next[8][3] = {{1, 3, 4}, {2, 0, 5}, {3, 1, 6}, {0, 2, 7}, {7, 5, 0}, {4, 6, 1}, {5, 7, 2}, {6, 4, 3}};
  double least = 1.0;
  const Block& block = mesh.blocks[0];
  for (LocalOrdinal e = 0; e < block.owned; ++e)
    for (int a = 0; a < 8; ++a) {
      const auto edge = [&](int d) {
        const auto at = [&](int corner) { return Eigen::Vector3d::Map(mesh.coordinates[block.nodes(e)[corner]].data()); };
        return Eigen::Vector3d(at(next[a][d]) - at(a)).normalized();
      };
      least = std::min(least, edge(0).cross(edge(1)).dot(edge(2)));
    }
  return least;
}

TEST(SphereOctantMesh, IsFineAtTheLowestPointWithCellsOfGoodShape) {
  // As for Hertz: n cells per half width a, a / R from 1/20 to 1/10. The pole's cell is a / n long in all directions.
  for (const double a : {0.05, 0.1})
    for (const int n : {2, 4}) {
      SphereOctantMesh octant;
      octant.grading_along.smallest_cell = octant.grading_across.smallest_cell = a / n;
      octant.grading_along.refined_length = 1.5 * a;
      octant.grading_across.refined_length = a;
      octant.grading_along.growth = octant.grading_across.growth = 1.3;
      const auto mesh =
          build_mesh(rcp(new Teuchos::SerialComm<int>()), {{"ball", {}, std::make_shared<SphereOctantMesh>(octant), CellShape::hexahedron8}}, {});
      EXPECT_GT(least_scaled_jacobian(*mesh), 0.34);  // the sine of 20 degrees, the bound for disks
      std::vector<double> along_x, upward;
      for (const LocalOrdinal node : mesh->node_sets.at("ball/y plane")) {
        const auto& x = mesh->coordinates[node];
        if (std::abs(std::hypot(x[0], x[2]) - 1.0) < 1e-12) along_x.push_back(std::asin(x[0]));
        if (std::abs(x[0]) < 1e-12) upward.push_back(1.0 + x[2]);
      }
      std::sort(along_x.begin(), along_x.end());
      std::sort(upward.begin(), upward.end());
      for (int i = 0; i <= n; ++i) {
        EXPECT_NEAR(along_x[i], i * a / n, 1e-12);
        EXPECT_NEAR(upward[i], i * a / n, 1e-12);
      }
    }
}

TEST(VolumeMesh, RotationAboutAnyAxisAndTranslationMoveEveryNode) {
  for (const auto& mesh : example_volumes())
    for (const Eigen::Vector3d& axis : {Eigen::Vector3d(1.0, 0.0, 0.0), Eigen::Vector3d(0.0, 0.0, 1.0), Eigen::Vector3d(1.0, -2.0, 2.0)}) {
      mesh.options->rotation = 0.0;
      mesh.options->translation = {0.0, 0.0, 0.0};
      const auto before = mesh.options->complex(CellShape::hexahedron8, {});
      mesh.options->rotation = 30.0;
      mesh.options->rotation_axis = {axis[0], axis[1], axis[2]};
      mesh.options->translation = {5.0, -2.0, 1.0};
      // Rodrigues: R = I + sin(phi) K + (1 - cos(phi)) K^2, K the cross product with the axis' direction.
      const Eigen::Vector3d n = axis / axis.norm();
      Eigen::Matrix3d K;
      K << 0.0, -n[2], n[1], n[2], 0.0, -n[0], -n[1], n[0], 0.0;
      const Eigen::Matrix3d R = Eigen::Matrix3d::Identity() + 0.5 * K + (1.0 - std::sqrt(0.75)) * K * K;
      with_volume(*mesh.options, CellShape::hexahedron8, [&](const auto& after) {
        const auto& original = std::get<std::decay_t<decltype(after)>>(before);
        for (GlobalOrdinal n = 0; n < after.node_count(); ++n) {
          const Eigen::Vector3d expected = R * Eigen::Vector3d::Map(original.coordinate(n).data()) + Eigen::Vector3d(5.0, -2.0, 1.0);
          EXPECT_NEAR((Eigen::Vector3d::Map(after.coordinate(n).data()) - expected).norm(), 0.0, 1e-13);
        }
      });
    }
}

struct MeshList {
  Choice<MeshOptions> mesh;
  void describe(Parameters& parameters) { parameters.choose(mesh, mesh_registry(), Says("the mesh")); }
};

/// Reads a mesh from lines of a scene that starts in line 1; returns what is wrong.
std::string errors_of(const std::string& lines, MeshList list = {}) {
  std::vector<Diagnostic> diagnostics;
  read_parameters(list, parse_xml("<ParameterList name=\"mesh\">\n" + lines + "</ParameterList>\n", "scene.xml"), Symbols{}, {}, diagnostics);
  std::string text;
  for (const auto& diagnostic : diagnostics) text += to_string(diagnostic) + "\n";
  if (text.empty()) list.mesh.options->complex(CellShape::hexahedron8, {});
  return text;
}

std::string parameter(const std::string& name, const std::string& type, const std::string& value) {
  return "<Parameter name=\"" + name + "\" type=\"" + type + "\" value=\"" + value + "\"/>\n";
}

TEST(VolumeMesh, EveryKindIsReadFromAScene) {
  const std::string z = parameter("cells z", "int", "2"), xy = parameter("cells x", "int", "3") + parameter("cells y", "int", "2");
  EXPECT_EQ(errors_of(parameter("type", "string", "brick") + xy + z + parameter("translation", "string", "1, 2, 3")), "");
  EXPECT_EQ(errors_of(parameter("type", "string", "cylinder") + parameter("cells around", "int", "3") + parameter("cells across", "int", "3") + z +
                      parameter("rotation", "double", "90") + parameter("rotation axis", "string", "1, 0, 0")),
            "");
  const std::string profile = "<ParameterList name=\"profile\">\n" + parameter("type", "string", "block") + xy +
                              parameter("translation", "string", "1, 0") + "</ParameterList>\n";
  EXPECT_EQ(errors_of(parameter("type", "string", "sphere octant") + parameter("cells along", "int", "3") + parameter("cells across", "int", "3")),
            "");
  EXPECT_EQ(errors_of(parameter("type", "string", "extruded") + profile + z), "");
  EXPECT_EQ(errors_of(parameter("type", "string", "revolved") + profile + parameter("cells around", "int", "3")), "");
}

TEST(VolumeMesh, MistakesAreNamedWithTheirLine) {
  const std::string z = parameter("cells z", "int", "2"), xy = parameter("cells x", "int", "3") + parameter("cells y", "int", "2");
  EXPECT_THAT(errors_of(parameter("type", "string", "brick") + xy), HasSubstr("cells z"));
  EXPECT_THAT(errors_of(parameter("type", "string", "brick") + xy + z + parameter("translation", "string", "1, 2")),
              HasSubstr("needs three numbers"));
  EXPECT_THAT(errors_of(parameter("type", "string", "brick") + xy + z + parameter("rotation axis", "string", "0, 0, 0")),
              HasSubstr("not all are zero"));
  EXPECT_THAT(errors_of(parameter("type", "string", "extruded") + z), HasSubstr("profile"));
  const std::string nested = "<ParameterList name=\"profile\">\n" + parameter("type", "string", "brick") + "</ParameterList>\n";
  EXPECT_THAT(errors_of(parameter("type", "string", "extruded") + nested + z), HasSubstr("scene.xml:4: error"));
  EXPECT_THAT(errors_of(parameter("type", "string", "revolved") + nested + parameter("angle", "double", "360")), HasSubstr("angle"));
}

}  // namespace
}  // namespace mortise
