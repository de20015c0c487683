#include "mortise/shape/cell.hpp"

#include <stdexcept>

namespace mortise {

const CellTopology& topology(CellShape shape) {
  static const CellTopology line{1, 2, {{0, 1}}};
  static const CellTopology triangle{2, 3, {{0, 1}, {1, 2}, {2, 0}}};
  static const CellTopology quadrilateral{2, 4, {{0, 1}, {1, 2}, {2, 3}, {3, 0}}};
  switch (shape) {
    case CellShape::line2:
      return line;
    case CellShape::triangle3:
      return triangle;
    case CellShape::quadrilateral4:
      return quadrilateral;
  }
  throw std::invalid_argument("unknown cell shape");
}

}  // namespace mortise
