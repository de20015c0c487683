#pragma once
// A mesh in the making from a Gmsh file: nodes, cells and the groups that they are in.

#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "readers/gmsh/gmsh_element_types.hpp"
#include "readers/gmsh/gmsh_numbers.hpp"
#include "readers/label_table.hpp"

namespace mortise {

/// A physical group or an entity: dimension and tag.
using GmshTag = std::pair<int, std::int64_t>;

/// An entity of the geometry, as $Entities has it.
struct GmshEntity {
  std::vector<std::int64_t> physical;  ///< tags of its groups, all of its dimension
  GmshTag parent;                      ///< in a file that is cut into partitions, the entity that this one is a part of
  bool is_turned = false;              ///< the sign of its groups says that its elements are to be turned round
  std::int64_t partition = 0;          ///< the only one that it belongs to; 0: none, or several
};

/// Data that the sections of a file fill.
struct GmshMesh {
  MeshFile file;
  LabelTable nodes;                                   ///< of file.node_labels; after the section of nodes
  std::vector<std::vector<std::int64_t>> spots;       ///< [groups of cells][cells] where they stand
  std::map<GmshTag, std::vector<std::string>> names;  ///< of physical groups
  std::map<GmshTag, GmshEntity> entities;             ///< those of $Entities
  std::int64_t partitions = 0;                        ///< that the whole mesh was cut into
  std::set<std::int64_t> partitions_here;             ///< that have elements in the file
  std::map<GmshTag, std::vector<FileCellRange>> physical_cells, entity_cells;
  std::map<GmshTag, std::vector<std::int32_t>> physical_points, entity_points;  ///< nodes
  std::map<GmshTag, std::set<std::int64_t>> physical_of_entity;                 ///< version 2.2: those of the elements of each
};

/// Reads the rest of an element, the labels of its nodes, and adds it. Returns the cell; a group of -1 for a point, with its node as `cell`.
FileCellRange read_gmsh_nodes_of(GmshNumbers& numbers, GmshMesh& mesh, const GmshElementType& type, std::int64_t label, std::int64_t spot);

/// Finds the labels of nodes, and refuses those that stand twice.
void index_gmsh_nodes(GmshNumbers& numbers, GmshMesh& mesh, const std::vector<std::int64_t>& spots);

/// Refuses an element type that is not read.
const GmshElementType& require_gmsh_type(GmshNumbers& numbers, std::int64_t number, std::int64_t spot);

/// An element that is in several groups stands in a file of version 2.2 once for each: makes one cell of them.
void merge_gmsh_copies(GmshMesh& mesh);

/// Refuses labels of elements that stand twice.
void require_distinct_gmsh_elements(GmshNumbers& numbers, const GmshMesh& mesh);

/// Makes the sets of the file of the groups.
void name_gmsh_sets(GmshMesh& mesh);

/// The sections of each version, up to what ends them.
void read_gmsh_2_nodes(GmshNumbers& numbers, GmshMesh& mesh);
void read_gmsh_2_elements(GmshNumbers& numbers, GmshMesh& mesh);
void read_gmsh_4_nodes(GmshNumbers& numbers, GmshMesh& mesh);
void read_gmsh_4_elements(GmshNumbers& numbers, GmshMesh& mesh);
/// $Entities, or $PartitionedEntities, which has more of each.
void read_gmsh_4_entities(GmshNumbers& numbers, GmshMesh& mesh, bool partitioned);

}  // namespace mortise
