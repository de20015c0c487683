#pragma once
// One rank's part of a distributed mesh.

#include <array>
#include <map>
#include <string>
#include <vector>

#include "mortise/core/trilinos_versions.hpp"
#include "mortise/core/types.hpp"
#include "mortise/shape/cell.hpp"

namespace mortise {

/// A body. Its elements stand in one or more blocks.
struct MeshBody {
  std::string name;
  bool is_surface = false;  ///< a rigid body, whose elements are the facets of its surface
};

/// Elements of one shape and one part of a body on this rank. First the owned ones, then ghosts: every element that touches a node owned by this rank
/// is here.
struct Block {
  int body = 0;      ///< index into Mesh::bodies
  std::string part;  ///< the name of the part of the body that has a material of its own; empty: the rest
  CellShape shape = CellShape::quadrilateral4;
  int nodes_per_element = 4;
  std::vector<LocalOrdinal> connectivity;  ///< [elements x nodes_per_element] local nodes
  std::vector<GlobalOrdinal> element_ids;  ///< [elements] unique over all blocks
  LocalOrdinal owned = 0;                  ///< number of owned elements

  LocalOrdinal size() const { return static_cast<LocalOrdinal>(element_ids.size()); }
  const LocalOrdinal* nodes(LocalOrdinal element) const { return connectivity.data() + element * nodes_per_element; }
};

/// A side of an element.
struct Side {
  LocalOrdinal block = 0, element = 0;
  int side = 0;  ///< or the_cell_itself
};

/// Sides of elements on this rank: first those of owned elements, then those of ghosts.
struct SideSet {
  std::vector<Side> sides;
  LocalOrdinal owned = 0;
};

/// A node that belongs to no element and whose motion others follow:
///   d_i = u + (R(theta) - I) (X_i - X).
/// R is the rotation by theta about the point, the identity for points that do not rotate. In 3D theta is the rotation vector: R turns by |theta|
/// about its direction.
struct ReferencePoint {
  std::string name;                               ///< of its node set
  bool is_placed = false;                         ///< its position was given
  LocalOrdinal node = 0;                          ///< carries u; on every rank
  LocalOrdinal rotation_node = -1;                ///< carries arm * theta, in 2D in its first component; -1: does not rotate
  double arm = 1.0;                               ///< [length] of the farthest corner of the box around the followers; makes a rotation a length
  std::array<bool, 3> follows{true, true, true};  ///< components of u that are followed
  std::vector<LocalOrdinal> followers;            ///< local nodes (owned and ghosts), ascending
};

/// One rank's part of a mesh. Local nodes are the owned ones, in the order of `owned_nodes`, followed by ghosts.
struct Mesh {
  int dimension = 2;
  RCP<const Communicator> comm;
  RCP<const Map> owned_nodes;                                  ///< one to one
  RCP<const Map> local_nodes;                                  ///< owned, then ghosts
  std::vector<std::array<double, 3>> coordinates;              ///< [local nodes] reference positions; z = 0 in 2D
  std::vector<MeshBody> bodies;                                ///< equal, and in the same order, on every rank
  std::vector<Block> blocks;                                   ///< in the order of their bodies; the same on every rank (possibly empty)
  std::map<std::string, SideSet> side_sets;                    ///< "body/side"; the same names on every rank
  std::map<std::string, std::vector<LocalOrdinal>> node_sets;  ///< local nodes (owned and ghosts), ascending; every side set is one too
  std::map<std::string, std::string> left_out_sets;            ///< "body/set" of a mesh file that is not read, and why
  std::vector<std::string> warnings;                           ///< of elements, in words; the same on every rank
  std::vector<int> body_of_node;                               ///< [local nodes] index of the body that the node belongs to, or whose nodes follow it
  std::vector<ReferencePoint> reference_points;                ///< equal, and in the same order, on every rank

  LocalOrdinal owned_count() const { return static_cast<LocalOrdinal>(local_id_count(*owned_nodes)); }
  /// Owned nodes of bodies; those of reference points come after them.
  LocalOrdinal owned_body_count() const {
    LocalOrdinal count = owned_count();
    for (const ReferencePoint& point : reference_points)
      if (point.node < owned_count()) count -= point.rotation_node < 0 ? 1 : 2;
    return count;
  }
  LocalOrdinal local_count() const { return static_cast<LocalOrdinal>(local_id_count(*local_nodes)); }

  /// The body that a block is part of.
  const MeshBody& body_of(const Block& block) const { return bodies[block.body]; }
  /// Local nodes of a side, in the order of the side's shape (see CellTopology::sides).
  std::vector<LocalOrdinal> side_nodes(const Side& side) const;
  /// Shape of a side.
  CellShape side_shape(const Side& side) const;
};

}  // namespace mortise
