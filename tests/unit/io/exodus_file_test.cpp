// Exodus files made of what a FieldWriter left, read back by the Exodus library.

#include "mortise/io/exodus_file.hpp"

#include <exodusII.h>
#include <gmock/gmock.h>
#include <hdf5.h>

#include <Tpetra_Core.hpp>
#include <cmath>
#include <filesystem>

#include "file_error.hpp"
#include "file_size_limit.hpp"
#include "mortise/io/field_writer.hpp"
#include "mortise/mesh/build_mesh.hpp"
#include "mortise/mesh/volume_generators.hpp"
#include "scratch_directory.hpp"

namespace mortise {
namespace {

using test::file_error;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

RCP<const Communicator> world() { return Tpetra::getDefaultComm(); }

/// The values of `value(x)` with so many components at the nodes.
template <class Value>
Field at_nodes(const Mesh& mesh, const std::string& name, FieldKind kind, int components, const Value& value) {
  Field field{name, Field::Center::node, kind, components, {}};
  for (const auto& x : mesh.coordinates)
    for (const double v : value(x)) field.values.push_back(v);
  return field;
}

Field at_elements(const Mesh& mesh, const std::string& name, double begin) {
  Field field{name, Field::Center::cell, FieldKind::scalar, 1, {}};
  for (const Block& block : mesh.blocks)
    for (LocalOrdinal e = 0; e < block.owned; ++e) field.values.push_back(begin + static_cast<double>(block.element_ids[e]));
  return field;
}

/// A body of an Exodus file.
struct ReadBlock {
  std::string type, name;
  int nodes = 0;
  std::vector<int> connectivity;
};

/// An Exodus file, open to be read.
class Reader {
 public:
  explicit Reader(const std::string& path) {
    int memory = 8, file = 0;
    float version = 0.0F;
    id_ = ex_open(path.c_str(), EX_READ, &memory, &file, &version);
    EXPECT_GE(id_, 0) << path;
    EXPECT_EQ(file, 8);
    ex_set_max_name_length(id_, 255);
    char title[MAX_LINE_LENGTH + 1] = "";
    int node_sets = 0, side_sets = 0, blocks_count = 0;
    EXPECT_EQ(ex_get_init(id_, title, &dimension, &nodes, &elements, &blocks_count, &node_sets, &side_sets), 0);
    for (auto* one : {&x, &y, &z}) one->resize(static_cast<std::size_t>(nodes));
    EXPECT_EQ(ex_get_coord(id_, x.data(), y.data(), dimension == 3 ? z.data() : nullptr), 0);
    std::vector<int> ids(static_cast<std::size_t>(blocks_count));
    ex_get_ids(id_, EX_ELEM_BLOCK, ids.data());
    for (const int id : ids) {
      char type[256] = "", name[256] = "";
      int count = 0, width = 0, edges = 0, faces = 0, attributes = 0;
      EXPECT_EQ(ex_get_block(id_, EX_ELEM_BLOCK, id, type, &count, &width, &edges, &faces, &attributes), 0);
      EXPECT_EQ(ex_get_name(id_, EX_ELEM_BLOCK, id, name), 0);
      ReadBlock block{type, name, width, std::vector<int>(static_cast<std::size_t>(count) * static_cast<std::size_t>(width))};
      EXPECT_EQ(ex_get_conn(id_, EX_ELEM_BLOCK, id, block.connectivity.data(), nullptr, nullptr), 0);
      blocks.push_back(block);
    }
    element_ids.resize(static_cast<std::size_t>(elements));
    EXPECT_EQ(ex_get_id_map(id_, EX_ELEM_MAP, element_ids.data()), 0);
  }
  ~Reader() { ex_close(id_); }
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;

  std::vector<std::string> variables(ex_entity_type type) const {
    int count = 0;
    ex_get_variable_param(id_, type, &count);
    std::vector<std::string> names;
    for (int v = 1; v <= count; ++v) {
      char name[256] = "";
      ex_get_variable_name(id_, type, v, name);
      names.emplace_back(name);
    }
    return names;
  }
  std::vector<double> times() const {
    std::vector<double> values(static_cast<std::size_t>(ex_inquire_int(id_, EX_INQ_TIME)));
    ex_get_all_times(id_, values.data());
    return values;
  }
  /// Of the nodes (block 0) or of the elements of a block, whose numbers begin at 1.
  std::vector<double> values(int step, const std::string& variable, int block = 0) const {
    const ex_entity_type type = block == 0 ? EX_NODAL : EX_ELEM_BLOCK;
    const auto names = variables(type);
    const auto place = std::find(names.begin(), names.end(), variable);
    EXPECT_NE(place, names.end()) << variable;
    const auto& of = blocks[static_cast<std::size_t>(std::max(block - 1, 0))];
    std::vector<double> found(block == 0 ? static_cast<std::size_t>(nodes) : of.connectivity.size() / static_cast<std::size_t>(of.nodes));
    EXPECT_EQ(ex_get_var(id_, step, type, static_cast<int>(place - names.begin()) + 1, std::max(block, 1), static_cast<int64_t>(found.size()),
                         found.data()),
              0);
    return found;
  }

  int dimension = 0, nodes = 0, elements = 0;
  std::vector<double> x, y, z;
  std::vector<ReadBlock> blocks;
  std::vector<int> element_ids;

 private:
  int id_ = -1;
};

const std::string long_name(100, 'n');

/// 4 x 3 quadrilaterals, on them 12 triangles.
RCP<Mesh> plane_mesh() {
  const auto below = std::make_shared<BlockMesh>(), above = std::make_shared<BlockMesh>();
  below->width = 4.0, below->height = 3.0, below->cells_x = 4, below->cells_y = 3;
  above->width = 3.0, above->height = 2.0, above->cells_x = 3, above->cells_y = 2, above->translation = {0.0, 3.0};
  return build_mesh(world(), {{"lower & <first>", {}, below, CellShape::quadrilateral4}, {long_name, {}, above, CellShape::triangle3}}, {});
}

void write_plane(const std::string& directory) {
  const auto mesh = plane_mesh();
  FieldWriter writer(mesh, directory);
  const auto displacement = [&](double t) {
    return at_nodes(*mesh, "displacement", FieldKind::vector, 2, [t](const auto& x) { return std::array<double, 2>{t * x[0], x[1] - t}; });
  };
  Field stress{"cauchy_stress", Field::Center::cell, FieldKind::symmetric_tensor, 4, {}};
  for (int e = 0; e < 24; ++e)
    for (int c = 0; c < 4; ++c) stress.values.push_back(100.0 * c + e);  // xx, yy, zz, xy
  writer.write(2, 0.25, {displacement(0.25), stress});
  writer.write(12, 1.0, {displacement(1.0), stress, at_elements(*mesh, "von_mises", 0.5)});
}

TEST(ExodusFile, HoldsMeshAndFieldsOfAPlaneRun) {
  const test::ScratchDirectory scratch(world());
  write_plane(scratch.path());
  const ExodusContent content = write_exodus(scratch.path(), [&] { return scratch.file("run.exo"); });
  EXPECT_EQ(content.steps, 2);
  EXPECT_EQ(content.blocks, 2);
  EXPECT_FALSE(std::filesystem::exists(scratch.file("run.exo.part")));

  const Reader file(scratch.file("run.exo"));
  EXPECT_EQ(file.dimension, 2);
  EXPECT_EQ(file.nodes, 5 * 4 + 4 * 3);
  EXPECT_EQ(file.elements, 24);
  ASSERT_EQ(file.blocks.size(), 2u);
  EXPECT_EQ(file.blocks[0].type, "QUAD4");
  EXPECT_EQ(file.blocks[0].name, "lower & <first>");
  EXPECT_EQ(file.blocks[1].type, "TRI3");
  EXPECT_EQ(file.blocks[1].name, long_name);
  double area[2] = {0.0, 0.0};
  for (std::size_t b = 0; b < 2; ++b)
    for (std::size_t at = 0; at < file.blocks[b].connectivity.size(); at += static_cast<std::size_t>(file.blocks[b].nodes))
      for (int a = 0; a < file.blocks[b].nodes; ++a) {
        const auto node = [&](int k) { return static_cast<std::size_t>(file.blocks[b].connectivity[at + static_cast<std::size_t>(k)] - 1); };
        const std::size_t p = node(a), q = node((a + 1) % file.blocks[b].nodes);
        area[b] += 0.5 * (file.x[p] * file.y[q] - file.x[q] * file.y[p]);
      }
  EXPECT_NEAR(area[0], 12.0, 1e-12);
  EXPECT_NEAR(area[1], 6.0, 1e-12);
  for (int e = 0; e < 24; ++e) EXPECT_EQ(file.element_ids[static_cast<std::size_t>(e)], e + 1);

  EXPECT_THAT(file.times(), ElementsAre(0.25, 1.0));
  EXPECT_THAT(file.variables(EX_NODAL), ElementsAre("displacement_x", "displacement_y"));
  EXPECT_THAT(file.variables(EX_ELEM_BLOCK),
              ElementsAre("cauchy_stress_xx", "cauchy_stress_yy", "cauchy_stress_zz", "cauchy_stress_xy", "von_mises"));
  for (int step = 1; step <= 2; ++step) {
    const double t = file.times()[static_cast<std::size_t>(step - 1)];
    const auto ux = file.values(step, "displacement_x"), uy = file.values(step, "displacement_y");
    for (std::size_t node = 0; node < ux.size(); ++node) {
      EXPECT_EQ(ux[node], t * file.x[node]);
      EXPECT_EQ(uy[node], file.y[node] - t);
    }
    const char* const names[] = {"cauchy_stress_xx", "cauchy_stress_yy", "cauchy_stress_zz", "cauchy_stress_xy"};
    for (int c = 0; c < 4; ++c)
      for (int block = 1; block <= 2; ++block) {
        const auto stress = file.values(step, names[c], block);
        ASSERT_EQ(stress.size(), 12u);
        for (std::size_t e = 0; e < stress.size(); ++e) EXPECT_EQ(stress[e], 100.0 * c + 12.0 * (block - 1) + static_cast<double>(e));
      }
  }
  for (const double value : file.values(1, "von_mises", 1)) EXPECT_TRUE(std::isnan(value)) << "the first step has no such field";
  EXPECT_EQ(file.values(2, "von_mises", 2).front(), 12.5);
}

TEST(ExodusFile, HasMidSideNodesInItsOwnOrderAndShells) {
  const auto brick = std::make_shared<BrickMesh>(), other = std::make_shared<BrickMesh>(), tool = std::make_shared<BrickMesh>();
  for (const auto& one : {brick, other, tool}) one->cells_x = one->cells_y = one->cells_z = 1;
  const auto mesh = build_mesh(
      world(), {{"h20", {}, brick, CellShape::hexahedron20}, {"tet10", {}, other, CellShape::tetrahedron10}, {"tool", {}, tool, rigid_shape(3)}}, {});
  const test::ScratchDirectory scratch(world());
  FieldWriter(mesh, scratch.path()).write(0, 0.0, {at_nodes(*mesh, "displacement", FieldKind::vector, 3, [](const auto& x) { return x; })});
  write_exodus(scratch.path(), [&] { return scratch.file("run.exo"); });
  const Reader file(scratch.file("run.exo"));
  EXPECT_EQ(file.dimension, 3);
  ASSERT_EQ(file.blocks.size(), 3u);
  EXPECT_EQ(file.blocks[0].type, "HEX20");
  EXPECT_EQ(file.blocks[1].type, "TETRA10");
  EXPECT_EQ(file.blocks[2].type, "SHELL4");
  EXPECT_EQ(file.values(1, "displacement_z"), file.z);

  // The edges in whose middle Exodus' manual has the nodes 9 to 20 and 5 to 10, from 0.
  const std::vector<std::array<int, 2>> hex{{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 4}, {1, 5}, {2, 6}, {3, 7}, {4, 5}, {5, 6}, {6, 7}, {7, 4}};
  const std::vector<std::array<int, 2>> tetra{{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}};
  const auto expect_middles = [&](const ReadBlock& block, const std::vector<std::array<int, 2>>& edges) {
    const std::size_t width = static_cast<std::size_t>(block.nodes), corners = width - edges.size();
    for (std::size_t at = 0; at < block.connectivity.size(); at += width)
      for (std::size_t e = 0; e < edges.size(); ++e)
        for (const auto* axis : {&file.x, &file.y, &file.z}) {
          const auto of = [&](std::size_t node) { return (*axis)[static_cast<std::size_t>(block.connectivity[at + node] - 1)]; };
          EXPECT_NEAR(of(corners + e), 0.5 * (of(static_cast<std::size_t>(edges[e][0])) + of(static_cast<std::size_t>(edges[e][1]))), 1e-14);
        }
  };
  expect_middles(file.blocks[0], hex);
  expect_middles(file.blocks[1], tetra);
}

TEST(ExodusFile, CopiesRowsOfSeveralChunks) {
  const auto block = std::make_shared<BlockMesh>(), beside = std::make_shared<BlockMesh>();
  block->cells_x = 300, block->cells_y = 240, beside->cells_x = beside->cells_y = 2, beside->translation = {2.0, 0.0};
  const auto mesh = build_mesh(world(), {{"fine", {}, block, CellShape::quadrilateral4}, {"coarse", {}, beside, CellShape::quadrilateral4}}, {});
  const test::ScratchDirectory scratch(world());
  FieldWriter(mesh, scratch.path()).write(1, 1.0, {at_elements(*mesh, "number", 0.25), at_nodes(*mesh, "x", FieldKind::scalar, 1, [](const auto& x) {
                                                     return std::array<double, 1>{x[0]};
                                                   })});
  write_exodus(scratch.path(), [&] { return scratch.file("run.exo"); });
  const Reader file(scratch.file("run.exo"));
  ASSERT_GT(file.elements, 1 << 16);
  EXPECT_EQ(file.values(1, "x"), file.x);
  const auto fine = file.values(1, "number", 1), coarse = file.values(1, "number", 2);
  for (std::size_t e = 0; e < fine.size(); ++e) ASSERT_EQ(fine[e], static_cast<double>(e) + 0.25);
  EXPECT_THAT(coarse, ElementsAre(72000.25, 72001.25, 72002.25, 72003.25));
  // Each quadrilateral of the grid is where its number says.
  for (std::size_t e = 0; e < fine.size(); ++e) {
    double x = 0.0, y = 0.0;
    for (std::size_t a = 0; a < 4; ++a) {
      const auto node = static_cast<std::size_t>(file.blocks[0].connectivity[4 * e + a] - 1);
      x += 0.25 * file.x[node], y += 0.25 * file.y[node];
    }
    ASSERT_NEAR(x, (static_cast<double>(e % 300) + 0.5) / 300.0, 1e-12);
    ASSERT_NEAR(y, (static_cast<double>(e / 300) + 0.5) / 240.0, 1e-12);
  }
}

TEST(ExodusFile, WhatIsMissingOrDamagedMakesNoFile) {
  const test::ScratchDirectory scratch(world());
  const auto attempt = [&] { write_exodus(scratch.path(), [&] { return scratch.file("run.exo"); }); };
  EXPECT_THAT(file_error([&] { write_exodus(scratch.file("nowhere"), [] { return std::string(); }); }), HasSubstr("there is no such directory"));
  EXPECT_THAT(file_error(attempt), HasSubstr("holds no fields"));
  FieldWriter(plane_mesh(), scratch.path());
  EXPECT_THAT(file_error(attempt), HasSubstr("holds no fields of any step"));
  write_plane(scratch.path());
  const std::string step = scratch.file("fields/step-000012.h5"), mesh = scratch.file("fields/mesh.h5");
  for (const std::string& path : {step, mesh}) {
    const std::string whole = test::content(path);
    std::filesystem::resize_file(path, whole.size() / 2);
    EXPECT_THAT(file_error(attempt), HasSubstr(path));
    std::ofstream(path, std::ios::binary) << whole;
  }
  {
    const hid_t file = H5Fopen(mesh.c_str(), H5F_ACC_RDWR, H5P_DEFAULT), topology = H5Dopen2(file, "topology", H5P_DEFAULT);
    std::vector<long long> numbers(12 * 5 + 12 * 4);
    H5Dread(topology, H5T_NATIVE_LLONG, H5S_ALL, H5S_ALL, H5P_DEFAULT, numbers.data());
    numbers[1] = 1000;
    H5Dwrite(topology, H5T_NATIVE_LLONG, H5S_ALL, H5S_ALL, H5P_DEFAULT, numbers.data());
    H5Dclose(topology), H5Fclose(file);
  }
  EXPECT_THAT(file_error(attempt), HasSubstr("element 0 has the node 1000, but there are 32"));
  EXPECT_FALSE(std::filesystem::exists(scratch.file("run.exo")));
}

TEST(ExodusFile, ADiskThatIsFullLeavesNoFile) {
  const test::ScratchDirectory scratch(world());
  write_plane(scratch.path());
  {
    const test::FileSizeLimit limit(4096);
    EXPECT_THAT(file_error([&] { write_exodus(scratch.path(), [&] { return scratch.file("run.exo"); }); }), HasSubstr("cannot write"));
  }
  for (const auto& entry : std::filesystem::directory_iterator(scratch.path()))
    EXPECT_EQ(entry.path().filename().string().find("run.exo"), std::string::npos);
  write_exodus(scratch.path(), [&] { return scratch.file("run.exo"); });
  EXPECT_EQ(Reader(scratch.file("run.exo")).elements, 24);
}

}  // namespace
}  // namespace mortise
