#pragma once
// All bodies of a mesh under one numbering.

#include <vector>

#include "mortise/mesh/build_mesh.hpp"

namespace mortise {

/// Throws InputError for what build_mesh() refuses of descriptions alone.
void check_bodies(const std::vector<BodyDescription>& bodies);

/// The descriptions of all bodies with the first node and element id of each. A pure description: the same on every rank, of a size that
/// does not grow with the mesh.
class BodySet {
 public:
  explicit BodySet(const std::vector<BodyDescription>& bodies);

  int size() const { return static_cast<int>(complexes_.size()); }
  /// visit(complex of the body): one of the kinds of BodyComplex, which have alike members.
  template <class Visit>
  auto with_complex(int body, const Visit& visit) const {
    return std::visit(visit, complexes_[body]);
  }
  GlobalOrdinal first_node(int body) const { return first_node_[body]; }
  GlobalOrdinal first_element(int body) const { return first_element_[body]; }
  GlobalOrdinal node_count() const { return first_node_.back(); }
  GlobalOrdinal element_count() const { return first_element_.back(); }
  int body_of_node(GlobalOrdinal node) const;
  int body_of_element(GlobalOrdinal element) const;

  /// Global node ids of an element.
  CellNodes element_nodes(GlobalOrdinal element) const;
  /// In the reference configuration; the third is 0 in 2D.
  SpatialPoint coordinate(GlobalOrdinal node) const;
  const CellTopology& cell(int body) const { return topology(shapes_[body]); }
  int dimension() const { return dimension_; }

 private:
  int dimension_ = 2;
  std::vector<BodyComplex> complexes_;
  std::vector<CellShape> shapes_;
  std::vector<GlobalOrdinal> first_node_{0}, first_element_{0};
};

}  // namespace mortise
