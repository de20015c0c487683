// Fields written by several ranks, read back by rank 0 through the references that the XDMF file makes.

#include "mortise/io/field_writer.hpp"

#include <gmock/gmock.h>
#include <hdf5.h>
#include <libxml/parser.h>
#include <libxml/xpath.h>

#include <Eigen/Geometry>
#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_Core.hpp>
#include <Tpetra_Map.hpp>
#include <functional>
#include <map>
#include <optional>
#include <set>

#include "file_error.hpp"
#include "file_size_limit.hpp"
#include "mortise/core/error.hpp"
#include "mortise/mesh/build_mesh.hpp"
#include "mortise/mesh/volume_generators.hpp"
#include "scratch_directory.hpp"

namespace mortise {
namespace {

using test::file_error;

RCP<const Communicator> world() { return Tpetra::getDefaultComm(); }

/// A block of 4 x 3 quadrilaterals and, on top of it, one of 3 x 2 squares cut into triangles. Ids do not depend on the number of ranks.
RCP<Mesh> two_blocks() {
  const auto below = std::make_shared<BlockMesh>(), above = std::make_shared<BlockMesh>();
  below->width = 4.0, below->height = 3.0, below->cells_x = 4, below->cells_y = 3;
  above->width = 3.0, above->height = 2.0, above->cells_x = 3, above->cells_y = 2, above->translation = {0.0, 3.0};
  return build_mesh(world(), {{"lower & <first>", {}, below, CellShape::quadrilateral4}, {"upper", {}, above, CellShape::triangle3}}, {});
}

template <class Value>
std::vector<double> on_nodes(const Mesh& mesh, const Value& value) {
  std::vector<double> values;
  for (LocalOrdinal node = 0; node < mesh.owned_count(); ++node)
    for (const double v : value(mesh.coordinates[node][0], mesh.coordinates[node][1])) values.push_back(v);
  return values;
}

/// value(block, global id of the element).
template <class Value>
std::vector<double> on_elements(const Mesh& mesh, const Value& value) {
  std::vector<double> values;
  for (std::size_t block = 0; block < mesh.blocks.size(); ++block)
    for (LocalOrdinal element = 0; element < mesh.blocks[block].owned; ++element)
      for (const double v : value(block, mesh.blocks[block].element_ids[element])) values.push_back(v);
  return values;
}

struct Dataset {
  std::vector<hsize_t> size;
  std::vector<double> values;
};

Dataset read_dataset(const std::string& file_path, const std::string& path) {
  const hid_t file = H5Fopen(file_path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  EXPECT_GE(file, 0) << file_path;
  const hid_t dataset = H5Dopen2(file, path.c_str(), H5P_DEFAULT);
  EXPECT_GE(dataset, 0) << path;
  Dataset result;
  if (dataset < 0) return result;
  const hid_t space = H5Dget_space(dataset);
  result.size.resize(H5Sget_simple_extent_ndims(space));
  H5Sget_simple_extent_dims(space, result.size.data(), nullptr);
  result.values.resize(H5Sget_simple_extent_npoints(space));
  EXPECT_GE(H5Dread(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, result.values.data()), 0);
  H5Sclose(space), H5Dclose(dataset), H5Fclose(file);
  return result;
}

/// The XDMF file as rank 0 sees it.
class Xdmf {
 public:
  explicit Xdmf(std::string directory) : directory_(std::move(directory)), document_(xmlReadFile((directory_ + "/fields.xdmf").c_str(), nullptr, 0)) {
    EXPECT_NE(document_, nullptr);
    context_ = xmlXPathNewContext(document_);
  }
  ~Xdmf() { xmlXPathFreeContext(context_), xmlFreeDoc(document_); }
  Xdmf(const Xdmf&) = delete;
  Xdmf& operator=(const Xdmf&) = delete;

  std::vector<std::string> texts(const std::string& expression) const {
    auto* object = xmlXPathEvalExpression(reinterpret_cast<const xmlChar*>(expression.c_str()), context_);
    std::vector<std::string> result;
    for (int i = 0; object->nodesetval != nullptr && i < object->nodesetval->nodeNr; ++i) {
      auto* content = xmlNodeGetContent(object->nodesetval->nodeTab[i]);
      result.emplace_back(reinterpret_cast<const char*>(content));
      xmlFree(content);
    }
    xmlXPathFreeObject(object);
    return result;
  }
  std::string text(const std::string& expression) const {
    const auto found = texts(expression);
    EXPECT_EQ(found.size(), 1u) << expression;
    return found.empty() ? "" : found.front();
  }
  /// Dataset of the DataItem below `parent`; its dimensions have to be those that the XDMF file says.
  Dataset data(const std::string& parent) const {
    const std::string reference = text(parent + "/DataItem"), dimensions = text(parent + "/DataItem/@Dimensions");
    const auto colon = reference.find(':');
    const auto dataset = read_dataset(directory_ + "/" + reference.substr(0, colon), reference.substr(colon + 1));
    std::string found;
    for (const auto n : dataset.size) found += (found.empty() ? "" : " ") + std::to_string(n);
    EXPECT_EQ(found, dimensions) << reference;
    return dataset;
  }

 private:
  std::string directory_;
  xmlDocPtr document_;
  xmlXPathContextPtr context_ = nullptr;
};

std::vector<Field> fields_at(const Mesh& mesh, double time) {
  std::vector<Field> fields;
  fields.push_back({"displacement", Field::Center::node, FieldKind::vector, 2, on_nodes(mesh, [&](double x, double y) {
                      return std::array<double, 2>{time * x, 0.1 * x * y};
                    })});
  fields.push_back({"contact_state", Field::Center::node, FieldKind::integer, 1,
                    on_nodes(mesh, [](double x, double) { return std::array<double, 1>{x > 1.5 ? 2.0 : 0.0}; })});
  fields.push_back({"cauchy_stress", Field::Center::cell, FieldKind::symmetric_tensor, 4, on_elements(mesh, [&](std::size_t, GlobalOrdinal id) {
                      return std::array<double, 4>{time + id, 100.0 + id, 200.0 + id, 300.0 + id};  // xx, yy, zz, xy
                    })});
  fields.push_back({"von_mises", Field::Center::cell, FieldKind::scalar, 1,
                    on_elements(mesh, [&](std::size_t block, GlobalOrdinal id) { return std::array<double, 1>{1000.0 * block + id}; })});
  return fields;
}

TEST(FieldWriter, ReadsBackThroughItsReferences) {
  const auto mesh = two_blocks();
  const test::ScratchDirectory scratch(world());
  FieldWriter writer(mesh, scratch.path());
  const std::vector<double> times{0.0, 0.1, 1.0 / 3.0};
  for (std::size_t step = 0; step < times.size(); ++step) writer.write(static_cast<int>(step), times[step], fields_at(*mesh, times[step]));
  world()->barrier();
  if (world()->getRank() != 0) return;

  constexpr std::size_t nodes = 5 * 4 + 4 * 3, quadrilaterals = 12, triangles = 12, elements = quadrilaterals + triangles;
  const Xdmf xdmf(scratch.path());
  const std::string series = "/Xdmf/Domain/Grid[@CollectionType='Temporal']/Grid";
  EXPECT_EQ(xdmf.text("/Xdmf/@Version"), "3.0");
  EXPECT_EQ(xdmf.text("/Xdmf/Domain/Information[1]/@Value"), "lower & <first>");
  const auto written_times = xdmf.texts(series + "/Time/@Value");
  ASSERT_EQ(written_times.size(), times.size());
  for (std::size_t step = 0; step < times.size(); ++step) EXPECT_EQ(std::stod(written_times[step]), times[step]);

  for (std::size_t step = 0; step < times.size(); ++step) {
    const std::string grid = series + "[" + std::to_string(step + 1) + "]";
    const auto coordinates = xdmf.data(grid + "/Geometry");
    ASSERT_EQ(coordinates.values.size(), 3 * nodes);
    const auto topology = xdmf.data(grid + "/Topology").values;
    ASSERT_EQ(topology.size(), 5 * quadrilaterals + 4 * triangles);
    ASSERT_EQ(xdmf.text(grid + "/Topology/@NumberOfElements"), std::to_string(elements));
    const auto body = xdmf.data(grid + "/Attribute[@Name='body']").values;

    // The cells fill their bodies, counterclockwise, and lie where their body lies.
    double area[2] = {0.0, 0.0};
    std::size_t at = 0;
    for (std::size_t element = 0; element < elements; ++element) {
      ASSERT_TRUE(topology[at] == 4.0 || topology[at] == 5.0);
      const int count = topology[at] == 4.0 ? 3 : 4;
      EXPECT_EQ(body[element], element < quadrilaterals ? 0.0 : 1.0);
      double cell = 0.0, middle = 0.0;
      for (int a = 0; a < count; ++a) {
        const auto p = 3 * static_cast<std::size_t>(topology[at + 1 + a]), q = 3 * static_cast<std::size_t>(topology[at + 1 + (a + 1) % count]);
        cell += 0.5 * (coordinates.values.at(p) * coordinates.values.at(q + 1) - coordinates.values.at(q) * coordinates.values.at(p + 1));
        middle += coordinates.values.at(p + 1) / count;
      }
      EXPECT_GT(cell, 0.0);
      EXPECT_EQ(middle > 3.0, body[element] == 1.0);
      area[static_cast<int>(body[element])] += cell;
      at += 1 + count;
    }
    EXPECT_EQ(at, topology.size());
    EXPECT_NEAR(area[0], 12.0, 1e-12);
    EXPECT_NEAR(area[1], 6.0, 1e-12);

    const auto displacement = xdmf.data(grid + "/Attribute[@Name='displacement' and @AttributeType='Vector' and @Center='Node']").values;
    const auto state = xdmf.data(grid + "/Attribute[@Name='contact_state' and @AttributeType='Scalar' and @Center='Node']").values;
    ASSERT_EQ(displacement.size(), 3 * nodes);
    ASSERT_EQ(state.size(), nodes);
    for (std::size_t node = 0; node < nodes; ++node) {
      const double x = coordinates.values[3 * node], y = coordinates.values[3 * node + 1];
      EXPECT_EQ(displacement[3 * node], times[step] * x);
      EXPECT_EQ(displacement[3 * node + 1], 0.1 * x * y);
      EXPECT_EQ(displacement[3 * node + 2], 0.0);
      EXPECT_EQ(state[node], x > 1.5 ? 2.0 : 0.0);
    }
    const auto stress = xdmf.data(grid + "/Attribute[@Name='cauchy_stress' and @AttributeType='Tensor6' and @Center='Cell']").values;
    const auto von_mises = xdmf.data(grid + "/Attribute[@Name='von_mises' and @Center='Cell']").values;
    ASSERT_EQ(stress.size(), 6 * elements);
    for (std::size_t element = 0; element < elements; ++element) {
      const double id = static_cast<double>(element);
      const std::vector<double> expected{times[step] + id, 300.0 + id, 0.0, 100.0 + id, 0.0, 200.0 + id};  // xx, xy, xz, yy, yz, zz
      EXPECT_EQ(std::vector<double>(stress.begin() + 6 * element, stress.begin() + 6 * element + 6), expected);
      EXPECT_EQ(von_mises[element], 1000.0 * body[element] + id);
    }
  }
}

TEST(FieldWriter, WritesBodiesOfSpaceWithThreeAndSixComponents) {
  // 2 x 2 x 1 cubes and, on top of them, one cube cut into 6 tetrahedra.
  const auto below = std::make_shared<BrickMesh>(), above = std::make_shared<BrickMesh>();
  below->width = below->depth = 2.0, below->cells_x = below->cells_y = 2, below->cells_z = 1;
  above->cells_x = above->cells_y = above->cells_z = 1, above->translation = {0.0, 0.0, 1.0};
  const auto mesh = build_mesh(world(), {{"lower", {}, below, CellShape::hexahedron8}, {"upper", {}, above, CellShape::tetrahedron4}}, {});
  Field displacement{"displacement", Field::Center::node, FieldKind::vector, 3, {}};
  for (LocalOrdinal node = 0; node < mesh->owned_count(); ++node)
    displacement.values.insert(displacement.values.end(), mesh->coordinates[node].begin(), mesh->coordinates[node].end());
  const Field stress{"cauchy_stress", Field::Center::cell, FieldKind::symmetric_tensor, 6, on_elements(*mesh, [&](std::size_t, GlobalOrdinal id) {
                       return std::array<double, 6>{100.0 + id, 200.0 + id, 300.0 + id,
                                                    400.0 + id, 500.0 + id, 600.0 + id};  // xx, yy, zz, xy, yz, xz
                     })};
  const test::ScratchDirectory scratch(world());
  FieldWriter writer(mesh, scratch.path());
  writer.write(0, 0.0, {displacement, stress});
  world()->barrier();
  if (world()->getRank() != 0) return;

  const Xdmf xdmf(scratch.path());
  const std::string grid = "/Xdmf/Domain/Grid/Grid";
  const auto coordinates = xdmf.data(grid + "/Geometry").values, topology = xdmf.data(grid + "/Topology").values;
  const auto body = xdmf.data(grid + "/Attribute[@Name='body']").values;
  ASSERT_EQ(coordinates.size(), 3u * (18 + 8));
  ASSERT_EQ(topology.size(), 4u * 9 + 6 * 5);
  std::size_t at = 0;
  for (std::size_t element = 0; element < 10; ++element) {
    const bool is_cube = element < 4;
    ASSERT_EQ(topology[at], is_cube ? 9.0 : 6.0);  // hexahedron, tetrahedron
    EXPECT_EQ(body[element], is_cube ? 0.0 : 1.0);
    const auto corner = [&](int a) { return Eigen::Vector3d::Map(coordinates.data() + 3 * static_cast<std::size_t>(topology[at + 1 + a])); };
    const Eigen::Vector3d x = corner(0), up = corner(is_cube ? 4 : 3) - x;
    EXPECT_NEAR((corner(1) - x).cross(corner(is_cube ? 3 : 2) - x).dot(up), 1.0, 1e-14);
    at += is_cube ? 9 : 5;
  }
  EXPECT_EQ(xdmf.data(grid + "/Attribute[@Name='displacement' and @AttributeType='Vector']").values, coordinates);
  const auto stresses = xdmf.data(grid + "/Attribute[@Name='cauchy_stress' and @AttributeType='Tensor6']").values;
  for (std::size_t element = 0; element < 10; ++element) {
    const double id = static_cast<double>(element);
    const std::vector<double> expected{100.0 + id, 400.0 + id, 600.0 + id, 200.0 + id, 500.0 + id, 300.0 + id};  // xx, xy, xz, yy, yz, zz
    EXPECT_EQ(std::vector<double>(stresses.begin() + 6 * element, stresses.begin() + 6 * element + 6), expected);
  }
}

TEST(FieldWriter, QuadraticCellsStandWithTheirNumbersAndAllNodes) {
  const auto cells = [](auto mesh) { return mesh->cells_x = mesh->cells_y = 1, mesh; };
  const auto brick = cells(std::make_shared<BrickMesh>());
  brick->cells_z = 1;
  const auto block = cells(std::make_shared<BlockMesh>());
  const std::vector<std::vector<BodyDescription>> scenes{{{"a", {}, brick, CellShape::hexahedron20}, {"b", {}, brick, CellShape::tetrahedron10}},
                                                         {{"a", {}, block, CellShape::quadrilateral8}, {"b", {}, block, CellShape::triangle6}},
                                                         {{"a", {}, brick, CellShape::hexahedron20}, {"b", {}, brick, CellShape::wedge15}}};
  const std::vector<std::vector<double>> numbers{{48.0, 38.0}, {37.0, 36.0}, {48.0, 40.0}};
  const std::vector<GlobalOrdinal> node_counts{20 + 27, 8 + 9, 20 + 22};
  for (std::size_t scene = 0; scene < scenes.size(); ++scene) {
    const auto mesh = build_mesh(world(), scenes[scene], {});
    const test::ScratchDirectory scratch(world());
    FieldWriter writer(mesh, scratch.path());
    writer.write(0, 0.0, {});
    world()->barrier();
    if (world()->getRank() == 0) {
      const Xdmf xdmf(scratch.path());
      const auto topology_values = xdmf.data("/Xdmf/Domain/Grid/Grid/Topology").values;
      const auto body = xdmf.data("/Xdmf/Domain/Grid/Grid/Attribute[@Name='body']").values;
      std::set<double> nodes;
      std::size_t at = 0;
      for (const double b : body) {
        const int count = topology(scenes[scene][static_cast<std::size_t>(b)].shape).nodes;
        ASSERT_LT(at + count, topology_values.size());
        EXPECT_EQ(topology_values[at], numbers[scene][static_cast<std::size_t>(b)]);
        nodes.insert(topology_values.begin() + at + 1, topology_values.begin() + at + 1 + count);
        at += 1 + count;
      }
      EXPECT_EQ(at, topology_values.size());
      EXPECT_EQ(static_cast<GlobalOrdinal>(nodes.size()), node_counts[scene]);
    }
    world()->barrier();
  }
}

// VTK: the first triangle's normal points outward; nodes in the middle of 01, 12, 20, 34, 45, 53, 03, 14, 25.
TEST(FieldWriter, WedgesStandInTheOrderOfVtk) {
  for (const CellShape shape : {CellShape::wedge6, CellShape::wedge15}) {
    auto brick = std::make_shared<BrickMesh>();
    brick->cells_x = brick->cells_y = brick->cells_z = 1;
    const auto mesh = build_mesh(world(), {{"a", {}, brick, shape}}, {});
    const test::ScratchDirectory scratch(world());
    FieldWriter writer(mesh, scratch.path());
    writer.write(0, 0.0, {});
    world()->barrier();
    if (world()->getRank() == 0) {
      const Xdmf xdmf(scratch.path());
      const auto numbers = xdmf.data("/Xdmf/Domain/Grid/Grid/Topology").values, coordinates = xdmf.data("/Xdmf/Domain/Grid/Grid/Geometry").values;
      const std::size_t nodes = topology(shape).nodes;
      ASSERT_EQ(numbers.size(), 2 * (1 + nodes));
      for (std::size_t cell = 0; cell < 2; ++cell) {
        const auto x = [&](std::size_t a) {
          return Eigen::Vector3d(Eigen::Vector3d::Map(coordinates.data() + 3 * static_cast<std::size_t>(numbers[cell * (1 + nodes) + 1 + a])));
        };
        EXPECT_EQ(numbers[cell * (1 + nodes)], shape == CellShape::wedge6 ? 8.0 : 40.0);
        EXPECT_NEAR((x(1) - x(0)).cross(x(2) - x(0)).dot(x(3) - x(0)), -1.0, 1e-14);
        for (std::size_t a = 0; a < 3; ++a) EXPECT_EQ((x(a + 3) - x(a)).norm(), 1.0) << "upright";
        constexpr std::array<std::array<std::size_t, 2>, 9> edges{{{0, 1}, {1, 2}, {2, 0}, {3, 4}, {4, 5}, {5, 3}, {0, 3}, {1, 4}, {2, 5}}};
        for (std::size_t k = 0; 6 + k < nodes; ++k) EXPECT_EQ((x(6 + k) - 0.5 * (x(edges[k][0]) + x(edges[k][1]))).norm(), 0.0);
      }
    }
    world()->barrier();
  }
}

/// Names in the directory of fields, in order.
std::vector<std::string> field_files(const std::string& directory) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(directory + "/fields")) names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

/// For one rank to change files while the others wait.
void on_rank_0(const std::function<void()>& action) {
  world()->barrier();
  if (world()->getRank() == 0) action();
  world()->barrier();
}

TEST(FieldWriter, FilesAreCompleteAfterEachStepAndDoNotChange) {
  const auto mesh = two_blocks();
  const test::ScratchDirectory scratch(world());
  FieldWriter writer(mesh, scratch.path());
  std::string first, mesh_before;
  for (const int step : {3, 7, 1000000}) {
    writer.write(step, 0.5 * step, fields_at(*mesh, 0.5 * step));
    on_rank_0([&] {
      const Xdmf xdmf(scratch.path());
      const std::string series = "/Xdmf/Domain/Grid/Grid";
      const auto steps = xdmf.texts(series);
      EXPECT_EQ(steps.size(), step == 3 ? 1u : step == 7 ? 2u : 3u);
      EXPECT_EQ(xdmf.data(series + "[" + std::to_string(steps.size()) + "]/Attribute[@Name='von_mises']").values.size(), 24u);
      if (step == 3) first = test::content(scratch.file("fields/step-000003.h5")), mesh_before = test::content(scratch.file("fields/mesh.h5"));
    });
  }
  if (world()->getRank() != 0) return;
  EXPECT_EQ(field_files(scratch.path()), (std::vector<std::string>{"mesh.h5", "step-000003.h5", "step-000007.h5", "step-1000000.h5"}));
  EXPECT_TRUE(test::content(scratch.file("fields/step-000003.h5")) == first);
  EXPECT_TRUE(test::content(scratch.file("fields/mesh.h5")) == mesh_before);
}

TEST(FieldWriter, WhatDoesNotFitIsRefusedOnAllRanks) {
  const auto mesh = two_blocks();
  const test::ScratchDirectory scratch(world());
  FieldWriter writer(mesh, scratch.path());
  const bool last = world()->getRank() == world()->getSize() - 1;
  Field field{"gap", Field::Center::node, FieldKind::scalar, 1, std::vector<double>(mesh->owned_count() + (last ? 1 : 0))};
  EXPECT_THROW(writer.write(0, 0.0, {field}), std::invalid_argument);
  field.values.resize(mesh->owned_count());
  EXPECT_THROW(writer.write(0, 0.0, {field, field}), std::invalid_argument);
  EXPECT_NO_THROW(writer.write(0, 0.0, {field}));
  EXPECT_THROW(writer.write(0, 0.0, {field}), std::invalid_argument) << "a step's file does not change";
}

TEST(FieldWriter, UnwritableDirectoryIsAFileErrorOnAllRanks) {
  const test::ScratchDirectory scratch(world());
  const auto mesh = two_blocks();
  EXPECT_THAT(file_error([&] { FieldWriter writer(mesh, scratch.file("missing")); }),
              ::testing::AllOf(::testing::HasSubstr(scratch.file("missing") + "/fields"), ::testing::HasSubstr("No such file")));
}

TEST(FieldWriter, IndexThatVanishesBetweenStepsIsAFileErrorOnAllRanks) {
  const test::ScratchDirectory scratch(world());
  const auto mesh = two_blocks();
  FieldWriter writer(mesh, scratch.path());
  on_rank_0([&] { std::filesystem::remove(scratch.file("fields.xdmf")); });
  EXPECT_THAT(file_error([&] { writer.write(0, 0.0, fields_at(*mesh, 0.0)); }), ::testing::HasSubstr("fields.xdmf: No such file"));
}

/// Whatever a kill left of later steps and of the index, the run that goes on leaves what one in one piece does, byte by byte.
TEST(FieldWriter, ContinuedRunLeavesTheSameFiles) {
  const auto mesh = two_blocks();
  const test::ScratchDirectory scratch(world());
  const std::string whole = scratch.file("whole"), parts = scratch.file("parts");
  on_rank_0([&] { std::filesystem::create_directory(whole), std::filesystem::create_directory(parts); });
  const auto write = [&](FieldWriter& writer, int step) { writer.write(step, step / 7.0, fields_at(*mesh, step / 7.0)); };
  {
    FieldWriter writer(mesh, whole);
    for (const int step : {1, 2, 4, 5}) write(writer, step);
  }
  enum class Left { index, torn_index, no_index, no_mesh };
  for (const auto left : {Left::index, Left::torn_index, Left::no_index, Left::no_mesh}) {
    {
      FieldWriter writer(mesh, parts);
      for (const int step : {1, 2, 3, 6}) write(writer, step);
    }
    on_rank_0([&] {
      const std::string index = parts + "/fields.xdmf";
      if (left == Left::torn_index) std::filesystem::resize_file(index, std::filesystem::file_size(index) - 100);
      if (left == Left::no_index) std::filesystem::remove(index);
      if (left == Left::no_mesh) std::filesystem::remove(parts + "/fields/mesh.h5");
      std::ofstream(parts + "/fields/step-000007.h5.part") << "half";
      std::ofstream(parts + "/fields/notes.txt") << "not of a run";
    });
    FieldWriter writer(mesh, parts, 2);
    on_rank_0([&] {
      EXPECT_EQ(field_files(parts), (std::vector<std::string>{"mesh.h5", "notes.txt", "step-000001.h5", "step-000002.h5"}));
      EXPECT_EQ(Xdmf(parts).texts("/Xdmf/Domain/Grid/Grid").size(), 2u);
    });
    EXPECT_EQ(writer.steps(), (std::vector<int>{1, 2}));
    EXPECT_THROW(write(writer, 2), std::invalid_argument);
    for (const int step : {4, 5}) write(writer, step);
    EXPECT_EQ(writer.steps(), (std::vector<int>{1, 2, 4, 5}));
    on_rank_0([&] {
      EXPECT_EQ(test::content(parts + "/fields.xdmf"), test::content(whole + "/fields.xdmf"));
      for (const std::string& name : field_files(whole))
        EXPECT_TRUE(test::content(parts + "/fields/" + name) == test::content(whole + "/fields/" + name)) << name;
    });
  }
}

TEST(FieldWriter, NewRunRemovesWhatAnEarlierOneLeft) {
  const auto mesh = two_blocks();
  const test::ScratchDirectory scratch(world());
  FieldWriter(mesh, scratch.path()).write(12, 1.0, fields_at(*mesh, 1.0));
  const FieldWriter again(mesh, scratch.path());
  on_rank_0([&] {
    EXPECT_EQ(field_files(scratch.path()), std::vector<std::string>{"mesh.h5"});
    EXPECT_EQ(Xdmf(scratch.path()).texts("/Xdmf/Domain/Grid/Grid").size(), 0u);
  });
}

TEST(FieldWriter, ContinuingWithAnotherMeshOrABrokenStepIsAFileErrorOnAllRanks) {
  const auto mesh = two_blocks();
  const test::ScratchDirectory scratch(world());
  FieldWriter(mesh, scratch.path()).write(1, 1.0, fields_at(*mesh, 1.0));
  const auto block = std::make_shared<BlockMesh>();
  block->cells_x = block->cells_y = 2;
  const auto other = build_mesh(world(), {{"other", {}, block, CellShape::quadrilateral4}}, {});
  EXPECT_THAT(
      file_error([&] { FieldWriter(other, scratch.path(), 1); }),
      ::testing::AllOf(::testing::HasSubstr("fields/mesh.h5: it holds 32 nodes and 24 elements"), ::testing::HasSubstr("the mesh has 9 and 4")));
  on_rank_0([&] { std::filesystem::resize_file(scratch.file("fields/step-000001.h5"), 1000); });
  EXPECT_THAT(file_error([&] { FieldWriter(mesh, scratch.path(), 1); }),
              ::testing::AllOf(::testing::HasSubstr("fields/step-000001.h5 cannot be read"), ::testing::HasSubstr("please remove it")));
  EXPECT_NO_THROW(FieldWriter(mesh, scratch.path(), 0));
}

/// A rank that cannot write its rows: all ranks hear of it, none waits, nothing half stays, and earlier steps can be read.
TEST(FieldWriter, RankThatCannotWriteIsAFileErrorOnAllRanks) {
  const auto mesh = two_blocks();
  for (int rank = 0; rank < world()->getSize(); ++rank) {
    int failures = 0;
    for (const rlim_t bytes : {0, 100, 1000, 2000, 3000, 4000, 5000, 6000, 1000000}) {
      const test::ScratchDirectory scratch(world());
      FieldWriter writer(mesh, scratch.path());
      writer.write(1, 1.0, fields_at(*mesh, 1.0));
      std::string said;
      {
        std::optional<test::FileSizeLimit> limit;
        if (world()->getRank() == rank) limit.emplace(bytes);
        try {
          writer.write(2, 2.0, fields_at(*mesh, 2.0));
        } catch (const FileError& error) {
          said = error.what();
        }
      }
      const int mine = said.empty() ? 0 : 1;
      int all = 0;
      Teuchos::reduceAll(*world(), Teuchos::REDUCE_SUM, mine, Teuchos::outArg(all));
      EXPECT_EQ(all, mine * world()->getSize());
      failures += mine;
      if (mine == 1) EXPECT_THAT(said, ::testing::HasSubstr("File too large"));
      on_rank_0([&] {
        auto expected = std::vector<std::string>{"mesh.h5", "step-000001.h5"};
        if (mine == 0) expected.emplace_back("step-000002.h5");
        EXPECT_EQ(field_files(scratch.path()), expected) << bytes;
        EXPECT_EQ(Xdmf(scratch.path()).data("/Xdmf/Domain/Grid/Grid[1]/Attribute[@Name='von_mises']").values.size(), 24u);
      });
    }
    EXPECT_GT(failures, 2) << "of rank " << rank;
    EXPECT_LT(failures, 9) << "of rank " << rank;
  }
}

}  // namespace
}  // namespace mortise
