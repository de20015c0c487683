#include "mortise/solid/followers.hpp"

#include <Tpetra_Map.hpp>
#include <cmath>
#include <map>

#include "host_view.hpp"

namespace mortise {
namespace {

/// Radial motion and rotation would not leave a ring rigid: there, rigid bodies follow along the axis only.
bool is_followed(const Bodies& bodies, const ReferencePoint& point, int component) {
  return point.follows[component] && !(bodies.kinematics() == Kinematics::axisymmetric && component == 0);
}

/// Whether a follower's component is its own unknown.
bool is_free(const Bodies& bodies, const ReferencePoint& point, LocalOrdinal node, int component) {
  if (point.follows[component]) return false;
  return !bodies.properties()[bodies.mesh()->body_of_node[node]].is_rigid();
}

}  // namespace

Followers::Followers(const Bodies& bodies) : bodies_(bodies) {
  const Mesh& mesh = *bodies.mesh();
  std::map<LocalOrdinal, Follower> followers;
  for (std::size_t p = 0; p < mesh.reference_points.size(); ++p)
    for (const LocalOrdinal node : mesh.reference_points[p].followers)
      for (int i = 0; i < 2; ++i)
        if (node < mesh.owned_count() && !is_free(bodies, mesh.reference_points[p], node, i)) followers[2 * node + i] = {node, i, p};
  for (const ReferencePoint& point : mesh.reference_points)
    for (const LocalOrdinal node : {point.node, point.rotation_node})
      if (node >= 0 && node < mesh.owned_count()) followed_.insert(followed_.end(), {2 * node, 2 * node + 1});
  for (const auto& [dof, follower] : followers) {
    dofs_.push_back(dof);
    followers_.push_back(follower);
  }
}

// With theta the rotation of the point and (x, y) = X_i - X:
//   d_x = u_x + (cos(theta) - 1) x - sin(theta) y,   d_y = u_y + sin(theta) x + (cos(theta) - 1) y.
std::vector<Dependence> Followers::evaluate(const Vector& local_displacement) const {
  const Mesh& mesh = *bodies_.mesh();
  const HostReadView u(local_displacement);
  std::vector<Dependence> dependences(followers_.size());
  for (std::size_t n = 0; n < followers_.size(); ++n) {
    const auto [node, i, p] = followers_[n];
    const ReferencePoint& point = mesh.reference_points[p];
    Dependence& d = dependences[n];
    if (!is_followed(bodies_, point, i)) continue;
    d.source[0] = 2 * mesh.local_nodes->getGlobalElement(point.node) + i;
    d.gradient[0] = 1.0;
    d.value = u.data()[2 * point.node + i];
    d.sources = 1;
    if (point.rotation_node < 0) continue;
    const double theta = u.data()[2 * point.rotation_node] / point.arm, c = std::cos(theta), s = std::sin(theta);
    const double x = mesh.coordinates[node][0] - mesh.coordinates[point.node][0], y = mesh.coordinates[node][1] - mesh.coordinates[point.node][1];
    d.source[1] = 2 * mesh.local_nodes->getGlobalElement(point.rotation_node);
    d.value += i == 0 ? (c - 1.0) * x - s * y : s * x + (c - 1.0) * y;
    d.gradient[1] = (i == 0 ? -s * x - c * y : c * x - s * y) / point.arm;
    d.curvature[1][1] = (i == 0 ? -c * x + s * y : -s * x - c * y) / (point.arm * point.arm);
    d.sources = 2;
  }
  return dependences;
}

std::vector<LocalOrdinal> Followers::idle_dofs(const Bodies& bodies) {
  const Mesh& mesh = *bodies.mesh();
  std::vector<LocalOrdinal> dofs;
  for (const ReferencePoint& point : mesh.reference_points) {
    if (point.node >= mesh.owned_count()) continue;
    for (int i = 0; i < 2; ++i)
      if (!is_followed(bodies, point, i)) dofs.push_back(2 * point.node + i);
    if (point.rotation_node >= 0) dofs.push_back(2 * point.rotation_node + 1);
  }
  return dofs;
}

}  // namespace mortise
