#pragma once
// What a body can be made of: kinematics, elements, and which of their combinations with a law have a meaning.

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "mortise/core/error.hpp"
#include "mortise/material/material_options.hpp"
#include "mortise/shape/cell.hpp"

namespace mortise {

/// Two unknowns a node, and how the third direction behaves (axisymmetric: x is the radius r, y the axis z); or three unknowns a node.
enum class Kinematics { plane_strain, plane_stress, axisymmetric, three_dimensional };

/// Unknowns a node: 3 in three dimensions, else 2.
constexpr int dimension(Kinematics kinematics) { return kinematics == Kinematics::three_dimensional ? 3 : 2; }

/// F-bar takes the volume change of an element from its centre, which ends volumetric locking.
enum class ElementFormulation { standard, f_bar };

enum class ElementType { q4, q4_f_bar, t3, q8, t6, h8, h8_f_bar, tet4, h20, tet10 };

/// "plane strain", "plane stress", "axisymmetric", "three dimensional".
const std::vector<std::pair<std::string, Kinematics>>& kinematics_names();

/// "Q4", "Q4 F-bar", "T3", "Q8", "T6", "H8", "H8 F-bar", "Tet4", "H20", "Tet10".
const std::vector<std::pair<std::string, ElementType>>& element_names();

CellShape cell_shape(ElementType type);
ElementFormulation formulation(ElementType type);
std::string to_string(ElementType type);
std::string to_string(Kinematics kinematics);

/// What one body is made of. The body's mesh is the block of the same index.
struct BodyProperties {
  std::string name;
  Place place;
  std::shared_ptr<const MaterialOptions> material;  ///< null: the body is rigid
  ElementType element = ElementType::q4;
  bool is_rigid() const { return material == nullptr; }
};

/// Reports what has no meaning. Empty if all is well. No communication.
///   - a 3D element with 2D kinematics, and the other way round;
///   - F-bar with small strain or plane stress;
///   - a law without a plane stress form under plane stress.
std::vector<Diagnostic> check_combination(const BodyProperties& body, Kinematics kinematics);

}  // namespace mortise
