#include "mortise/simulation/run/diagnosis/body_motion.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <cmath>

#include "mortise/core/over_ranks.hpp"
#include "mortise/solid/rotation_vector.hpp"

namespace mortise {
namespace {

using Eigen::Vector3d;

/// w of least size with I w = m: about the line of collinear nodes there is none.
Vector3d solve_rotation(const Eigen::Matrix3d& inertia, const Vector3d& moment) {
  constexpr double collinear = 1e-12;  // of the largest moment of inertia
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(inertia);
  Vector3d w = Vector3d::Zero();
  for (int i = 0; i < 3; ++i)
    if (const double value = solver.eigenvalues()[i]; value > collinear * solver.eigenvalues()[2])
      w += solver.eigenvectors().col(i).dot(moment) / value * solver.eigenvectors().col(i);
  return w;
}

void set_translation(const RigidModes& modes, int b, const Vector3d& t, Eigen::VectorXd& motion) {
  if (modes.axisymmetric())
    motion[b] = t.y();
  else
    motion.segment(modes.per_body() * b, modes.dimension()) = t.head(modes.dimension());
}

void set_rotation(const RigidModes& modes, int b, const Vector3d& w, Eigen::VectorXd& motion) {
  const int first = modes.per_body() * b + modes.dimension();
  if (modes.rotations() == 1) motion[first] = w.z() * modes.size(b);
  if (modes.rotations() == 3) motion.segment<3>(first) = w * modes.size(b);
}

}  // namespace

Vector3d rotation_of(const RigidModes& modes, const Eigen::VectorXd& motion, int b) {
  const int first = modes.per_body() * b + modes.dimension();
  if (modes.rotations() == 0) return Vector3d::Zero();
  return (modes.rotations() == 1 ? Vector3d(0.0, 0.0, motion[first]) : Vector3d(motion.segment<3>(first))) / modes.size(b);
}

Vector3d motion_at(const RigidModes& modes, const Eigen::VectorXd& motion, int b, const Vector3d& middle, const Vector3d& x) {
  if (modes.axisymmetric()) return {0.0, motion[b], 0.0};
  Vector3d t = Vector3d::Zero();
  t.head(modes.dimension()) = motion.segment(modes.per_body() * b, modes.dimension());
  return t + rotation_of(modes, motion, b).cross(x - middle);
}

BodyMotions body_motions(const FieldSpace& space, const RigidModes& modes, const NodePlaces& before, const NodePlaces& after,
                         const Supports& supports) {
  const Mesh& mesh = *space.mesh();
  const std::size_t bodies = modes.bodies().size();
  const auto each_node = [&](const auto& visit) {
    for (LocalOrdinal node = 0; node < mesh.owned_body_count(); ++node)
      if (const int b = modes.number(mesh.body_of_node[node]); b >= 0)
        visit(static_cast<std::size_t>(b), Vector3d(0.5 * (before.x[node] + after.x[node])), Vector3d(after.x[node] - before.x[node]));
  };

  // Means of the positions half way and of the motions, then moments about them.
  std::vector<double> means(7 * bodies, 0.0);
  each_node([&](std::size_t b, const Vector3d& x, const Vector3d& u) {
    means[7 * b] += 1.0;
    for (int i = 0; i < 3; ++i) means[7 * b + 1 + i] += x[i], means[7 * b + 4 + i] += u[i];
  });
  means = sum_over_ranks(*mesh.comm, means);
  std::vector<Vector3d> position(bodies), translation(bodies);
  for (std::size_t b = 0; b < bodies; ++b) {
    position[b] = Vector3d(&means[7 * b + 1]) / means[7 * b];
    translation[b] = Vector3d(&means[7 * b + 4]) / means[7 * b];
  }
  std::vector<double> moments(12 * bodies, 0.0);
  each_node([&](std::size_t b, const Vector3d& x, const Vector3d& u) {
    const Vector3d arm = x - position[b];
    Eigen::Map<Eigen::Matrix3d>(&moments[12 * b]) += arm.squaredNorm() * Eigen::Matrix3d::Identity() - arm * arm.transpose();
    Eigen::Map<Vector3d>(&moments[12 * b + 9]) += arm.cross(u - translation[b]);
  });
  moments = sum_over_ranks(*mesh.comm, moments);

  BodyMotions result;
  result.rigid = Eigen::VectorXd::Zero(modes.count());
  for (std::size_t b = 0; b < bodies; ++b) {
    const int n = static_cast<int>(b);
    const Eigen::Matrix3d inertia = Eigen::Map<const Eigen::Matrix3d>(&moments[12 * b]);
    const Vector3d moment(&moments[12 * b + 9]);
    Vector3d w = Vector3d::Zero();
    if (modes.rotations() == 1 && inertia(2, 2) > 0.0) w.z() = moment.z() / inertia(2, 2);
    if (modes.rotations() == 3) w = solve_rotation(inertia, moment);
    set_rotation(modes, n, w, result.rigid);
    set_translation(modes, n, translation[b] + w.cross(modes.centre(n) - position[b] - 0.5 * translation[b]), result.rigid);
    result.middle.emplace_back(modes.centre(n) - 0.5 * translation[b]);
  }

  std::vector<double> mine(bodies + 1, 0.0);
  each_node([&](std::size_t b, const Vector3d& x, const Vector3d& u) {
    const Vector3d left = u - motion_at(modes, result.rigid, static_cast<int>(b), result.middle[b], x);
    mine[b] = std::max(mine[b], left.norm());
  });
  for (LocalOrdinal node = 0; node < mesh.owned_count(); ++node)
    if (modes.number(mesh.body_of_node[node]) < 0) mine.back() = std::max(mine.back(), (after.x[node] - before.x[node]).norm());
  for (const LocalOrdinal dof : supports.prescribed) {
    const FieldPlace at = space.place(dof);
    mine.back() = std::max(mine.back(), std::abs(after.x[at.node][at.component] - before.x[at.node][at.component]));
  }
  for (const InclinedComponent& component : supports.inclined) {
    const LocalOrdinal node = component.node;
    const Vector3d along(direction_of(component).data());
    mine.back() = std::max(mine.back(), std::abs(along.dot(after.x[node] - before.x[node])));
  }
  std::vector<double> all = most_over_ranks(*mesh.comm, mine);
  result.imposed = all.back();
  all.pop_back();
  result.deformation = std::move(all);
  return result;
}

void move_bodies(const FieldSpace& space, const RigidModes& modes, const Eigen::VectorXd& motion, const std::vector<Eigen::Vector3d>& middle,
                 const NodePlaces& half_way, double factor, Vector& d) {
  const Mesh& mesh = *space.mesh();
  const auto v = d.getLocalViewHost(Tpetra::Access::ReadWrite);
  std::vector<char> turns(static_cast<std::size_t>(mesh.owned_count()), 0);
  for (std::size_t p = 0; p < mesh.reference_points.size(); ++p) {
    const ReferencePoint& point = mesh.reference_points[p];
    const LocalOrdinal node = point.rotation_node;
    if (node < 0 || node >= mesh.owned_count()) continue;
    turns[node] = 1;
    const int b = modes.number(mesh.body_of_node[node]);
    if (b < 0) continue;
    const Vector3d rotation = factor * rotation_of(modes, motion, b);
    if (mesh.dimension == 2) {
      v(space.row(node, 0), 0) += point.arm * rotation.z();
      continue;
    }
    const Vector3d components = spin(half_way.turned[p]).fullPivLu().solve(rotation);
    for (int i = 0; i < 3; ++i) v(space.row(node, i), 0) += point.arm * components[i];
  }
  for (LocalOrdinal node = 0; node < mesh.owned_count(); ++node) {
    const int b = modes.number(mesh.body_of_node[node]);
    if (b < 0 || turns[node]) continue;
    const Vector3d at_node = motion_at(modes, motion, b, middle[b], half_way.x[node]);
    for (int i = 0; i < mesh.dimension; ++i) v(space.row(node, i), 0) += factor * at_node[i];
  }
}

}  // namespace mortise
