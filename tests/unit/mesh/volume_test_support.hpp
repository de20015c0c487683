#pragma once
// Small 3D meshes of every built-in kind, with the volumes that their linear cells fill; volumes by cells and by surfaces.

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <boost/math/constants/constants.hpp>
#include <cmath>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "mesh_test_support.hpp"
#include "mortise/mesh/volume_generators.hpp"
#include "mortise/shape/cell.hpp"

namespace mortise {

struct ExampleVolume {
  std::string name;
  std::shared_ptr<VolumeMesh> options;
  std::vector<std::string> sides;  ///< ascending
  double volume = 0.0;             ///< of linear cells, exactly; 0: known by its limit only
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
  cylinder->rotation_axis = {2.0, 0.0, 0.0};
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

/// Shapes of the cells that a mesh can be made of: none of pyramids, those that are swept also of wedges. Hexahedra come first.
inline std::vector<CellShape> cells_of(const VolumeMesh& options) {
  const bool is_swept = dynamic_cast<const SphereOctantMesh*>(&options) == nullptr;
  std::vector<CellShape> cells;
  visit_each_cell([&](auto cell) {
    using Cell = decltype(cell);
    if (Cell::dimension == 3 && Cell::corners != 5 && (Cell::corners != 6 || is_swept)) cells.push_back(shape_of<Cell>);
  });
  std::stable_sort(cells.begin(), cells.end(), [](CellShape a, CellShape b) { return topology(a).corners > topology(b).corners; });
  return cells;
}

/// visit(complex) of a 3D body.
template <class Visit>
void with_volume(const VolumeMesh& options, CellShape cell, const Visit& visit) {
  std::visit(
      [&](const auto& complex) {
        if constexpr (std::is_same_v<decltype(complex.coordinate(0)), SpatialPoint>) visit(complex);
      },
      options.complex(cell, {}));
}

using Positions = std::vector<Eigen::Vector3d>;

/// The integral of det J, exactly, by a rule in whose points det J has to be positive.
inline double volume_of_cell(CellShape shape, const Positions& x) {
  double volume = 0.0;
  visit_cell(shape, [&](auto cell) {
    using Cell = decltype(cell);
    if constexpr (Cell::dimension == 3) {
      int points = Cell::stiffness_points;
      if constexpr (Cell::nodes > 4) points = Cell::jacobian_points;
      for (const auto& point : Cell::rule(points)) {
        const auto gradients = Cell::gradients(point.template position<3>());
        Eigen::Matrix3d jacobian = Eigen::Matrix3d::Zero();
        for (std::size_t a = 0; a < x.size(); ++a)
          for (int i = 0; i < 3; ++i) jacobian.col(i) += gradients[a][i] * x[a];
        EXPECT_GT(jacobian.determinant(), 0.0);
        volume += point.weight * jacobian.determinant();
      }
    }
  });
  return volume;
}

/// The facet's share of the volume by Gauss' theorem, (1/3) integral of x . n dA, exactly; n points outward if the corners run counterclockwise seen
/// from outside.
inline double volume_below_facet(CellShape shape, const Positions& x) {
  double volume = 0.0;
  visit_cell(shape, [&](auto cell) {
    using Cell = decltype(cell);
    if constexpr (Cell::dimension == 2)
      for (const auto& point : Cell::rule(Cell::side_points)) {
        const auto values = Cell::values(point.template position<2>());
        const auto gradients = Cell::gradients(point.template position<2>());
        Eigen::Vector3d at = Eigen::Vector3d::Zero(), along_xi = at, along_eta = at;
        for (std::size_t a = 0; a < x.size(); ++a) {
          at += values[a] * x[a];
          along_xi += gradients[a][0] * x[a];
          along_eta += gradients[a][1] * x[a];
        }
        volume += point.weight * at.dot(along_xi.cross(along_eta)) / 3.0;
      }
  });
  return volume;
}

}  // namespace mortise
