// Meshes that gmsh and meshio wrote (files/make_files.py): the same box and the same rectangle in every format, whatever the order of nodes.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "mesh_file_test_support.hpp"

namespace mortise {
namespace {

using ::testing::ElementsAre;
using ::testing::UnorderedElementsAre;

MeshFile read_written(const std::string& name) { return read_mesh_file(std::string(MESH_FILES) + "/" + name, MeshFormat::by_name, {}); }

struct WrittenShape {
  std::string name;
  CellShape shape;
  std::size_t nodes, cells;
};

void PrintTo(const WrittenShape& shape, std::ostream* stream) { *stream << shape.name; }

class WrittenMeshes : public ::testing::TestWithParam<WrittenShape> {};

const FileCells& cells_of(const MeshFile& file, CellShape shape) {
  for (const FileCells& cells : file.cells)
    if (cells.shape == shape) return cells;
  throw std::out_of_range("there are no cells of the shape");
}

TEST_P(WrittenMeshes, AreTheSameInAllFormatsOfGmsh) {
  const auto& [name, shape, nodes, cells] = GetParam();
  const bool solid = topology(shape).dimension == 3;
  for (const std::string format : {"22_text", "22_binary", "41_text", "41_binary"}) {
    SCOPED_TRACE(format);
    const MeshFile file = read_written("gmsh_" + format.substr(0, 1) + "/" + name + "_" + format + ".msh");
    EXPECT_EQ(file.coordinates.size(), nodes);
    EXPECT_EQ(file.node_labels.size(), nodes);
    EXPECT_EQ(cells_of(file, shape).labels.size(), cells);
    expect_middles(file);
    EXPECT_EQ(file.notes.size(), 0u);
    const auto& origin = set_named(file.node_sets, "origin").members;
    ASSERT_EQ(origin.size(), 1u);
    EXPECT_THAT(file.coordinates[static_cast<std::size_t>(origin[0])], ElementsAre(0.0, 0.0, 0.0));
    // Exact but for the rounding of sums of some hundred terms.
    if (solid) {
      EXPECT_THAT(names_of_sets(file.cell_sets), UnorderedElementsAre("top", "physical surface 77", "steel", "all"));
      EXPECT_NEAR(measure_of(file, set_named(file.cell_sets, "steel")), 2.0, 1e-12);
      EXPECT_NEAR(measure_of(file, set_named(file.cell_sets, "all")), 2.0, 1e-12);
      EXPECT_NEAR(measure_of(file, set_named(file.cell_sets, "top")), 2.0, 1e-12);
      EXPECT_NEAR(measure_of(file, set_named(file.cell_sets, "physical surface 77")), 1.0, 1e-12);
    } else {
      EXPECT_THAT(names_of_sets(file.cell_sets), UnorderedElementsAre("sheet", "bottom"));
      EXPECT_NEAR(measure_of(file, set_named(file.cell_sets, "sheet")), 2.0, 1e-12);
      EXPECT_NEAR(measure_of(file, set_named(file.cell_sets, "bottom")), 2.0, 1e-12);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    Shapes, WrittenMeshes,
    ::testing::Values(WrittenShape{"hexahedra8", CellShape::hexahedron8, 12, 2}, WrittenShape{"hexahedra20", CellShape::hexahedron20, 32, 2},
                      WrittenShape{"tetrahedra4", CellShape::tetrahedron4, 12, 12}, WrittenShape{"tetrahedra10", CellShape::tetrahedron10, 45, 12},
                      WrittenShape{"wedges6", CellShape::wedge6, 12, 4}, WrittenShape{"wedges15", CellShape::wedge15, 36, 4},
                      WrittenShape{"triangles3", CellShape::triangle3, 6, 4}, WrittenShape{"triangles6", CellShape::triangle6, 15, 4},
                      WrittenShape{"quadrilaterals4", CellShape::quadrilateral4, 6, 2},
                      WrittenShape{"quadrilaterals8", CellShape::quadrilateral8, 13, 2}),
    [](const auto& info) { return info.param.name; });

class WrittenSolids : public ::testing::TestWithParam<WrittenShape> {};

// gmsh writes groups of surfaces as plane elements there, and groups of all dimensions as sets of nodes too.
TEST_P(WrittenSolids, AreTheSameInTheFormatOfAbaqus) {
  const auto& [name, shape, nodes, cells] = GetParam();
  const MeshFile file = read_written("abaqus/" + name + ".inp");
  EXPECT_EQ(file.coordinates.size(), nodes);
  EXPECT_EQ(cells_of(file, shape).labels.size(), cells);
  expect_middles(file);
  EXPECT_NEAR(measure_of(file, set_named(file.cell_sets, "steel")), 2.0, 1e-12);
  EXPECT_NEAR(measure_of(file, set_named(file.cell_sets, "top")), 2.0, 1e-12);
  EXPECT_EQ(set_named(file.node_sets, "all").members.size(), nodes);
  for (const std::int32_t node : set_named(file.node_sets, "top").members) EXPECT_EQ(file.coordinates[static_cast<std::size_t>(node)][2], 1.0);
}

INSTANTIATE_TEST_SUITE_P(Shapes, WrittenSolids,
                         ::testing::Values(WrittenShape{"hexahedra8", CellShape::hexahedron8, 12, 2},
                                           WrittenShape{"hexahedra20", CellShape::hexahedron20, 32, 2},
                                           WrittenShape{"tetrahedra4", CellShape::tetrahedron4, 12, 12},
                                           WrittenShape{"tetrahedra10", CellShape::tetrahedron10, 45, 12},
                                           WrittenShape{"wedges6", CellShape::wedge6, 12, 4}, WrittenShape{"wedges15", CellShape::wedge15, 36, 4}),
                         [](const auto& info) { return info.param.name; });

TEST(WrittenByMeshio, IsReadAsExodus) {
  for (const auto& [name, shape, nodes, cells] :
       {WrittenShape{"tetrahedra10", CellShape::tetrahedron10, 45, 12}, WrittenShape{"triangles6", CellShape::triangle6, 15, 4}}) {
    SCOPED_TRACE(name);
    const MeshFile file = read_written("exodus/" + name + ".e");
    EXPECT_EQ(file.coordinates.size(), nodes);
    ASSERT_EQ(file.cells.size(), 1u);
    EXPECT_EQ(file.cells[0].shape, shape);
    expect_middles(file);
    EXPECT_THAT(names_of_sets(file.cell_sets), ElementsAre("block 0"));
    EXPECT_NEAR(measure_of(file, file.cell_sets[0]), 2.0, 1e-12);
  }
}

// Cells between partitions are of no group, and parts of an entity are the entity's.
TEST(WrittenByGmsh, PartitionsAreOneMesh) {
  const MeshFile file = read_written("gmsh_4/tetrahedra4_partitioned.msh"), whole = read_written("gmsh_4/tetrahedra4_41_text.msh");
  EXPECT_EQ(file.coordinates.size(), whole.coordinates.size());
  for (const std::string name : {"steel", "all", "top", "physical surface 77"}) {
    EXPECT_NEAR(measure_of(file, set_named(file.cell_sets, name)), measure_of(whole, set_named(whole.cell_sets, name)), 1e-12) << name;
  }
}

TEST(WrittenByGmsh, EntitiesAreSetsWithoutGroups) {
  const MeshFile file = read_written("gmsh_4/hexahedra8_without_groups.msh");
  EXPECT_NEAR(measure_of(file, set_named(file.cell_sets, "surface 27")), 2.0, 1e-12);
  EXPECT_NEAR(measure_of(file, set_named(file.cell_sets, "curve 1")), 2.0, 1e-12);
  EXPECT_EQ(set_named(file.node_sets, "point 2").members.size(), 1u);
}

TEST(WrittenByGmsh, OldVersionsAreRefused) {
  for (const std::string name : {"gmsh_4/version_40.msh", "gmsh_2/version_1.msh"}) {
    try {
      read_written(name);
      FAIL() << name << " was read";
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), ::testing::HasSubstr("gmsh -save -format msh41")) << name;
    }
  }
}

}  // namespace
}  // namespace mortise
