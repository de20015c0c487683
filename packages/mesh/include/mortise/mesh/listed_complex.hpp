#pragma once
// The description of a body whose nodes and elements are listed: one of a mesh file.

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "mortise/mesh/cell_nodes.hpp"
#include "mortise/mesh/mesh_file.hpp"
#include "mortise/mesh/row_store.hpp"
#include "mortise/mesh/spatial_placement.hpp"

namespace mortise {

/// Elements of one shape that follow each other in a body.
struct BodyPart {
  std::string name;  ///< of what has a material of its own; empty: the rest
  CellShape shape = CellShape::quadrilateral4;
  GlobalOrdinal elements = 0;
};

/// A body of a mesh file. Nodes and elements have numbers from 0 on, in the order of the file, elements part by part. Every rank knows names and
/// sizes. Rank 0 has all rows; the other ranks have those that they fetched.
struct ListedBody {
  int dimension = 3;
  GlobalOrdinal nodes = 0;
  std::vector<BodyPart> parts;
  std::vector<std::string> side_names;       ///< of sets of sides on its surface
  std::vector<std::string> node_set_names;   ///< of sets of nodes
  std::vector<LeftOutSet> left_out;          ///< sets of the file that are not read
  std::vector<std::string> notes;            ///< changes and omissions, in words
  std::vector<std::string> warnings;         ///< things that are most likely not meant, in words
  RowStore<double> coordinates;              ///< [nodes][3]
  RowStore<std::int32_t> element_nodes;      ///< [elements][nodes of the shape]
  RowStore<std::int32_t> surface_sides;      ///< [elements][side, name, side, name, ...] -1: a side of the surface without a name
  RowStore<std::int32_t> sides_of_node;      ///< [nodes] names of the sides that a node lies on, ascending, -1 for the surface alone
  RowStore<std::int32_t> node_sets_of_node;  ///< [nodes] ascending
  RowStore<std::int32_t> elements_of_node;   ///< [nodes] ascending
  RowStore<double> labels;                   ///< [elements] the element's number in the file, exact up to 2^53

  GlobalOrdinal elements() const;
};

/// A listed body with the members of PatchComplex that a mesh is built from. Rows have to be there: see ListedBody.
class ListedComplex {
 public:
  explicit ListedComplex(std::shared_ptr<ListedBody> body) : body_(std::move(body)) {}

  /// Data to be fetched for others; all ranks have their own copy.
  ListedBody& body() const { return *body_; }
  GlobalOrdinal node_count() const { return body_->nodes; }
  GlobalOrdinal element_count() const { return body_->elements(); }
  const std::vector<std::string>& side_names() const { return body_->side_names; }

  SpatialPoint coordinate(GlobalOrdinal node) const;
  CellNodes element_nodes(GlobalOrdinal element) const;
  /// Ascending.
  std::vector<GlobalOrdinal> elements_of_node(GlobalOrdinal node) const;
  /// The name of a side without one is -1.
  std::vector<SurfaceSide> surface_sides(GlobalOrdinal element) const;
  /// Ascending; -1 first if it lies on the surface.
  std::vector<int> sides_of_node(GlobalOrdinal node) const;

 private:
  std::shared_ptr<ListedBody> body_;
};

}  // namespace mortise
