#pragma once
// The pure description of a structured 3D body: hexahedral blocks that share corners, edges and faces.

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "mortise/mesh/cell_nodes.hpp"
#include "mortise/mesh/lattice.hpp"
#include "mortise/mesh/spatial_placement.hpp"

namespace mortise {

/// Blocks of hexahedra, or of six tetrahedra in the place of each. Nodes are numbered corners of blocks first, then the insides of edges, of faces
/// and of blocks; elements block by block. Has the members of PatchComplex that a mesh is built from.
class VolumeComplex {
 public:
  /// A grid point of a block; coordinates are doubled (see Lattice).
  struct GridPoint {
    int block = 0;
    std::array<int, 3> at{};
  };
  struct Block {
    std::array<int, 8> corners{};        ///< number i + 2 j + 4 k: at the start (0) or end (1) in each direction; right-handed
    std::array<int, 3> cells{};          ///< in each direction
    std::array<std::string, 6> sides{};  ///< names at the start and end of i, of j, of k; empty: an inner face
  };
  /// Position of a grid point, before the placement. At a point that several blocks share it is asked for one of them.
  using Position = std::function<SpatialPoint(const GridPoint&)>;

  /// Blocks that share an edge have to run through it in the same direction with the same number of cells. Then the diagonals that cut hexahedra into
  /// tetrahedra meet.
  /// @throws std::logic_error otherwise, and for cells that blocks are not made of (errors of the generator)
  VolumeComplex(CellShape shape, std::vector<Block> blocks, Position position, SpatialPlacement placement);

  /// True if blocks can be made of cells of this shape.
  static bool is_made_of(CellShape shape);

  CellShape shape() const { return shape_; }
  GlobalOrdinal node_count() const { return first_node_.back(); }
  GlobalOrdinal element_count() const { return first_cell_.back() * elements_per_cell(); }
  const std::vector<std::string>& side_names() const { return side_names_; }

  SpatialPoint coordinate(GlobalOrdinal node) const;
  CellNodes element_nodes(GlobalOrdinal element) const;
  /// Ascending.
  std::vector<GlobalOrdinal> elements_of_node(GlobalOrdinal node) const;
  std::vector<SurfaceSide> surface_sides(GlobalOrdinal element) const;
  /// Ascending.
  std::vector<int> sides_of_node(GlobalOrdinal node) const;

 private:
  /// A corner, edge, face or inside of a block: in each direction at the start (0), inside (1) or at the end (2), as digits of a number of base 3.
  static constexpr int parts_of_block = 27;
  /// Part of a block: its entity, and the direction of the block for each of the entity's.
  struct PartUse {
    int entity = 0;
    std::array<int, 3> axes{};
  };
  struct EntityUse {
    int block, part;
  };
  /// A corner, edge, face or inside, on its own.
  struct Entity {
    Lattice lattice;
    std::vector<EntityUse> uses;
  };
  using GridPoints = boost::container::static_vector<GridPoint, most_cell_nodes>;

  bool is_cut() const { return topology(shape_).corners == 4; }
  int elements_per_cell() const { return is_cut() ? 6 : 1; }
  void add_entities(int dimension);
  GridPoint cell_of(GlobalOrdinal element) const;
  GridPoints corners_of(GlobalOrdinal element) const;
  GlobalOrdinal node_at(const GridPoint& point) const;
  std::vector<GridPoint> grid_points(GlobalOrdinal node) const;
  bool is_at(const GridPoint& point, int side) const { return point.at[side / 2] == (side % 2 == 0 ? 0 : 2 * blocks_[point.block].cells[side / 2]); }

  CellShape shape_;
  std::vector<Block> blocks_;
  Position position_;
  SpatialPlacement placement_;
  std::vector<Entity> entities_;
  std::vector<std::array<PartUse, parts_of_block>> parts_;  ///< [blocks]
  std::vector<std::array<int, 6>> block_sides_;             ///< [blocks] index into side_names_, or -1
  std::vector<GlobalOrdinal> first_node_{0};                ///< [entities], and the end
  std::vector<GlobalOrdinal> first_cell_{0};                ///< [blocks], and the end
  std::vector<std::string> side_names_;
};

}  // namespace mortise
