#include "readers/exodus/exodus_element_types.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "mortise/mesh/cell_nodes.hpp"
#include "mortise/mesh/mesh_file.hpp"
#include "readers/file_cells.hpp"

namespace mortise {
namespace {

using ExodusEdges = std::vector<std::array<int, 2>>;
using ExodusSides = std::vector<std::vector<int>>;

/// Exodus has the nodes of upright edges before those of the top's.
const ExodusEdges exodus_line{{0, 1}}, exodus_triangle{{0, 1}, {1, 2}, {2, 0}}, exodus_quadrilateral{{0, 1}, {1, 2}, {2, 3}, {3, 0}},
    exodus_tetrahedron{{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}},
    exodus_hexahedron{{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 4}, {1, 5}, {2, 6}, {3, 7}, {4, 5}, {5, 6}, {6, 7}, {7, 4}},
    exodus_wedge{{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 4}, {2, 5}, {3, 4}, {4, 5}, {5, 3}};

/// Corners of sides, in the order of their numbers.
const ExodusSides no_exodus_sides, exodus_triangle_sides{{0, 1}, {1, 2}, {2, 0}}, exodus_quadrilateral_sides{{0, 1}, {1, 2}, {2, 3}, {3, 0}},
    exodus_tetrahedron_sides{{0, 1, 3}, {1, 2, 3}, {0, 3, 2}, {0, 2, 1}},
    exodus_hexahedron_sides{{0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {0, 4, 7, 3}, {0, 3, 2, 1}, {4, 5, 6, 7}},
    exodus_wedge_sides{{0, 1, 4, 3}, {1, 2, 5, 4}, {0, 3, 5, 2}, {0, 2, 1}, {3, 4, 5}},
    exodus_pyramid_sides{{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {0, 4, 3}, {0, 3, 2, 1}};

/// Names of one family, beside which may stand the number of nodes.
struct ExodusFamily {
  std::vector<std::string> names;
  int dimension;
  struct Member {
    CellShape shape;
    const ExodusEdges& edges;
  };
  std::vector<Member> members;
  const ExodusSides& sides;
};

const std::vector<ExodusFamily>& exodus_families() {
  static const ExodusEdges none;
  static const std::vector<ExodusFamily> all{
      {{"BAR", "BEAM", "TRUSS", "ROD", "EDGE"}, 1, {{CellShape::line2, none}, {CellShape::line3, exodus_line}}, no_exodus_sides},
      {{"TRI", "TRIANGLE", "TRISHELL"}, 2, {{CellShape::triangle3, none}, {CellShape::triangle6, exodus_triangle}}, exodus_triangle_sides},
      {{"QUAD", "SHELL"}, 2, {{CellShape::quadrilateral4, none}, {CellShape::quadrilateral8, exodus_quadrilateral}}, exodus_quadrilateral_sides},
      {{"TET", "TETRA"}, 3, {{CellShape::tetrahedron4, none}, {CellShape::tetrahedron10, exodus_tetrahedron}}, exodus_tetrahedron_sides},
      {{"HEX", "HEXAHEDRON"}, 3, {{CellShape::hexahedron8, none}, {CellShape::hexahedron20, exodus_hexahedron}}, exodus_hexahedron_sides},
      {{"WEDGE"}, 3, {{CellShape::wedge6, none}, {CellShape::wedge15, exodus_wedge}}, exodus_wedge_sides},
      {{"PYRAMID", "PYRA"}, 3, {{CellShape::pyramid5, none}}, exodus_pyramid_sides}};
  return all;
}

/// The first two sides of a shell are its faces, along its normal and against it; its edges follow.
std::vector<int> sides_of(CellShape shape, const ExodusSides& corners, bool is_shell) {
  std::vector<int> sides;
  if (is_shell) sides = {the_cell_itself, the_other_face};
  for (const auto& side : corners) sides.push_back(side_with_corners(shape, side));
  return sides;
}

/// As Exodus' library has it: triangles are shells wherever there are three coordinates, quadrilaterals by their name.
bool is_shell(const ExodusFamily& family, const std::string& letters, int dimension) {
  return family.dimension == 2 && dimension == 3 && letters != "QUAD";
}

std::string without_digits(const std::string& name) {
  std::string letters;
  for (const char c : name) {
    if (std::isdigit(static_cast<unsigned char>(c))) break;
    letters += static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  }
  return letters;
}

std::string digits_of(const std::string& name) {
  std::string digits;
  std::copy_if(name.begin(), name.end(), std::back_inserter(digits), [](unsigned char c) { return std::isdigit(c); });
  return digits;
}

}  // namespace

ExodusElementType exodus_element_type(const std::string& name, std::int64_t nodes, int dimension, std::string& refusal) {
  const std::string letters = without_digits(name), digits = digits_of(name);
  if (nodes == 1 && (letters == "SPHERE" || letters == "CIRCLE" || letters == "POINT")) return {true, CellShape::line2, {}, {}};
  for (const ExodusFamily& family : exodus_families()) {
    if (std::find(family.names.begin(), family.names.end(), letters) == family.names.end()) continue;
    if (!digits.empty() && digits != std::to_string(nodes)) {
      refusal = fmt::format("elements of type \"{}\" have {} nodes", name, nodes);
      return {};
    }
    std::string known;
    for (const auto& [shape, edges] : family.members) {
      const int own = topology(shape).nodes;
      if (own == nodes) return {false, shape, order_of_nodes(shape, edges), sides_of(shape, family.sides, is_shell(family, letters, dimension))};
      known += fmt::format("{}{}", known.empty() ? "" : " or ", own);
    }
    refusal = fmt::format("elements of type \"{}\" with {} nodes are not read; with {} nodes they are", name, nodes, known);
    return {};
  }
  std::string known;
  for (const ExodusFamily& family : exodus_families()) known += (known.empty() ? "" : ", ") + family.names.front();
  refusal = fmt::format("elements of type \"{}\" are not read; types are {}", name, known);
  return {};
}

}  // namespace mortise
