#include "mortise/simulation/model/rigid_modes.hpp"

#include <Eigen/Geometry>
#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <limits>

#include "model/rigid_mode_names.hpp"

namespace mortise {

NodePlaces node_places(const Mesh& mesh) {
  NodePlaces at{std::vector<Eigen::Vector3d>(static_cast<std::size_t>(mesh.owned_count())),
                std::vector<Eigen::Vector3d>(mesh.reference_points.size(), Eigen::Vector3d::Zero())};
  for (std::size_t node = 0; node < at.x.size(); ++node) at.x[node] = Eigen::Vector3d(mesh.coordinates[node].data());
  return at;
}

NodePlaces node_places(const FieldSpace& space, const Vector& displacement) {
  const Mesh& mesh = *space.mesh();
  NodePlaces at = node_places(mesh);
  const auto u = displacement.getLocalViewHost(Tpetra::Access::ReadOnly);
  for (LocalOrdinal node = 0; node < mesh.owned_count(); ++node)
    for (int i = 0; i < mesh.dimension; ++i) at.x[static_cast<std::size_t>(node)][i] += u(space.row(node, i), 0);
  for (std::size_t p = 0; p < at.turned.size(); ++p) {
    const ReferencePoint& point = mesh.reference_points[p];
    if (point.rotation_node < 0 || point.rotation_node >= mesh.owned_count()) continue;
    if (mesh.dimension == 2)
      at.turned[p].z() = u(space.row(point.rotation_node, 0), 0) / point.arm;
    else
      for (int i = 0; i < 3; ++i) at.turned[p][i] = u(space.row(point.rotation_node, i), 0) / point.arm;
  }
  return at;
}

RigidModes::RigidModes(const Mesh& mesh, bool axisymmetric, std::vector<int> bodies, const std::vector<Eigen::Vector3d>& x)
    : axisymmetric_(axisymmetric), dimension_(mesh.dimension), bodies_(std::move(bodies)), number_(mesh.bodies.size(), -1) {
  for (std::size_t b = 0; b < bodies_.size(); ++b) number_[bodies_[b]] = static_cast<int>(b);
  // Bounding boxes over all ranks: the largest of (x, y, z, -x, -y, -z).
  std::vector<double> mine(6 * bodies_.size(), -std::numeric_limits<double>::max()), all(mine.size());
  for (LocalOrdinal node = 0; node < mesh.owned_body_count(); ++node) {
    const int b = number_[mesh.body_of_node[node]];
    if (b < 0) continue;
    double* box = &mine[6 * b];
    for (int i = 0; i < 3; ++i) {
      box[i] = std::max(box[i], x[node][i]);
      box[3 + i] = std::max(box[3 + i], -x[node][i]);
    }
  }
  Teuchos::reduceAll(*mesh.comm, Teuchos::REDUCE_MAX, static_cast<int>(mine.size()), mine.data(), all.data());
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    const Eigen::Vector3d high(&all[6 * b]), low = -Eigen::Vector3d(&all[6 * b + 3]);
    centres_.emplace_back(0.5 * (low + high));
    sizes_.push_back(std::max(0.5 * (high - low).norm(), std::numeric_limits<double>::min()));
  }
}

const char* RigidModes::name(int mode) const { return rigid_mode_name(dimension_, axisymmetric_, mode); }

Eigen::RowVectorXd RigidModes::works_of_wrench(const Eigen::Vector3d& force, const Eigen::Vector3d& moment) const {
  Eigen::RowVectorXd works(per_body());
  if (axisymmetric_)
    works << force.y();
  else if (dimension_ == 2)
    works << force.x(), force.y(), moment.z();
  else
    works << force.transpose(), moment.transpose();
  return works;
}

void RigidModes::add_wrench(int b, const Eigen::Vector3d& force, const Eigen::Vector3d& moment, Eigen::RowVectorXd& row) const {
  row.segment(per_body() * b, per_body()) += works_of_wrench(force, moment);
}

void RigidModes::add(int body, const Eigen::Vector3d& x, const Eigen::Vector3d& direction, Eigen::RowVectorXd& row) const {
  const int b = number_[body];
  if (b < 0) return;
  const Eigen::Vector3d arm = (x - centres_[b]) / sizes_[b];
  add_wrench(b, direction, arm.cross(direction), row);
}

void RigidModes::add_rotation(int body, const Eigen::Vector3d& axis, Eigen::RowVectorXd& row) const {
  if (number_[body] >= 0) add_wrench(number_[body], Eigen::Vector3d::Zero(), axis, row);
}

}  // namespace mortise
