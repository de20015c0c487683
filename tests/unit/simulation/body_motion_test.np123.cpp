// Rigid motions are found exactly, however far; what is left is deformation.

#include "mortise/simulation/run/diagnosis/body_motion.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Tpetra_Core.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_Vector.hpp>
#include <functional>

#include "mortise/mesh/build_mesh.hpp"
#include "mortise/mesh/volume_generators.hpp"
#include "mortise/solid/bodies.hpp"

namespace mortise {
namespace {

using Eigen::Vector3d;
using Motion = std::function<Vector3d(int body, const Vector3d& X)>;

RCP<Mesh> two_blocks() {
  const auto lower = std::make_shared<BlockMesh>(), upper = std::make_shared<BlockMesh>();
  lower->width = upper->width = 3.0;
  lower->cells_x = 5, upper->cells_x = 4, lower->cells_y = upper->cells_y = 3;
  upper->translation = {0.5, 1.0};
  return build_mesh(Tpetra::getDefaultComm(), {{"lower", {}, lower}, {"upper", {}, upper}}, {});
}

RCP<Mesh> two_boxes() {
  const auto lower = std::make_shared<BrickMesh>(), upper = std::make_shared<BrickMesh>();
  lower->cells_x = 2, lower->cells_y = 3, lower->cells_z = 2;
  upper->cells_x = 3, upper->cells_y = 2, upper->cells_z = 2;
  upper->translation = {0.2, 0.1, 1.0};
  return build_mesh(Tpetra::getDefaultComm(), {{"lower", {}, lower, CellShape::hexahedron8}, {"upper", {}, upper, CellShape::hexahedron8}}, {});
}

NodePlaces moved(const Mesh& mesh, const Motion& u) {
  NodePlaces at = node_places(mesh);
  for (std::size_t node = 0; node < at.x.size(); ++node) at.x[node] += u(mesh.body_of_node[node], at.x[node]);
  return at;
}

Vector3d turned(double angle, const Vector3d& axis, const Vector3d& shift, const Vector3d& X) {
  return Eigen::AngleAxisd(angle, axis.normalized()) * X - X + shift;
}

TEST(BodyMotions, ARigidMotionLeavesNothing) {
  for (const int dimension : {2, 3}) {
    const RCP<Mesh> mesh = dimension == 2 ? two_blocks() : two_boxes();
    const Vector3d axis = dimension == 2 ? Vector3d(0, 0, 1) : Vector3d(0.3, -0.5, 0.9), shift(0.7, -0.4, dimension == 2 ? 0.0 : 0.2);
    const double angle = 1.3;
    const NodePlaces before = moved(*mesh, [](int, const Vector3d&) { return Vector3d(0.1, 0.2, 0.0); });
    const NodePlaces after =
        moved(*mesh, [&](int body, const Vector3d& X) { return body == 1 ? turned(angle, axis, shift, X) : Vector3d(0.1 + 0.01 * X.x(), 0.2, 0.0); });
    const RigidModes modes(*mesh, false, {1}, after.x);
    const BodyMotions motions = body_motions(*displacement_space(mesh), modes, before, after, {});
    EXPECT_LE(motions.deformation.at(0), 1e-13);
    // Lower x reaches 3 in 2D, 1 in 3D.
    EXPECT_NEAR(motions.imposed, 0.01 * (dimension == 2 ? 3.0 : 1.0), 1e-13);
    EXPECT_LE((rotation_of(modes, motions.rigid, 0) - 2.0 * std::tan(0.5 * angle) * axis.normalized()).norm(), 1e-12);
    for (std::size_t node = 0; node < after.x.size(); ++node) {
      if (mesh->body_of_node[node] != 1) continue;
      const Vector3d u = after.x[node] - before.x[node], half_way = 0.5 * (after.x[node] + before.x[node]);
      EXPECT_LE((motion_at(modes, motions.rigid, 0, motions.middle[0], half_way) - u).norm(), 1e-13);
    }
  }
}

TEST(BodyMotions, WhatIsLeftOfAStretchIsTheStretch) {
  const RCP<Mesh> mesh = two_blocks();
  const NodePlaces before = node_places(*mesh);
  // About the middle of the body, (2, 1.5): 0.02 at 1.5 from it.
  const NodePlaces after = moved(*mesh, [](int body, const Vector3d& X) {
    return body == 1 ? Vector3d(0.3 + 0.02 / 1.5 * (X.x() - 2.0), 0.0, 0.0) : Vector3d(Vector3d::Zero());
  });
  const RigidModes modes(*mesh, false, {1}, after.x);
  const BodyMotions motions = body_motions(*displacement_space(mesh), modes, before, after, {});
  EXPECT_NEAR(motions.deformation.at(0), 0.02, 1e-13);
  EXPECT_NEAR(motions.rigid[0], 0.3, 1e-13);
  EXPECT_NEAR(motions.rigid[1], 0.0, 1e-13);
  EXPECT_EQ(motions.imposed, 0.0);
}

TEST(BodyMotions, PrescribedDofsCountAsImposed) {
  const RCP<Mesh> mesh = two_blocks();
  const NodePlaces before = node_places(*mesh);
  const NodePlaces after = moved(*mesh, [](int body, const Vector3d&) { return body == 1 ? Vector3d(0.3, -0.2, 0.0) : Vector3d(Vector3d::Zero()); });
  const RigidModes modes(*mesh, false, {1}, after.x);
  Supports supports;
  for (LocalOrdinal node = 0; node < mesh->owned_count(); ++node)
    if (mesh->body_of_node[node] == 1) supports.prescribed.push_back(2 * node + 1);
  EXPECT_NEAR(body_motions(*displacement_space(mesh), modes, before, after, supports).imposed, 0.2, 1e-14);
}

TEST(BodyMotions, AxisymmetricBodiesMoveAlongTheAxis) {
  const RCP<Mesh> mesh = two_blocks();
  const NodePlaces before = node_places(*mesh);
  const NodePlaces after = moved(*mesh, [](int body, const Vector3d&) { return body == 1 ? Vector3d(0.01, -0.2, 0.0) : Vector3d(Vector3d::Zero()); });
  const RigidModes modes(*mesh, true, {1}, after.x);
  const BodyMotions motions = body_motions(*displacement_space(mesh), modes, before, after, {});
  ASSERT_EQ(motions.rigid.size(), 1);
  EXPECT_NEAR(motions.rigid[0], -0.2, 1e-14);
  EXPECT_NEAR(motions.deformation.at(0), 0.01, 1e-14);
}

}  // namespace
}  // namespace mortise
