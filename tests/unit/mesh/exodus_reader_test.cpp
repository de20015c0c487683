// Exodus II: files that its own library writes, and files that are not as they should be.

#include <exodusII.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <sstream>

#include "exodus_test_support.hpp"

namespace mortise {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

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

// Cubit writes the byte behind a title of 80 characters too.
TEST(ExodusFiles, MayHaveATitleOf81Characters) {
  const std::string path = cube().write("a.exo");
  int id = 0;
  ASSERT_EQ(nc_open(path.c_str(), NC_WRITE, &id), NC_NOERR);
  ASSERT_EQ(nc_redef(id), NC_NOERR);
  const auto set_title = [&](const std::string& title) { ASSERT_EQ(nc_put_att_text(id, NC_GLOBAL, "title", title.size(), title.data()), NC_NOERR); };
  set_title(std::string(81, 'x'));
  nc_close(id);
  EXPECT_EQ(read_mesh_file(path, MeshFormat::exodus, {}).cells.size(), 1u);
  ASSERT_EQ(nc_open(path.c_str(), NC_WRITE, &id), NC_NOERR);
  ASSERT_EQ(nc_redef(id), NC_NOERR);
  set_title(std::string(82, 'x'));
  nc_close(id);
  EXPECT_THAT(exodus_refusal(path), HasSubstr("attribute \"title\" of the file has length 82, above 81"));
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
              HasSubstr("attribute \"title\" of the file has length 2000, above 81"));
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
