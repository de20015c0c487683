#pragma once
// All bodies of a mesh under one numbering.

#include <string>
#include <vector>

#include "mortise/mesh/build_mesh.hpp"

namespace mortise {

/// Throws InputError for what build_mesh() refuses of descriptions alone.
void check_bodies(const std::vector<BodyDescription>& bodies);

/// Of a generated body the one block, whose number of elements is not said.
std::vector<BodyPart> parts_of(const BodyDescription& body);

/// Throws InputError for shapes without meaning.
BodyComplex complex_of(const BodyDescription& body);

/// Elements of one shape and part that follow each other.
struct BlockRange {
  int body = 0;
  std::string part;
  CellShape shape = CellShape::quadrilateral4;
  GlobalOrdinal first_element = 0;
};

/// The descriptions of all bodies with the first node and element id of each. Those of generators are the same on every rank, of a size that does not
/// grow with the mesh. Of bodies of mesh files rank 0 knows all, and another rank what it fetched.
class BodySet {
 public:
  explicit BodySet(const std::vector<BodyDescription>& bodies);

  int size() const { return static_cast<int>(bodies_.size()); }
  int dimension() const { return dimension_; }
  GlobalOrdinal first_node(int body) const { return first_node_[body]; }
  GlobalOrdinal first_element(int body) const { return first_element_[body]; }
  GlobalOrdinal node_count() const { return first_node_.back(); }
  GlobalOrdinal element_count() const { return first_element_.back(); }
  const std::vector<BlockRange>& blocks() const { return blocks_; }
  /// One beyond the last element of a block.
  GlobalOrdinal end_of_block(std::size_t block) const { return block + 1 < blocks_.size() ? blocks_[block + 1].first_element : element_count(); }
  int body_of_node(GlobalOrdinal node) const;
  int body_of_element(GlobalOrdinal element) const;
  const CellTopology& cell_of(GlobalOrdinal element) const { return topology(block_of(element).shape); }

  /// Global node ids of an element.
  CellNodes element_nodes(GlobalOrdinal element) const;
  /// In the reference configuration; the third is 0 in 2D.
  SpatialPoint coordinate(GlobalOrdinal node) const;
  /// Global element ids, ascending.
  std::vector<GlobalOrdinal> elements_of_node(GlobalOrdinal node) const;
  /// Sides on the surface of the body, with indices into side_names(). A side with several names comes several times in a row; -1: it has no name.
  std::vector<SurfaceSide> surface_sides(GlobalOrdinal element) const;
  /// Ascending indices into side_names(); -1 stands for the surface.
  std::vector<int> sides_of_node(GlobalOrdinal node) const;
  /// Ascending indices into node_set_names().
  std::vector<int> node_sets_of_node(GlobalOrdinal node) const;
  const std::vector<std::string>& side_names(int body) const;
  const std::vector<std::string>& node_set_names(int body) const;
  /// Sets of its mesh file that are not read.
  const std::vector<LeftOutSet>& left_out_sets(int body) const;

  /// Makes nodes and surface sides of these elements (ascending) known on this rank. Collective.
  void fetch_elements(const Communicator& comm, const std::vector<GlobalOrdinal>& elements) const;
  /// Makes the elements around these nodes (ascending) known on this rank. Collective.
  void fetch_elements_around(const Communicator& comm, const std::vector<GlobalOrdinal>& nodes) const;
  /// Makes places and sets of these nodes (ascending) known on this rank. Collective.
  void fetch_nodes(const Communicator& comm, const std::vector<GlobalOrdinal>& nodes) const;

 private:
  struct Body {
    BodyComplex complex;
    std::optional<Isometry> copy;
    bool is_reflected = false;
  };
  const BlockRange& block_of(GlobalOrdinal element) const;
  template <class Fetch>
  void for_each_listed(const Fetch& fetch) const;

  int dimension_ = 2;
  std::vector<Body> bodies_;
  std::vector<BlockRange> blocks_;
  std::vector<GlobalOrdinal> first_node_{0}, first_element_{0};
};

}  // namespace mortise
