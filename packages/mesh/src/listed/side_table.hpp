#pragma once
// All sides of the elements of a body, found by their corners: which lie on its surface, and which of them a facet of a file is.

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "listed/body_elements.hpp"

namespace mortise {

/// The nodes at the corners of a side, ascending; -1 where there are fewer than four.
using CornerKey = std::array<std::int32_t, 4>;

CornerKey corner_key(const std::int32_t* corners, int count);

class SideTable {
 public:
  /// Takes time and memory in proportion to the sides. Keeps a reference to the elements.
  SideTable(const BodyElements& elements, std::int32_t nodes);

  /// Sides that one element alone has, by element.
  std::vector<ElementSide> surface() const;
  /// The sides with these corners: of one element on the surface, of two inside the body.
  std::vector<ElementSide> find(const CornerKey& corners) const;
  CornerKey key(const ElementSide& side) const;
  /// A side that more than two elements have; none: empty.
  std::vector<ElementSide> shared_by_many() const;

 private:
  template <class Visit>
  void for_each_run(const Visit& visit) const;

  const BodyElements& elements_;
  std::vector<std::int64_t> first_;  ///< [nodes + 1] by the lowest corner
  std::vector<ElementSide> sides_;   ///< sorted by their corners
};

}  // namespace mortise
