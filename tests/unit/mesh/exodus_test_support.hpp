#pragma once
// Exodus files in the making, by Exodus' own library.

#include <exodusII.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "mesh_file_test_support.hpp"

namespace mortise {

/// One element of a type on its reference cell, in the order of Exodus' manual, with a side set of all of its sides.
struct OneElement {
  const char* type;
  CellShape shape;
  std::vector<int> order;  ///< for each node of the file the node of the shape
  int sides;
};

inline void PrintTo(const OneElement& one, std::ostream* stream) { *stream << one.type; }

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

inline MeshFile read_exodus_file(const Exodus& exodus) { return read_mesh_file(exodus.write("a.exo"), MeshFormat::exodus, {}); }

inline std::string exodus_refusal(const std::string& path) {
  try {
    read_mesh_file(path, MeshFormat::exodus, {});
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

inline Exodus file_of(const OneElement& one) {
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

inline std::vector<int> as_it_is(int nodes) {
  std::vector<int> order(static_cast<std::size_t>(nodes));
  for (int n = 0; n < nodes; ++n) order[static_cast<std::size_t>(n)] = n;
  return order;
}

/// Nodes of each side of side set 50, from 1, as Exodus' library lists them: one after the other.
inline std::vector<int> nodes_of_sides(std::size_t sides, std::vector<int>& counts) {
  int real = sizeof(double), in_file = 0;
  float version = 0.0F;
  const int id = ex_open(mesh_file_folder().path("a.exo").c_str(), EX_READ, &real, &in_file, &version);
  counts.assign(sides, 0);
  std::vector<int> nodes(sides * 9);
  EXPECT_EQ(ex_get_side_set_node_list(id, 50, counts.data(), nodes.data()), 0);
  ex_close(id);
  return nodes;
}

inline Exodus cube() {
  Exodus exodus = file_of({"HEX", CellShape::hexahedron8, as_it_is(8), 6});
  exodus.node_set = {3, 1};
  return exodus;
}

}  // namespace mortise
