#pragma once
// A facet of a surface by the ids of its nodes.

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <initializer_list>
#include <utility>
#include <vector>

#include "mortise/core/types.hpp"

namespace mortise {

/// Highest number of nodes of a side of a cell.
inline constexpr int most_side_nodes = 8;

/// Nodes of a facet, in the order of its shape. In 2D it is a line of 2 (or 3) nodes with the outward normal on the right of the direction of travel,
/// n = (t_y, -t_x). In 3D it is a triangle of 3 (or 6) or a quadrilateral of 4 (or 8) nodes whose corners run counterclockwise seen from outside.
/// A sequence on the stack, as std::vector is one on the heap.
template <class Ordinal>
class Facet {
 public:
  using value_type = Ordinal;             ///< id of a node
  using iterator = Ordinal*;              ///< over the nodes
  using const_iterator = const Ordinal*;  ///< over the nodes

  Facet() = default;
  /// `count` nodes, at first `value`.
  explicit Facet(std::size_t count, Ordinal value = {}) { resize(count, value); }
  /// These nodes.
  Facet(std::initializer_list<Ordinal> nodes) : Facet(nodes.begin(), nodes.end()) {}
  /// The nodes of a range.
  template <class Iterator, class = decltype(*std::declval<Iterator>())>
  Facet(Iterator first, Iterator last) {
    for (; first != last; ++first) push_back(*first);
  }

  std::size_t size() const { return size_; }                                  ///< number of nodes
  static constexpr std::size_t max_size() { return most_side_nodes; }         ///< highest number of nodes
  bool empty() const { return size_ == 0; }                                   ///< true of a facet without nodes
  iterator begin() { return nodes_.data(); }                                  ///< the first node
  iterator end() { return nodes_.data() + size_; }                            ///< behind the last node
  const_iterator begin() const { return nodes_.data(); }                      ///< the first node
  const_iterator end() const { return nodes_.data() + size_; }                ///< behind the last node
  Ordinal* data() { return nodes_.data(); }                                   ///< all nodes
  const Ordinal* data() const { return nodes_.data(); }                       ///< all nodes
  Ordinal& operator[](std::size_t node) { return nodes_[node]; }              ///< by its place
  const Ordinal& operator[](std::size_t node) const { return nodes_[node]; }  ///< by its place
  const Ordinal& front() const { return nodes_[0]; }                          ///< the first node
  const Ordinal& back() const { return nodes_[size_ - 1]; }                   ///< the last node

  /// Adds a node at the end.
  void push_back(Ordinal node) {
    assert(size_ < nodes_.size());
    nodes_[size_++] = node;
  }
  /// Leaves the first `count` nodes, or adds `value` until there are as many.
  void resize(std::size_t count, Ordinal value = {}) {
    assert(count <= nodes_.size());
    if (count > size_) std::fill(end(), begin() + count, value);
    size_ = count;
  }
  /// Removes all nodes.
  void clear() { size_ = 0; }

  /// True of equal nodes in an equal order.
  friend bool operator==(const Facet& a, const Facet& b) { return std::equal(a.begin(), a.end(), b.begin(), b.end()); }
  friend bool operator!=(const Facet& a, const Facet& b) { return !(a == b); }  ///< its opposite
  /// The order of words in a dictionary.
  friend bool operator<(const Facet& a, const Facet& b) { return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end()); }

 private:
  std::array<Ordinal, most_side_nodes> nodes_{};
  std::size_t size_ = 0;
};

using SurfaceFacet = Facet<GlobalOrdinal>;
using SurfaceFacets = std::vector<SurfaceFacet>;

}  // namespace mortise
