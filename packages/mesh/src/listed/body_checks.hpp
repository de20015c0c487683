#pragma once
// Conditions that a body of a mesh file has to fulfil before anything is computed with it.

#include <optional>
#include <string>

#include "listed/chosen_cells.hpp"
#include "listed/side_table.hpp"

namespace mortise {

/// In 2D all nodes have one z. @throws InputError
void require_flat(const MeshFile& file, const FileBodyRequest& request, const ChosenCells& chosen);

/// No side belongs to more than two elements, and no triangle of the surface lies on half of a quadrilateral of it: those would be cracks.
/// @throws InputError
void require_conforming(const MeshFile& file, const FileBodyRequest& request, const ChosenCells& chosen, const SideTable& sides);

/// Every element can be reached from every other one through common nodes. @throws InputError
void require_one_piece(const MeshFile& file, const FileBodyRequest& request, const ChosenCells& chosen);

/// Facets of a rigid surface that share an edge, in 2D a node, run through it in opposite directions: all have their outside on one side.
/// @throws InputError
void require_one_orientation(const MeshFile& file, const FileBodyRequest& request, const ChosenCells& chosen);

/// Nodes of the surface that lie on sides which do not have them, in words: hanging nodes, nodes that were not merged, cracks. None: there are none.
std::optional<std::string> loose_nodes(const MeshFile& file, const ChosenCells& chosen, const SideTable& sides);

}  // namespace mortise
