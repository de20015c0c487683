#pragma once
// A rigid brick in 3D that follows a point of its own.

#include "mortise/mesh/build_mesh.hpp"
#include "mortise/mesh/reference_point.hpp"
#include "mortise/mesh/volume_generators.hpp"
#include "solid_test_support.hpp"

namespace mortise {

/// Its point is named "point".
inline std::shared_ptr<const Bodies> rigid_brick() {
  const auto brick = std::make_shared<BrickMesh>();
  brick->width = 2.0;
  brick->cells_x = brick->cells_y = brick->cells_z = 2;
  const auto mesh = build_mesh(self(), {{"tool", {}, brick, rigid_shape(3)}}, {}, {{"point", {}, true, std::array<double, 3>{0.3, -0.4, 0.2}}});
  add_followers(*mesh, 0, {"tool", {}}, {true, true, true});
  return std::make_shared<Bodies>(displacement_space(mesh), Kinematics::three_dimensional, 1.0,
                                  std::vector<BodyProperties>{{"tool", {}, nullptr, ElementType::h8}});
}

/// Displacements in which the point is turned by theta.
inline Eigen::VectorXd turned_by(const Bodies& bodies, const Eigen::Vector3d& theta) {
  const ReferencePoint& point = bodies.mesh()->reference_points[0];
  Eigen::VectorXd u = Eigen::VectorXd::Zero(3 * bodies.mesh()->local_count());
  u.segment<3>(3 * point.rotation_node) = point.arm * theta;
  return u;
}

}  // namespace mortise
