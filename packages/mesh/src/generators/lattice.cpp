#include "mortise/mesh/lattice.hpp"

#include <bitset>

namespace mortise {
namespace {

/// In how many directions at once a node of a cell may be a midpoint. Hexahedra and quadrilaterals have nodes on their edges; cells that are cut into
/// triangles or tetrahedra have them also on the diagonals.
std::size_t midpoint_directions(CellShape shape) {
  return visit_cell(shape, [](auto cell) -> std::size_t { return decltype(cell)::midpoint_directions; });
}

}  // namespace

Lattice::Lattice(CellShape shape, int dimension, const std::array<int, 3>& cells) : dimension_(dimension), cells_(cells) {
  for (unsigned kind = 0; kind < 8; ++kind) {
    GlobalOrdinal count = kind < (1u << dimension) && std::bitset<3>(kind).count() <= midpoint_directions(shape) ? 1 : 0;
    for (int d = 0; d < dimension; ++d) count *= points(d, (kind >> d) & 1u);
    first_[kind + 1] = first_[kind] + count;
  }
}

GlobalOrdinal Lattice::index(const Point& point) const {
  unsigned kind = 0;
  GlobalOrdinal index = 0;
  for (int d = dimension_ - 1; d >= 0; --d) {
    const bool is_middle = point[d] % 2 != 0;
    kind |= static_cast<unsigned>(is_middle) << d;
    index = index * points(d, is_middle) + (point[d] - 1) / 2;
  }
  return first_[kind] + index;
}

Lattice::Point Lattice::point(GlobalOrdinal index) const {
  unsigned kind = 0;
  while (index >= first_[kind + 1]) ++kind;
  index -= first_[kind];
  Point point{};
  for (int d = 0; d < dimension_; ++d) {
    const bool is_middle = (kind >> d) & 1u;
    const GlobalOrdinal count = points(d, is_middle);
    point[d] = static_cast<int>(index % count) * 2 + (is_middle ? 1 : 2);
    index /= count;
  }
  return point;
}

}  // namespace mortise
