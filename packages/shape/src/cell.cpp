#include "mortise/shape/cell.hpp"

#include <stdexcept>

namespace mortise {

const CellTopology& topology(CellShape shape) {
  static const CellTopology line2{1, 2, 2, CellShape::line2, {{0, 1}}};
  static const CellTopology line3{1, 3, 2, CellShape::line3, {{0, 1, 2}}};
  static const CellTopology triangle3{2, 3, 3, CellShape::line2, {{0, 1}, {1, 2}, {2, 0}}};
  static const CellTopology triangle6{2, 6, 3, CellShape::line3, {{0, 1, 3}, {1, 2, 4}, {2, 0, 5}}};
  static const CellTopology quadrilateral4{2, 4, 4, CellShape::line2, {{0, 1}, {1, 2}, {2, 3}, {3, 0}}};
  static const CellTopology quadrilateral8{2, 8, 4, CellShape::line3, {{0, 1, 4}, {1, 2, 5}, {2, 3, 6}, {3, 0, 7}}};
  static const CellTopology tetrahedron4{3, 4, 4, CellShape::triangle3, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};
  static const CellTopology tetrahedron10{
      3, 10, 4, CellShape::triangle6, {{0, 2, 1, 6, 5, 4}, {0, 1, 3, 4, 8, 7}, {1, 2, 3, 5, 9, 8}, {2, 0, 3, 6, 7, 9}}};
  // bottom, top, front (y = -1), right (x = 1), back, left
  static const CellTopology hexahedron8{
      3, 8, 8, CellShape::quadrilateral4, {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}};
  static const CellTopology hexahedron20{3,
                                         20,
                                         8,
                                         CellShape::quadrilateral8,
                                         {{0, 3, 2, 1, 11, 10, 9, 8},
                                          {4, 5, 6, 7, 12, 13, 14, 15},
                                          {0, 1, 5, 4, 8, 17, 12, 16},
                                          {1, 2, 6, 5, 9, 18, 13, 17},
                                          {2, 3, 7, 6, 10, 19, 14, 18},
                                          {3, 0, 4, 7, 11, 16, 15, 19}}};
  switch (shape) {
    case CellShape::line2:
      return line2;
    case CellShape::line3:
      return line3;
    case CellShape::triangle3:
      return triangle3;
    case CellShape::triangle6:
      return triangle6;
    case CellShape::quadrilateral4:
      return quadrilateral4;
    case CellShape::quadrilateral8:
      return quadrilateral8;
    case CellShape::tetrahedron4:
      return tetrahedron4;
    case CellShape::tetrahedron10:
      return tetrahedron10;
    case CellShape::hexahedron8:
      return hexahedron8;
    case CellShape::hexahedron20:
      return hexahedron20;
  }
  throw std::invalid_argument("unknown cell shape");
}

}  // namespace mortise
