#pragma once
// Sides of elements under load, and integration over them.

#include <Eigen/Dense>
#include <array>
#include <string>
#include <vector>

#include "mortise/core/parameters.hpp"
#include "mortise/mesh/field_rows.hpp"
#include "mortise/mesh/mesh.hpp"
#include "mortise/shape/surface_facet.hpp"
#include "mortise/solid/element_type.hpp"

namespace mortise {

/// A point of the rule on a side.
struct SidePoint {
  std::array<double, most_side_nodes> N{};
  std::array<std::array<double, 2>, most_side_nodes> gradient{};  ///< dN_a / dxi_i; of lines the second is 0
  double weight = 0.0;                                            ///< on the reference cell
};

/// Where a point of a side is, at given positions of the side's nodes.
struct SidePosition {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  std::array<Eigen::Vector3d, 2> tangents{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};  ///< dx/dxi_i; the second in 2D: e_z
  Eigen::Vector3d area;  ///< tangents[0] x tangents[1]: the outward normal times area (in 2D length) per reference area
};

/// A side of an element.
struct LoadedSide {
  Facet<LocalOrdinal> nodes;
  int dimension;                       ///< of the mesh
  const std::vector<SidePoint>* rule;  ///< of side_points

  /// `displacement`: without values none.
  SidePosition at(const SidePoint& point, const Mesh& mesh, const FieldView<const double>& displacement) const;
};

/// Factor that makes a length in 2D at radius r an area: the thickness, or 2 pi r; 1 in 3D.
double depth(Kinematics kinematics, double thickness, double radius);

class Bodies;

/// The weight of a point in integrals over the reference surface: area, in 2D length times thickness or 2 pi R. [area]
double reference_area(const Bodies& bodies, const LoadedSide& side, const SidePoint& point);

/// A side as it stands in a set.
LoadedSide side_of(const Mesh& mesh, const Side& side);

/// A facet of nodes that this rank knows, by their ids.
LoadedSide side_of(const Mesh& mesh, const SurfaceFacet& facet);

/// The sides of the set whose elements this rank owns. Collective; throws InputError on all ranks if there is no such set.
std::vector<LoadedSide> owned_sides(const Mesh& mesh, const Located<std::string>& set);

/// The sides of the set that touch a node of this rank. Collective; throws InputError on all ranks if there is no such set.
std::vector<LoadedSide> sides_at_owned_nodes(const Mesh& mesh, const Located<std::string>& set);

}  // namespace mortise
