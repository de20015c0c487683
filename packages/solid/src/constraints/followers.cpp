#include "mortise/solid/followers.hpp"

#include <Tpetra_Map.hpp>
#include <map>

#include "bodies/host_view.hpp"
#include "mortise/solid/rotation_vector.hpp"

namespace mortise {
namespace {

/// Radial motion and rotation would not leave a ring rigid: there, rigid bodies follow along the axis only.
bool is_followed(const Bodies& bodies, const ReferencePoint& point, int component) {
  return point.follows[component] && !(bodies.kinematics() == Kinematics::axisymmetric && component == 0);
}

/// True if a follower's component is its own unknown.
bool is_free(const Bodies& bodies, const ReferencePoint& point, LocalOrdinal node, int component) {
  if (point.follows[component]) return false;
  return !bodies.mesh()->bodies[bodies.mesh()->body_of_node[node]].is_surface;
}

}  // namespace

Followers::Followers(const Bodies& bodies) : bodies_(bodies) {
  const Mesh& mesh = *bodies.mesh();
  std::map<LocalOrdinal, Follower> followers;
  for (std::size_t p = 0; p < mesh.reference_points.size(); ++p)
    for (const LocalOrdinal node : mesh.reference_points[p].followers)
      for (int i = 0; i < mesh.dimension; ++i)
        if (node < mesh.owned_count() && !is_free(bodies, mesh.reference_points[p], node, i)) followers[bodies.space().row(node, i)] = {node, i, p};
  for (const ReferencePoint& point : mesh.reference_points)
    for (const LocalOrdinal node : {point.node, point.rotation_node})
      for (int i = 0; i < mesh.dimension && node >= 0 && node < mesh.owned_count(); ++i) followed_.push_back(bodies.space().row(node, i));
  for (const auto& [dof, follower] : followers) {
    dofs_.push_back(dof);
    followers_.push_back(follower);
  }
}

std::vector<Dependence> Followers::evaluate(const Vector& local_displacement) const {
  const Mesh& mesh = *bodies_.mesh();
  const FieldSpace& space = bodies_.space();
  const int dimension = mesh.dimension, turns = dimension == 2 ? 1 : 3;
  const HostReadView u(local_displacement);
  std::vector<Dependence> dependences(followers_.size());
  for (std::size_t n = 0; n < followers_.size(); ++n) {
    const auto [node, i, p] = followers_[n];
    const ReferencePoint& point = mesh.reference_points[p];
    Dependence& d = dependences[n];
    if (!is_followed(bodies_, point, i)) continue;
    d.source[0] = space.local_dofs()->getGlobalElement(space.row(point.node, i));
    d.gradient[0] = 1.0;
    d.value = u.data()[space.row(point.node, i)];
    d.sources = 1;
    if (point.rotation_node < 0) continue;
    Eigen::Vector3d theta = Eigen::Vector3d::Zero();
    for (int k = 0; k < turns; ++k) theta[dimension == 2 ? 2 : k] = u.data()[space.row(point.rotation_node, k)] / point.arm;
    const Eigen::Vector3d arm = Eigen::Vector3d(mesh.coordinates[node].data()) - Eigen::Vector3d(mesh.coordinates[point.node].data());
    const OfRotation turned = turn(theta, arm);
    d.value += turned.value[i] - arm[i];
    for (int k = 0; k < turns; ++k) {
      const int about = dimension == 2 ? 2 : k;
      d.source[1 + k] = space.local_dofs()->getGlobalElement(space.row(point.rotation_node, k));
      d.gradient[1 + k] = turned.gradient[about][i] / point.arm;
      for (int l = 0; l < turns; ++l) d.curvature[1 + k][1 + l] = turned.curvature[about][dimension == 2 ? 2 : l][i] / (point.arm * point.arm);
    }
    d.sources = 1 + turns;
  }
  return dependences;
}

std::vector<LocalOrdinal> Followers::idle_dofs(const Bodies& bodies) {
  const Mesh& mesh = *bodies.mesh();
  std::vector<LocalOrdinal> dofs;
  for (const ReferencePoint& point : mesh.reference_points) {
    if (point.node >= mesh.owned_count()) continue;
    for (int i = 0; i < mesh.dimension; ++i)
      if (!is_followed(bodies, point, i)) dofs.push_back(bodies.space().row(point.node, i));
    if (point.rotation_node >= 0 && mesh.dimension == 2) dofs.push_back(bodies.space().row(point.rotation_node, 1));
  }
  return dofs;
}

}  // namespace mortise
