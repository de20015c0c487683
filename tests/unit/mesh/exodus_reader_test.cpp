// Exodus II: files that its own library writes, and files that are not as they should be.

#include <exodusII.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <sstream>

#include "mesh_file_test_support.hpp"
#include "mortise/mesh/cell_nodes.hpp"

namespace mortise {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// One element of a type on its reference cell, in the order of Exodus' manual, with a side set of all of its sides.
struct OneElement {
  const char* type;
  CellShape shape;
  std::vector<int> order;  ///< for each node of the file the node of the shape
  int sides;
};

void PrintTo(const OneElement& one, std::ostream* stream) { *stream << one.type; }

/// Positions of the nodes of a reference cell, in 3D.
std::vector<std::array<double, 3>> reference_nodes(CellShape shape) {
  return visit_cell(shape, [](auto kind) {
    std::vector<std::array<double, 3>> all;
    for (const auto& node : decltype(kind)::node_positions) {
      std::array<double, 3> position{};
      for (std::size_t i = 0; i < node.size(); ++i) position[i] = node[i];
      all.push_back(position);
    }
    return all;
  });
}

/// Settings of a file in the making: changes of it, to be refused.
struct Exodus {
  int mode = EX_CLOBBER;
  int dimension = 3;
  std::vector<std::array<double, 3>> nodes;
  std::string type = "HEX8";
  int nodes_per_element = 8;
  std::vector<int> connectivity;
  std::vector<int> side_elements, sides, node_set;
  std::vector<int> node_labels, element_labels;
  const char *block_name = "", *side_set_name = "", *node_set_name = "";

  std::string write(const std::string& name) const {
    const std::string path = mesh_file_folder().path(name);
    int real = sizeof(double), in_file = sizeof(double);
    ex_opts(0);
    const int id = ex_create(path.c_str(), mode, &real, &in_file);
    EXPECT_GE(id, 0);
    const int elements = static_cast<int>(connectivity.size()) / nodes_per_element;
    ex_put_init(id, "a title", dimension, static_cast<int>(nodes.size()), elements, 1, node_set.empty() ? 0 : 1, sides.empty() ? 0 : 1);
    std::vector<double> x, y, z;
    for (const auto& node : nodes) x.push_back(node[0]), y.push_back(node[1]), z.push_back(node[2]);
    ex_put_coord(id, x.data(), y.data(), dimension > 2 ? z.data() : nullptr);
    ex_put_block(id, EX_ELEM_BLOCK, 40, type.c_str(), elements, nodes_per_element, 0, 0, 0);
    ex_put_conn(id, EX_ELEM_BLOCK, 40, connectivity.data(), nullptr, nullptr);
    if (block_name[0] != '\0') ex_put_name(id, EX_ELEM_BLOCK, 40, block_name);
    if (!sides.empty()) {
      ex_put_set_param(id, EX_SIDE_SET, 50, static_cast<int>(sides.size()), 0);
      ex_put_set(id, EX_SIDE_SET, 50, side_elements.data(), sides.data());
      if (side_set_name[0] != '\0') ex_put_name(id, EX_SIDE_SET, 50, side_set_name);
    }
    if (!node_set.empty()) {
      ex_put_set_param(id, EX_NODE_SET, 60, static_cast<int>(node_set.size()), 0);
      ex_put_set(id, EX_NODE_SET, 60, node_set.data(), nullptr);
      if (node_set_name[0] != '\0') ex_put_name(id, EX_NODE_SET, 60, node_set_name);
    }
    if (!node_labels.empty()) ex_put_id_map(id, EX_NODE_MAP, node_labels.data());
    if (!element_labels.empty()) ex_put_id_map(id, EX_ELEM_MAP, element_labels.data());
    ex_close(id);
    return path;
  }
};

MeshFile read_exodus_file(const Exodus& exodus) { return read_mesh_file(exodus.write("a.exo"), MeshFormat::exodus, {}); }

std::string exodus_refusal(const std::string& path) {
  try {
    read_mesh_file(path, MeshFormat::exodus, {});
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

Exodus file_of(const OneElement& one) {
  const auto positions = reference_nodes(one.shape);
  Exodus exodus;
  exodus.dimension = topology(one.shape).dimension;
  exodus.type = one.type;
  exodus.nodes_per_element = static_cast<int>(one.order.size());
  for (std::size_t n = 0; n < one.order.size(); ++n) {
    exodus.nodes.push_back(positions[static_cast<std::size_t>(one.order[n])]);
    exodus.connectivity.push_back(static_cast<int>(n) + 1);
  }
  for (int side = 1; side <= one.sides; ++side) {
    exodus.side_elements.push_back(1);
    exodus.sides.push_back(side);
  }
  return exodus;
}

std::vector<int> as_it_is(int nodes) {
  std::vector<int> order(static_cast<std::size_t>(nodes));
  for (int n = 0; n < nodes; ++n) order[static_cast<std::size_t>(n)] = n;
  return order;
}

class ExodusShapes : public ::testing::TestWithParam<OneElement> {};

TEST_P(ExodusShapes, HaveTheirNodesAndSidesInOurOrder) {
  const OneElement& one = GetParam();
  for (const int mode : {EX_CLOBBER, EX_CLOBBER | EX_NETCDF4, EX_CLOBBER | EX_NETCDF4 | EX_ALL_INT64_DB}) {
    SCOPED_TRACE(mode);
    Exodus exodus = file_of(one);
    exodus.mode = mode;
    const MeshFile file = read_exodus_file(exodus);
    ASSERT_EQ(file.cells.size(), 1u);
    EXPECT_EQ(file.cells[0].shape, one.shape);
    const auto positions = reference_nodes(one.shape);
    for (std::size_t n = 0; n < positions.size(); ++n)
      EXPECT_EQ(file.coordinates[static_cast<std::size_t>(file.cells[0].nodes[n])], positions[n]) << "node " << n;
    expect_middles(file);
    EXPECT_THAT(names_of_sets(file.cell_sets), ElementsAre("block 40"));
    EXPECT_THAT(names_of_sets(file.side_sets), ElementsAre("side set 50"));
    const auto& sides = file.side_sets[0].members;
    ASSERT_EQ(sides.size(), static_cast<std::size_t>(one.sides));
    // The library itself says which nodes a side of a file has.
    int real = sizeof(double), in_file = 0;
    float version = 0.0F;
    const int id = ex_open(mesh_file_folder().path("a.exo").c_str(), EX_READ, &real, &in_file, &version);
    std::vector<int> counts(sides.size()), nodes(sides.size() * 9);
    ASSERT_EQ(ex_get_side_set_node_list(id, 50, counts.data(), nodes.data()), 0);
    ex_close(id);
    std::size_t at = 0;
    for (std::size_t s = 0; s < sides.size(); ++s) {
      std::vector<std::array<double, 3>> theirs;
      const auto ours = corners_of(file, sides[s]);
      for (std::size_t n = 0; n < ours.size(); ++n) theirs.push_back(exodus.nodes[static_cast<std::size_t>(nodes[at + n] - 1)]);
      EXPECT_THAT(ours, ::testing::UnorderedElementsAreArray(theirs)) << "side " << s + 1;
      // Not counts[s]: the library says 7 for triangles of 6 nodes, and lists 6.
      at += topology(one.shape).sides[static_cast<std::size_t>(sides[s].side)].nodes.size();
    }
  }
}

// Exodus' manual has the nodes of upright edges of hexahedra before those of the top's.
INSTANTIATE_TEST_SUITE_P(
    All, ExodusShapes,
    ::testing::Values(OneElement{"HEX8", CellShape::hexahedron8, as_it_is(8), 6}, OneElement{"hex", CellShape::hexahedron8, as_it_is(8), 6},
                      OneElement{"HEX20", CellShape::hexahedron20, {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 16, 17, 18, 19, 12, 13, 14, 15}, 6},
                      OneElement{"TETRA4", CellShape::tetrahedron4, as_it_is(4), 4}, OneElement{"TET10", CellShape::tetrahedron10, as_it_is(10), 4},
                      OneElement{"WEDGE6", CellShape::wedge6, as_it_is(6), 5},
                      OneElement{"WEDGE", CellShape::wedge15, {0, 1, 2, 3, 4, 5, 6, 7, 8, 12, 13, 14, 9, 10, 11}, 5},
                      OneElement{"PYRAMID5", CellShape::pyramid5, as_it_is(5), 5}, OneElement{"TRI3", CellShape::triangle3, as_it_is(3), 3},
                      OneElement{"TRI6", CellShape::triangle6, as_it_is(6), 3}, OneElement{"QUAD4", CellShape::quadrilateral4, as_it_is(4), 4},
                      OneElement{"QUAD", CellShape::quadrilateral8, as_it_is(8), 4}),
    [](const auto& info) { return std::string(info.param.type) + std::to_string(info.param.order.size()); });

Exodus cube() {
  Exodus exodus = file_of({"HEX", CellShape::hexahedron8, as_it_is(8), 6});
  exodus.node_set = {3, 1};
  return exodus;
}

TEST(ExodusFiles, HaveNamesAndLabels) {
  Exodus exodus = cube();
  exodus.block_name = "steel";
  exodus.side_set_name = "all sides";
  exodus.node_set_name = "two nodes";
  exodus.node_labels = {11, 12, 13, 14, 15, 16, 17, 1000000};
  exodus.element_labels = {77};
  const MeshFile file = read_exodus_file(exodus);
  EXPECT_THAT(names_of_sets(file.cell_sets), ElementsAre("steel"));
  EXPECT_THAT(names_of_sets(file.side_sets), ElementsAre("all sides"));
  EXPECT_THAT(names_of_sets(file.node_sets), ElementsAre("two nodes"));
  EXPECT_THAT(file.node_sets[0].members, ElementsAre(2, 0));
  EXPECT_THAT(file.node_labels, ElementsAre(11, 12, 13, 14, 15, 16, 17, 1000000));
  EXPECT_THAT(file.cells[0].labels, ElementsAre(77));
  EXPECT_NEAR(measure_of(file, file.cell_sets[0]), 8.0, 1e-14);
}

TEST(ExodusFiles, ShellsAreTheirOwnSides) {
  Exodus exodus = file_of({"SHELL4", CellShape::quadrilateral4, as_it_is(4), 2});
  exodus.dimension = 3;
  const MeshFile file = read_exodus_file(exodus);
  ASSERT_EQ(file.side_sets[0].members.size(), 2u);
  EXPECT_EQ(file.side_sets[0].members[0].side, the_cell_itself);
  EXPECT_EQ(file.side_sets[0].members[1].side, the_cell_itself);
  exodus.sides = {3};
  exodus.side_elements = {1};
  EXPECT_THAT(exodus_refusal(exodus.write("a.exo")),
              HasSubstr("side set 50, member 1: element 1 of block 40 has no side 3; sides that are read are 1 to 2"));
}

TEST(ExodusFiles, TellWhatIsWrong) {
  Exodus exodus = cube();
  exodus.connectivity[4] = 9;
  EXPECT_THAT(exodus_refusal(exodus.write("a.exo")), HasSubstr("a.exo: error: element 1 of block 40 has node 9, outside of 1 to 8"));
  exodus = cube();
  exodus.sides[1] = 7;
  EXPECT_THAT(exodus_refusal(exodus.write("a.exo")), HasSubstr("side set 50, member 2: element 1 of block 40 has no side 7"));
  exodus = cube();
  exodus.side_elements[0] = 2;
  EXPECT_THAT(exodus_refusal(exodus.write("a.exo")), HasSubstr("side set 50, member 1: there is no element 2; the file has 1 to 1"));
  exodus = cube();
  exodus.node_set[0] = 0;
  EXPECT_THAT(exodus_refusal(exodus.write("a.exo")), HasSubstr("node set 60, member 1: there is no node 0; the file has 1 to 8"));
  exodus = cube();
  exodus.nodes[3][1] = std::nan("");
  EXPECT_THAT(exodus_refusal(exodus.write("a.exo")), HasSubstr("node 4 (by its place in the file) is at (-1, nan, -1)"));
  exodus = cube();
  exodus.type = "HEX27";
  EXPECT_THAT(exodus_refusal(exodus.write("a.exo")), HasSubstr("element block 40: elements of type \"HEX27\" have 8 nodes"));
  exodus.type = "SUPER";
  EXPECT_THAT(exodus_refusal(exodus.write("a.exo")), HasSubstr("element block 40: elements of type \"SUPER\" are not read; types are BAR, TRI"));
}

std::string bytes_of(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  std::ostringstream whole;
  whole << stream.rdbuf();
  return whole.str();
}

TEST(ExodusFiles, CutOffAreRefused) {
  const std::string bytes = bytes_of(cube().write("a.exo"));
  // A file of netCDF may lack nothing but zeros at its end.
  for (std::size_t size = 0; size + 200 < bytes.size(); size += 97) {
    const std::string cut = mesh_file_folder().write("cut.exo", bytes.substr(0, size));
    EXPECT_NE(exodus_refusal(cut), "no error") << size << " of " << bytes.size();
  }
  EXPECT_THAT(exodus_refusal(mesh_file_folder().write("text.exo", "no mesh at all")), HasSubstr("byte 0: expected \"CDF\" or the signature of HDF5"));
}

/// The file with other bytes behind a text in it, or in front of it.
std::string with_bytes(std::string bytes, const std::string& text, std::ptrdiff_t behind, const std::string& other) {
  const std::size_t at = bytes.find(text);
  EXPECT_NE(at, std::string::npos) << text;
  bytes.replace(static_cast<std::size_t>(static_cast<std::ptrdiff_t>(at) + behind), other.size(), other);
  return mesh_file_folder().write("forged.exo", bytes);
}

// Claims in the header of netCDF's classic format are checked before its library takes memory for them.
TEST(ExodusFiles, TellTheByteOfWhatTheirHeaderClaimsTooMuchOf) {
  const std::string whole = bytes_of(cube().write("a.exo")), much = "\x1f\xff\xff\xff";
  EXPECT_THAT(exodus_refusal(with_bytes(whole, "coordx", 8, much)), HasSubstr("the number of dimensions of a variable is 536870911, and "));
  EXPECT_THAT(exodus_refusal(with_bytes(whole, "num_nodes", -4, much)), HasSubstr("the length of a name is 536870911, and "));
  EXPECT_THAT(exodus_refusal(with_bytes(whole, "title", 12, much)), HasSubstr("the number of values of an attribute is 536870911, and "));
  EXPECT_THAT(exodus_refusal(with_bytes(whole, "num_nodes", 12, much)), HasSubstr("is to stand in bytes "));
  EXPECT_THAT(exodus_refusal(mesh_file_folder().write("forged.exo", whole.substr(0, 8) + std::string("\0\0\0\x0a\x7f\0\0\0", 8) + whole.substr(16))),
              HasSubstr("byte 12: the number of entries of the list of dimensions is 2130706432, and "));
}

/// A file of netCDF alone, with what Exodus' library would take for granted.
std::string file_with(const std::function<void(int)>& add) {
  const std::string path = mesh_file_folder().path("forged.exo");
  int id = 0, dimension = 0;
  EXPECT_EQ(nc_create(path.c_str(), NC_CLOBBER, &id), NC_NOERR);
  for (const auto& [name, size] :
       {std::pair<const char*, std::size_t>{"num_dim", 3}, {"num_nodes", 4}, {"num_elem", 1}, {"num_el_blk", 1}, {"other", 5}})
    nc_def_dim(id, name, size, &dimension);
  const float version = 5.0F;
  const int word = 8;
  nc_put_att_float(id, NC_GLOBAL, "version", NC_FLOAT, 1, &version);
  nc_put_att_float(id, NC_GLOBAL, "api_version", NC_FLOAT, 1, &version);
  nc_put_att_int(id, NC_GLOBAL, "floating_point_word_size", NC_INT, 1, &word);
  nc_put_att_text(id, NC_GLOBAL, "title", 1, "t");
  add(id);
  nc_close(id);
  return path;
}

int dimension_of(int id, const char* name) {
  int dimension = 0;
  EXPECT_EQ(nc_inq_dimid(id, name, &dimension), NC_NOERR);
  return dimension;
}

TEST(ExodusFiles, WithOtherDimensionsOrAttributesAreRefusedBeforeTheLibraryReadsThem) {
  const auto variable = [](const char* name, nc_type type, std::vector<const char*> dimensions) {
    return [=](int id) {
      std::vector<int> ids;
      for (const char* one : dimensions) ids.push_back(dimension_of(id, one));
      int variable = 0;
      nc_def_var(id, name, type, static_cast<int>(ids.size()), ids.data(), &variable);
    };
  };
  EXPECT_THAT(exodus_refusal(file_with(variable("coordx", NC_DOUBLE, {"other"}))),
              HasSubstr("variable \"coordx\" has the dimensions (other); expected are (num_nodes)"));
  EXPECT_THAT(exodus_refusal(file_with(variable("node_num_map", NC_INT, {"other"}))), HasSubstr("expected are (num_nodes)"));
  EXPECT_THAT(exodus_refusal(file_with(variable("eb_prop1", NC_INT, {"num_el_blk", "other"}))), HasSubstr("expected are (num_el_blk)"));
  EXPECT_THAT(exodus_refusal(file_with(variable("connect12", NC_INT, {"other", "other"}))),
              HasSubstr("expected are (num_el_in_blk12, num_nod_per_el12)"));
  EXPECT_THAT(exodus_refusal(file_with(variable("coordx", NC_CHAR, {"num_nodes"}))),
              HasSubstr("variable \"coordx\" is not of numbers (type 2 of netCDF)"));
  EXPECT_THAT(exodus_refusal(file_with([](int id) { nc_put_att_text(id, NC_GLOBAL, "title", 2000, std::string(2000, 't').c_str()); })),
              HasSubstr("attribute \"title\" of the file has length 2000, above 80"));
  EXPECT_THAT(exodus_refusal(file_with([](int id) {
                const std::vector<int> words(100, 8);
                nc_put_att_int(id, NC_GLOBAL, "floating_point_word_size", NC_INT, 100, words.data());
              })),
              HasSubstr("attribute \"floating_point_word_size\" of the file has length 100, above 1"));
  EXPECT_THAT(exodus_refusal(file_with([](int) {})), HasSubstr("neither a variable \"coordx\" nor \"coord\""));
}

// The header of the file tells of 2^31 - 1 nodes, and none was written.
TEST(ExodusFiles, WithAbsurdCountsTakeNoMemory) {
  const std::string path = mesh_file_folder().path("absurd.exo");
  int id = 0, node = 0, other = 0, variable = 0;
  ASSERT_EQ(nc_create(path.c_str(), NC_CLOBBER | NC_NETCDF4, &id), NC_NOERR);
  nc_def_dim(id, "num_dim", 3, &other);
  nc_def_dim(id, "num_nodes", 2147483647, &node);
  nc_def_dim(id, "num_elem", 1, &other);
  nc_def_dim(id, "num_el_blk", 1, &other);
  const float version = 5.0F;
  const int word = 8;
  nc_put_att_float(id, NC_GLOBAL, "version", NC_FLOAT, 1, &version);
  nc_put_att_float(id, NC_GLOBAL, "api_version", NC_FLOAT, 1, &version);
  nc_put_att_int(id, NC_GLOBAL, "floating_point_word_size", NC_INT, 1, &word);
  nc_put_att_text(id, NC_GLOBAL, "title", 1, "t");
  const int separate_coordinates = 1;
  nc_put_att_int(id, NC_GLOBAL, "file_size", NC_INT, 1, &separate_coordinates);
  const std::size_t chunk = 1024;
  for (const char* name : {"coordx", "coordy", "coordz"}) {
    nc_def_var(id, name, NC_DOUBLE, 1, &node, &variable);
    nc_def_var_chunking(id, variable, NC_CHUNKED, &chunk);
  }
  ASSERT_EQ(nc_close(id), NC_NOERR);
  EXPECT_THAT(exodus_refusal(path), HasSubstr("node 1 (by its place in the file)"));
}

// netCDF numbers variables from 0 in the order in which they were made. Any of the coordinates may be the first.
TEST(ExodusFiles, HaveTheirVariablesInAnyOrder) {
  for (const std::string first : {"coordx", "coordy", "coordz", "connect1"}) {
    const std::string path = mesh_file_folder().path("first_" + first + ".exo");
    int id = 0, nodes = 0, elements = 0, width = 0, blocks = 0, other = 0;
    ASSERT_EQ(nc_create(path.c_str(), NC_CLOBBER, &id), NC_NOERR);
    nc_def_dim(id, "num_dim", 3, &other);
    nc_def_dim(id, "num_nodes", 4, &nodes);
    nc_def_dim(id, "num_elem", 1, &other);
    nc_def_dim(id, "num_el_blk", 1, &blocks);
    nc_def_dim(id, "num_el_in_blk1", 1, &elements);
    nc_def_dim(id, "num_nod_per_el1", 4, &width);
    const float version = 5.0F;
    const int word = 8, separate_coordinates = 1;
    nc_put_att_float(id, NC_GLOBAL, "version", NC_FLOAT, 1, &version);
    nc_put_att_float(id, NC_GLOBAL, "api_version", NC_FLOAT, 1, &version);
    nc_put_att_int(id, NC_GLOBAL, "floating_point_word_size", NC_INT, 1, &word);
    nc_put_att_int(id, NC_GLOBAL, "file_size", NC_INT, 1, &separate_coordinates);
    nc_put_att_text(id, NC_GLOBAL, "title", 1, "t");
    std::vector<std::string> names{first};
    for (const char* name : {"coordx", "coordy", "coordz", "connect1", "eb_prop1"})
      if (name != first) names.emplace_back(name);
    std::map<std::string, int> variables;
    for (const std::string& name : names) {
      const std::vector<int> shape = name == "connect1" ? std::vector<int>{elements, width} : std::vector<int>{name == "eb_prop1" ? blocks : nodes};
      nc_def_var(id, name.c_str(), name[0] == 'c' && name != "connect1" ? NC_DOUBLE : NC_INT, static_cast<int>(shape.size()), shape.data(),
                 &variables[name]);
    }
    EXPECT_EQ(variables[first], 0);
    nc_put_att_text(id, variables["connect1"], "elem_type", 5, "TETRA");
    nc_put_att_text(id, variables["eb_prop1"], "name", 2, "ID");
    nc_enddef(id);
    const std::vector<double> x{1.0, 2.0, 1.0, 1.0}, y{3.0, 3.0, 4.0, 3.0}, z{5.0, 5.0, 5.0, 6.0};
    const std::vector<int> connectivity{1, 2, 3, 4}, number{1};
    nc_put_var_double(id, variables["coordx"], x.data());
    nc_put_var_double(id, variables["coordy"], y.data());
    nc_put_var_double(id, variables["coordz"], z.data());
    nc_put_var_int(id, variables["connect1"], connectivity.data());
    nc_put_var_int(id, variables["eb_prop1"], number.data());
    ASSERT_EQ(nc_close(id), NC_NOERR);
    const MeshFile file = read_mesh_file(path, MeshFormat::exodus, {});
    ASSERT_EQ(file.coordinates.size(), 4u) << first;
    EXPECT_EQ(file.coordinates[1], (std::array<double, 3>{2.0, 3.0, 5.0})) << first;
    EXPECT_EQ(file.coordinates[3], (std::array<double, 3>{1.0, 3.0, 6.0})) << first;
  }
}

}  // namespace
}  // namespace mortise
