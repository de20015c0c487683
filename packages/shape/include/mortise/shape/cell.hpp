#pragma once
// The registry of cell shapes. A new shape is a header beside this one, and a name and a line here.

#include <algorithm>
#include <array>
#include <stdexcept>
#include <type_traits>
#include <vector>

#include "mortise/shape/hexahedron20.hpp"
#include "mortise/shape/hexahedron8.hpp"
#include "mortise/shape/line2.hpp"
#include "mortise/shape/line3.hpp"
#include "mortise/shape/pyramid5.hpp"
#include "mortise/shape/quadrilateral4.hpp"
#include "mortise/shape/quadrilateral8.hpp"
#include "mortise/shape/surface_facet.hpp"
#include "mortise/shape/tetrahedron10.hpp"
#include "mortise/shape/tetrahedron4.hpp"
#include "mortise/shape/triangle3.hpp"
#include "mortise/shape/triangle6.hpp"
#include "mortise/shape/wedge15.hpp"
#include "mortise/shape/wedge6.hpp"

namespace mortise {

/// Shapes of elements and of their sides. Corners come first, then mid-side nodes. Nodes of plane cells are numbered counterclockwise. Hexahedra have
/// the bottom's nodes counterclockwise seen from above, then the top's (edges: bottom, top, upright), and so have wedges. Tetrahedra and pyramids
/// have the base's nodes counterclockwise seen from the apex. Rigid bodies are made of lines in 2D, of quadrilaterals in 3D. The order of the names
/// means nothing.
enum class CellShape {
  line2,
  line3,
  triangle3,
  triangle6,
  quadrilateral4,
  quadrilateral8,
  tetrahedron4,
  tetrahedron10,
  hexahedron8,
  hexahedron20,
  wedge6,
  wedge15,
  pyramid5
};

/// A line of the registry: the name of a shape and the type that says all about it. That type has
///   - dimension, corners, measure, centroid, edges, rule, contains: most often those of a reference domain;
///   - nodes, values, gradients, node_positions: the shape functions. Node corners + k lies in the middle of edges[k];
///   - sides: an array of SideNodes, or a tuple if the sides differ in shape. In 2D the outward normal is on the right of the way along a side, n =
///     (t_y, -t_x). In 3D the corners of a side run counterclockwise seen from outside;
///   - stiffness_points (2D, 3D): of the rule that integrates the stiffness of an undistorted cell exactly;
///   - axisymmetric_stiffness_points (2D): the same with radii and hoop strains;
///   - mass_points (2D, 3D): of the rule that integrates products of two shape functions over an undistorted cell exactly;
///   - axisymmetric_mass_points (2D): of the rule for these products times a radius;
///   - side_points (lines, 2D): of the rule for loads on a side of this shape. It is exact to degree 5 or more on straight sides: for N_a x radius x
///     expressions up to cubic;
///   - jacobian_points: of the rule where det J is looked at for inverted cells, besides the nodes; 0: the nodes are enough. Simplices of corners
///     alone have a constant det J and no such number;
///   - midpoint_directions: in how many directions of a lattice at once a node may be a midpoint;
///   - Profile (3D): the plane cells below those that a sweep makes (void: no sweep makes them);
///   - MiddleProfile (3D): the plane cells whose nodes lie half way up them (void: no nodes lie there);
///   - xdmf_number: of the shape in a mixed topology of XDMF.
template <CellShape name, class Type>
struct CellEntry {
  static constexpr CellShape shape = name;  ///< for run time
  using Cell = Type;                        ///< for compile time
};

/// Lines of the registry.
template <class... Entries>
struct CellList {};

/// All shapes.
using Cells = CellList<CellEntry<CellShape::line2, Line2>, CellEntry<CellShape::line3, Line3>, CellEntry<CellShape::triangle3, Triangle3>,
                       CellEntry<CellShape::triangle6, Triangle6>, CellEntry<CellShape::quadrilateral4, Quadrilateral4>,
                       CellEntry<CellShape::quadrilateral8, Quadrilateral8>, CellEntry<CellShape::tetrahedron4, Tetrahedron4>,
                       CellEntry<CellShape::tetrahedron10, Tetrahedron10>, CellEntry<CellShape::hexahedron8, Hexahedron8>,
                       CellEntry<CellShape::hexahedron20, Hexahedron20>, CellEntry<CellShape::wedge6, Wedge6>, CellEntry<CellShape::wedge15, Wedge15>,
                       CellEntry<CellShape::pyramid5, Pyramid5>>;

namespace detail {

template <class First, class... Rest, class Visitor>
decltype(auto) visit_cell_of(CellList<First, Rest...>, CellShape shape, Visitor& visitor) {
  if (shape == First::shape) return visitor(typename First::Cell{});
  if constexpr (sizeof...(Rest) > 0) return visit_cell_of(CellList<Rest...>{}, shape, visitor);
  throw std::logic_error("a cell shape that is not in the registry");
}

template <class Cell, class... Entries>
constexpr CellShape shape_in(CellList<Entries...>) {
  static_assert((std::is_same_v<Cell, typename Entries::Cell> || ...), "a type that is not in the registry of cell shapes");
  CellShape shape{};
  static_cast<void>(((std::is_same_v<Cell, typename Entries::Cell> && (shape = Entries::shape, true)) || ...));
  return shape;
}

template <class Visitor, class... Entries>
void visit_each_cell_of(CellList<Entries...>, Visitor& visitor) {
  (visitor(typename Entries::Cell{}), ...);
}

template <class... Entries>
constexpr int most_nodes_of(CellList<Entries...>, int most_dimension) {
  return std::max({(Entries::Cell::dimension <= most_dimension ? Entries::Cell::nodes : 0)...});
}

}  // namespace detail

/// visitor(Cell{}) for the type that describes the shape; its result has one type for all shapes. Call it once a block of elements, with the
/// loop in the visitor.
template <class Visitor>
decltype(auto) visit_cell(CellShape shape, Visitor&& visitor) {
  return detail::visit_cell_of(Cells{}, shape, visitor);
}

/// visitor(Cell{}) for each type in the registry.
template <class Visitor>
void visit_each_cell(Visitor&& visitor) {
  detail::visit_each_cell_of(Cells{}, visitor);
}

/// The name of the shape that a type describes.
template <class Cell>
inline constexpr CellShape shape_of = detail::shape_in<Cell>(Cells{});

/// Highest number of nodes of a cell.
inline constexpr int most_cell_nodes = detail::most_nodes_of(Cells{}, 3);
static_assert(most_side_nodes == detail::most_nodes_of(Cells{}, 2));

/// A side of a reference cell.
struct CellSide {
  CellShape shape;         ///< of the side
  int corners;             ///< its first nodes
  std::vector<int> nodes;  ///< nodes of the cell, in the order of the side's shape
};

/// Topology of a reference cell, for run time.
struct CellTopology {
  int dimension;                          ///< 1 for lines, 2 for plane cells, 3 for solids
  int nodes;                              ///< corners and mid-side nodes
  int corners;                            ///< the first nodes
  std::vector<CellSide> sides;            ///< none for lines
  std::vector<std::array<int, 2>> edges;  ///< corners at the ends of each; mid-side node corners + k lies in the middle of edges[k]

  /// Nodes beyond the corners.
  int mid_side_nodes() const { return nodes - corners; }
};

/// Nodes and sides of a shape; one constant object for each.
const CellTopology& topology(CellShape shape);

}  // namespace mortise
