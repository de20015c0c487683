#pragma once
// Small meshes of space of every built-in kind, with the volumes that their flat-sided cells fill; volumes by cells and by surfaces.

#include <Eigen/Dense>
#include <boost/math/constants/constants.hpp>
#include <cmath>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "mesh_test_support.hpp"
#include "mortise/mesh/volume_generators.hpp"

namespace mortise {

struct ExampleVolume {
  std::string name;
  std::shared_ptr<VolumeMesh> options;
  std::vector<std::string> sides;  ///< ascending
  double volume = 0.0;             ///< of the cells, exactly; 0: known by its limit only
};

inline std::vector<ExampleVolume> example_volumes() {
  constexpr double pi = boost::math::constants::pi<double>();
  auto brick = std::make_shared<BrickMesh>();
  brick->width = 3.0;
  brick->depth = 2.0;
  brick->height = 1.5;
  brick->cells_x = 4;
  brick->cells_y = 3;
  brick->cells_z = 2;
  brick->grading_x.ratio = 3.0;
  brick->grading_z.ratio = 2.0;
  auto cylinder = std::make_shared<CylinderMesh>();
  cylinder->disk.radius = 2.0;
  cylinder->height = 1.5;
  cylinder->disk.cells_around = 3;
  cylinder->disk.cells_across = 2;
  cylinder->cells_z = 3;
  cylinder->rotation = 35.0;
  cylinder->rotation_axis = Axis::x;
  auto tube = std::make_shared<ExtrudedMesh>();
  tube->profile = {"ring sector", std::dynamic_pointer_cast<PlaneMesh>(example_meshes()[2].options), {}};
  tube->length = 2.0;
  tube->cells_z = 2;
  auto half = std::make_shared<ExtrudedMesh>();
  half->profile = {"half disk", std::dynamic_pointer_cast<PlaneMesh>(example_meshes()[4].options), {}};
  half->length = 0.5;
  half->cells_z = 2;
  auto rectangle = std::make_shared<BlockMesh>();
  rectangle->width = 2.0;
  rectangle->height = 1.0;
  rectangle->translation = {1.0, 0.0};
  rectangle->cells_x = 2;
  rectangle->cells_y = 3;
  auto ring = std::make_shared<RevolvedMesh>();
  ring->profile = {"block", rectangle, {}};
  ring->angle = 200.0;
  ring->cells_around = 10;
  ring->translation = {1.0, 2.0, 3.0};
  auto octant = std::make_shared<SphereOctantMesh>();
  octant->cells_along = 3;
  octant->cells_beyond = 2;
  octant->cells_across = 4;
  octant->grading_along.ratio = 2.0;
  octant->grading_across.ratio = 3.0;
  // Polygons of n corners on a circle: n/2 sin(2 pi / n) R^2; chords of the ring's sector and half disk alike, with their own angles.
  const double sector = 17 * 0.5 * std::sin(1.5 * pi / 17.0) * 3.0;
  double half_disk = 0.0;  // graded arcs
  const auto plane = half->profile.options->build(CellShape::quadrilateral4, {});
  for (GlobalOrdinal e = 0; e < plane.element_count(); ++e)
    for (int a = 0; a < 4; ++a) {
      const Point p = plane.coordinate(plane.element_nodes(e)[a]), q = plane.coordinate(plane.element_nodes(e)[(a + 1) % 4]);
      half_disk += 0.5 * (p[0] * q[1] - p[1] * q[0]);
    }
  return {{"brick", brick, {"back", "bottom", "front", "left", "right", "top"}, 9.0},
          {"cylinder", cylinder, {"bottom", "mantle", "top"}, 6.0 * std::sin(pi / 6.0) * 4.0 * 1.5},
          {"tube", tube, {"end", "inner", "outer", "start", "sweep end", "sweep start"}, 2.0 * sector},
          {"half cylinder", half, {"arc", "diameter", "end", "start"}, 0.5 * half_disk},
          {"revolved ring", ring, {"bottom", "end", "left", "right", "start", "top"}, 10 * 0.5 * std::sin(pi / 9.0) * 8.0},
          {"sphere octant", octant, {"equator", "sphere", "x plane", "y plane"}, 0.0}};
}

/// visit(complex) of a body of space.
template <class Visit>
void with_volume(const VolumeMesh& options, CellShape cell, const Visit& visit) {
  std::visit(
      [&](const auto& complex) {
        if constexpr (std::is_same_v<decltype(complex.coordinate(0)), SpatialPoint>) visit(complex);
      },
      options.complex(cell, {}));
}

using Corners = std::vector<Eigen::Vector3d>;

/// The integral of det J of a tetrahedron or a trilinear hexahedron (2 x 2 x 2 points, exact).
inline double volume_of_cell(const Corners& x) {
  if (x.size() == 4) return (x[1] - x[0]).cross(x[2] - x[0]).dot(x[3] - x[0]) / 6.0;
  constexpr double sign[8][3] = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1}, {-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}};
  const double g = std::sqrt(1.0 / 3.0);
  double volume = 0.0;
  for (const auto& point : sign) {
    Eigen::Matrix3d jacobian = Eigen::Matrix3d::Zero();
    for (int a = 0; a < 8; ++a)
      for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        jacobian.col(i) += 0.125 * sign[a][i] * (1.0 + g * sign[a][j] * point[j]) * (1.0 + g * sign[a][k] * point[k]) * x[a];
      }
    volume += jacobian.determinant();
  }
  return volume;
}

/// The facet's share of the volume by Gauss' theorem, (1/3) integral of x . n dA, with n outward if the corners run counterclockwise seen from
/// outside; exact for triangles and bilinear facets (2 x 2 points).
inline double volume_below_facet(const Corners& x) {
  if (x.size() == 3) return x[0].dot((x[1] - x[0]).cross(x[2] - x[0])) / 6.0;
  double volume = 0.0;
  const double g = std::sqrt(1.0 / 3.0);
  for (const double xi : {-g, g})
    for (const double eta : {-g, g}) {
      const Eigen::Vector3d at =
          0.25 * ((1 - xi) * (1 - eta) * x[0] + (1 + xi) * (1 - eta) * x[1] + (1 + xi) * (1 + eta) * x[2] + (1 - xi) * (1 + eta) * x[3]);
      const Eigen::Vector3d along_xi = 0.25 * ((1 - eta) * (x[1] - x[0]) + (1 + eta) * (x[2] - x[3]));
      const Eigen::Vector3d along_eta = 0.25 * ((1 - xi) * (x[3] - x[0]) + (1 + xi) * (x[2] - x[1]));
      volume += at.dot(along_xi.cross(along_eta)) / 3.0;
    }
  return volume;
}

}  // namespace mortise
