#include "readers/gmsh/gmsh_element_types.hpp"

#include <fmt/format.h>

#include <map>

#include "readers/file_cells.hpp"

namespace mortise {
namespace {

using GmshEdges = std::vector<std::array<int, 2>>;

/// The edges whose middle nodes Gmsh puts behind the corners, in its order.
const GmshEdges no_gmsh_edges, gmsh_line{{0, 1}}, gmsh_triangle{{0, 1}, {1, 2}, {2, 0}}, gmsh_quadrilateral{{0, 1}, {1, 2}, {2, 3}, {3, 0}},
    gmsh_tetrahedron{{0, 1}, {1, 2}, {2, 0}, {3, 0}, {2, 3}, {1, 3}},
    gmsh_hexahedron{{0, 1}, {0, 3}, {0, 4}, {1, 2}, {1, 5}, {2, 3}, {2, 6}, {3, 7}, {4, 5}, {4, 7}, {5, 6}, {6, 7}},
    gmsh_wedge{{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 4}, {2, 5}, {3, 4}, {3, 5}, {4, 5}};

GmshElementType entry_of(CellShape shape, const GmshEdges& edges) {
  const CellTopology& cell = topology(shape);
  return {shape, cell.nodes, cell.dimension, order_of_nodes(shape, edges)};
}

const std::map<std::int64_t, GmshElementType>& gmsh_element_types() {
  static const std::map<std::int64_t, GmshElementType> all{{1, entry_of(CellShape::line2, no_gmsh_edges)},
                                                           {2, entry_of(CellShape::triangle3, no_gmsh_edges)},
                                                           {3, entry_of(CellShape::quadrilateral4, no_gmsh_edges)},
                                                           {4, entry_of(CellShape::tetrahedron4, no_gmsh_edges)},
                                                           {5, entry_of(CellShape::hexahedron8, no_gmsh_edges)},
                                                           {6, entry_of(CellShape::wedge6, no_gmsh_edges)},
                                                           {7, entry_of(CellShape::pyramid5, no_gmsh_edges)},
                                                           {8, entry_of(CellShape::line3, gmsh_line)},
                                                           {9, entry_of(CellShape::triangle6, gmsh_triangle)},
                                                           {11, entry_of(CellShape::tetrahedron10, gmsh_tetrahedron)},
                                                           {15, {}},
                                                           {16, entry_of(CellShape::quadrilateral8, gmsh_quadrilateral)},
                                                           {17, entry_of(CellShape::hexahedron20, gmsh_hexahedron)},
                                                           {18, entry_of(CellShape::wedge15, gmsh_wedge)}};
  return all;
}

}  // namespace

const GmshElementType* gmsh_element_type(std::int64_t number) {
  const auto found = gmsh_element_types().find(number);
  return found == gmsh_element_types().end() ? nullptr : &found->second;
}

std::string why_gmsh_type_is_refused(std::int64_t number) {
  // With nodes inside their faces or cells.
  static const std::map<std::int64_t, const char*> complete{
      {10, "quadrilateral of 9 nodes"}, {12, "hexahedron of 27 nodes"}, {13, "wedge of 18 nodes"}, {14, "pyramid of 14 nodes"}};
  if (const auto found = complete.find(number); found != complete.end())
    return fmt::format("type {} ({}) is not read; mesh with Mesh.SecondOrderIncomplete=1, or with Mesh.ElementOrder=1", number, found->second);
  if (number == 19) return "type 19 (pyramid of 13 nodes) is not read; mesh with Mesh.ElementOrder=1, or without pyramids";
  std::string known;
  for (const auto& entry : gmsh_element_types()) known += fmt::format("{}{}", known.empty() ? "" : ", ", entry.first);
  return fmt::format("type {} is not read; types are {}. Mesh with Mesh.ElementOrder 1 or 2", number, known);
}

}  // namespace mortise
