#pragma once
// Cells of a mesh file that make a body.

#include <string>
#include <vector>

#include "listed/body_elements.hpp"
#include "mortise/mesh/file_body.hpp"
#include "mortise/mesh/mesh_file.hpp"

namespace mortise {

/// Cells of a file as elements of a body with nodes of its own.
struct ChosenCells {
  BodyElements elements;                                     ///< with the body's node numbers
  std::vector<std::int32_t> file_nodes;                      ///< [nodes] indices into MeshFile::coordinates, ascending
  std::vector<std::vector<std::int32_t>> elements_of_cells;  ///< [groups of the file][cells] elements; -1: not in the body
  std::vector<std::vector<char>> turned;  ///< [groups of the file][cells] whether the order of the nodes was reversed; empty: of none
  std::int64_t turned_count = 0;
  std::vector<std::string> notes;  ///< in words for users

  std::int32_t nodes() const { return static_cast<std::int32_t>(file_nodes.size()); }
};

/// The cells of `request.blocks` (all, if it names none) with so many dimensions. Plane cells are turned so that their nodes run counterclockwise
/// where `dimension` is 2. Facets that hang together are turned where sets of sides name their other face alone.
/// @throws InputError for names that are none, cells in two parts, nothing that is left
ChosenCells choose_cells(const MeshFile& file, const FileBodyRequest& request, int cell_dimension);

/// Trees of nodes that elements connect: [nodes] the lowest node that hangs together with each.
std::vector<std::int32_t> lowest_connected_nodes(const ChosenCells& chosen);

}  // namespace mortise
