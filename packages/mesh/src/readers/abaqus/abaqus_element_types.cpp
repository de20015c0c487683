#include "readers/abaqus/abaqus_element_types.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <map>

#include "readers/file_cells.hpp"

namespace mortise {
namespace {

struct AbaqusStem {
  const char* name;
  CellShape shape;
};

/// Solids and plane cells, of displacements or of temperatures (D); a formulation stands behind these.
constexpr std::array<AbaqusStem, 33> solid_stems{
    {{"C3D4", CellShape::tetrahedron4},    {"C3D5", CellShape::pyramid5},        {"C3D6", CellShape::wedge6},
     {"C3D8", CellShape::hexahedron8},     {"C3D10", CellShape::tetrahedron10},  {"C3D15", CellShape::wedge15},
     {"C3D20", CellShape::hexahedron20},   {"CPE3", CellShape::triangle3},       {"CPE4", CellShape::quadrilateral4},
     {"CPE6", CellShape::triangle6},       {"CPE8", CellShape::quadrilateral8},  {"CPS3", CellShape::triangle3},
     {"CPS4", CellShape::quadrilateral4},  {"CPS6", CellShape::triangle6},       {"CPS8", CellShape::quadrilateral8},
     {"CAX3", CellShape::triangle3},       {"CAX4", CellShape::quadrilateral4},  {"CAX6", CellShape::triangle6},
     {"CAX8", CellShape::quadrilateral8},  {"DC3D4", CellShape::tetrahedron4},   {"DC3D6", CellShape::wedge6},
     {"DC3D8", CellShape::hexahedron8},    {"DC3D10", CellShape::tetrahedron10}, {"DC3D15", CellShape::wedge15},
     {"DC3D20", CellShape::hexahedron20},  {"DC2D3", CellShape::triangle3},      {"DC2D4", CellShape::quadrilateral4},
     {"DC2D6", CellShape::triangle6},      {"DC2D8", CellShape::quadrilateral8}, {"DCAX3", CellShape::triangle3},
     {"DCAX4", CellShape::quadrilateral4}, {"DCAX6", CellShape::triangle6},      {"DCAX8", CellShape::quadrilateral8}}};

/// Formulations that Mortise's elements differ from.
const std::map<std::string, std::string>& formulations() {
  static const std::map<std::string, std::string> all{{"", ""},
                                                      {"R", "full integration"},
                                                      {"I", "displacements without incompatible modes"},
                                                      {"H", "displacements alone, without a pressure of its own"},
                                                      {"M", "ordinary quadratic functions"},
                                                      {"RH", "full integration, without a pressure of its own"},
                                                      {"IH", "displacements without incompatible modes and without a pressure of its own"},
                                                      {"MH", "ordinary quadratic functions, without a pressure of its own"}};
  return all;
}

/// Cells of surfaces in 3D, and of curves in 2D. No stiffness is read: they are the surfaces of rigid bodies.
const std::map<std::string, CellShape>& surface_types() {
  static const std::map<std::string, CellShape> all = [] {
    std::map<std::string, CellShape> types;
    const auto add = [&](CellShape shape, std::initializer_list<const char*> names) {
      for (const char* name : names) types.emplace(name, shape);
    };
    add(CellShape::triangle3, {"S3", "S3R", "S3RS", "STRI3", "M3D3", "SFM3D3", "R3D3"});
    add(CellShape::quadrilateral4, {"S4", "S4R", "S4RS", "S4RSW", "S4R5", "M3D4", "M3D4R", "SFM3D4", "SFM3D4R", "R3D4"});
    add(CellShape::triangle6, {"S6", "STRI65", "M3D6", "SFM3D6"});
    add(CellShape::quadrilateral8, {"S8", "S8R", "S8R5", "M3D8", "M3D8R", "SFM3D8", "SFM3D8R"});
    add(CellShape::line2, {"R2D2", "RAX2"});
    return types;
  }();
  return all;
}

/// Beginning of the names of other elements, and their description.
struct OtherElements {
  const char* begin;
  const char* what;
  bool is_left_out;  ///< they stand beside a mesh, whose cells do not need them
};

constexpr std::array<OtherElements, 23> other_elements{{{"B", "beams", true},
                                                        {"PIPE", "pipes", true},
                                                        {"ELBOW", "pipes", true},
                                                        {"T2D", "trusses", true},
                                                        {"T3D", "trusses", true},
                                                        {"MASS", "masses", true},
                                                        {"ROTARYI", "rotary inertias", true},
                                                        {"SPRING", "springs", true},
                                                        {"DASHPOT", "dampers", true},
                                                        {"JOINT", "joints", true},
                                                        {"DCOUP", "distributing couplings", true},
                                                        {"CONN", "connectors", true},
                                                        {"GAP", "gaps", true},
                                                        {"ITS", "gaps of tubes", true},
                                                        {"COH", "cohesive elements", false},
                                                        {"DC", "elements of heat convection", false},
                                                        {"DS", "shells of heat conduction", false},
                                                        {"F3D", "elements of fluids", false},
                                                        {"FC", "elements of fluids", false},
                                                        {"AC", "acoustic elements", false},
                                                        {"CIN", "infinite elements", false},
                                                        {"SAX", "axisymmetric shells", false},
                                                        {"D", "networks of fluids", true}}};

using Corners = std::vector<std::vector<int>>;

/// Corners of S1, S2, ... by the numbers of corners.
const Corners& abaqus_sides(const CellTopology& cell) {
  static const Corners none, triangle{{0, 1}, {1, 2}, {2, 0}}, quadrilateral{{0, 1}, {1, 2}, {2, 3}, {3, 0}},
      tetrahedron{{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}}, pyramid{{0, 1, 2, 3}, {0, 4, 1}, {1, 4, 2}, {2, 4, 3}, {3, 4, 0}},
      wedge{{0, 1, 2}, {3, 5, 4}, {0, 3, 4, 1}, {1, 4, 5, 2}, {2, 5, 3, 0}},
      hexahedron{{0, 1, 2, 3}, {4, 7, 6, 5}, {0, 4, 5, 1}, {1, 5, 6, 2}, {2, 6, 7, 3}, {3, 7, 4, 0}};
  if (cell.dimension == 2) return cell.corners == 3 ? triangle : quadrilateral;
  if (cell.dimension == 3) return cell.corners == 4 ? tetrahedron : cell.corners == 5 ? pyramid : cell.corners == 6 ? wedge : hexahedron;
  return none;
}

bool begins_with(const std::string& name, const std::string& begin) { return name.compare(0, begin.size(), begin) == 0; }

}  // namespace

AbaqusElementType abaqus_element_type(const std::string& name) {
  for (const AbaqusStem& stem : solid_stems) {
    const std::string begin(stem.name);
    if (!begins_with(name, begin) || (name.size() > begin.size() && std::isdigit(static_cast<unsigned char>(name[begin.size()])))) continue;
    std::string letters = name.substr(begin.size());
    if (!letters.empty() && letters.back() == 'T') letters.pop_back();  // has temperatures too: the cells are the same
    const auto formulation = formulations().find(letters);
    if (formulation == formulations().end())
      return {std::nullopt, false, false,
              fmt::format("{} is not read; {} is, and {}R, {}I, {}H, {}M and {}T", name, begin, begin, begin, begin, begin, begin)};
    const std::string note = formulation->second.empty() ? "" : fmt::format("elements of type {} are computed with {}", name, formulation->second);
    return {stem.shape, false, false, note};
  }
  if (const auto found = surface_types().find(name); found != surface_types().end())
    return {found->second, true, false, fmt::format("elements of type {} are surfaces, without thickness or stiffness", name)};
  for (const OtherElements& other : other_elements) {
    if (!begins_with(name, other.begin)) continue;
    if (other.is_left_out) return {std::nullopt, false, true, other.what};
    return {std::nullopt, false, false, fmt::format("{} is not read: these are {}", name, other.what)};
  }
  return {std::nullopt, false, false, fmt::format("{} is not read: it is not known", name)};
}

int abaqus_side(CellShape shape, int number) {
  const Corners& sides = abaqus_sides(topology(shape));
  if (number < 1 || number > static_cast<int>(sides.size())) return -1;
  return side_with_corners(shape, sides[static_cast<std::size_t>(number - 1)]);
}

}  // namespace mortise
