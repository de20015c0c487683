#pragma once
// The sets of a mesh file as sets of a body.

#include <string>
#include <utility>
#include <vector>

#include "listed/chosen_cells.hpp"
#include "listed/side_table.hpp"

namespace mortise {

/// A side with the name of a set: an index; -1: none.
struct NamedSide {
  ElementSide side;
  std::int32_t name = -1;
};

struct BodySets {
  std::vector<std::string> side_names, node_set_names;
  std::vector<NamedSide> sides;                                    ///< of the whole surface, by element and side; those without a name once
  std::vector<std::pair<std::int32_t, std::int32_t>> set_of_node;  ///< node, node set; ascending
  std::vector<std::string> notes, warnings;
};

/// @param sides  of the elements
BodySets name_sets(const MeshFile& file, const FileBodyRequest& request, const ChosenCells& chosen, const SideTable& sides);

/// Names cells that are facets of a surface: each is a side, and sets of them are sets of sides.
BodySets name_facets(const MeshFile& file, const FileBodyRequest& request, const ChosenCells& chosen);

}  // namespace mortise
