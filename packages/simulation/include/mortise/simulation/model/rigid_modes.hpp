#pragma once
// The rigid motions that bodies have, as numbers: what forces on them see of these motions.

#include <Eigen/Core>
#include <vector>

#include "mortise/core/types.hpp"
#include "mortise/mesh/field_space.hpp"
#include "mortise/mesh/mesh.hpp"

namespace mortise {

/// Where a mesh is.
struct NodePlaces {
  std::vector<Eigen::Vector3d> x;       ///< [owned nodes] positions; z = 0 in 2D
  std::vector<Eigen::Vector3d> turned;  ///< [reference points] rotation vectors, of points that this rank owns; else 0
};

/// Of the reference configuration.
NodePlaces node_places(const Mesh& mesh);
/// Of the mesh displaced; `displacement` is on the owned dofs.
NodePlaces node_places(const FieldSpace& space, const Vector& displacement);

/// Rigid motions of some bodies at one configuration. Motion m of the body bodies()[b] has the number per_body() b + m. Axisymmetric: the translation
/// along the axis; 2D: two translations and the rotation about centre(b), times size(b); 3D: three of each. So all are lengths.
class RigidModes {
 public:
  /// Collective. `bodies` are mesh.bodies indices.
  RigidModes(const Mesh& mesh, bool axisymmetric, std::vector<int> bodies, const std::vector<Eigen::Vector3d>& x);

  int dimension() const { return dimension_; }
  bool axisymmetric() const { return axisymmetric_; }
  int per_body() const { return axisymmetric_ ? 1 : dimension_ == 2 ? 3 : 6; }
  int rotations() const { return axisymmetric_ ? 0 : dimension_ == 2 ? 1 : 3; }
  int count() const { return per_body() * static_cast<int>(bodies_.size()); }
  const std::vector<int>& bodies() const { return bodies_; }
  /// The place of a body in bodies(), -1: not there.
  int number(int body) const { return number_[body]; }
  const char* name(int mode) const;

  /// Middle of the box around bodies()[b], and half of its diagonal, above 0.
  const Eigen::Vector3d& centre(int b) const { return centres_[b]; }
  double size(int b) const { return sizes_[b]; }

  /// [per_body()] Work of a force, and of a moment over the size, about the centre of a body.
  Eigen::RowVectorXd works_of_wrench(const Eigen::Vector3d& force, const Eigen::Vector3d& moment) const;
  /// row += work of a force, and of a moment over the size, about the centre of bodies()[b].
  void add_wrench(int b, const Eigen::Vector3d& force, const Eigen::Vector3d& moment, Eigen::RowVectorXd& row) const;
  /// row += direction . motions of a body at x; nothing for a body that is not in bodies().
  void add(int body, const Eigen::Vector3d& x, const Eigen::Vector3d& direction, Eigen::RowVectorXd& row) const;
  /// row += rotation of a body about `axis`; nothing for a body that is not in bodies().
  void add_rotation(int body, const Eigen::Vector3d& axis, Eigen::RowVectorXd& row) const;

 private:
  bool axisymmetric_;
  int dimension_;
  std::vector<int> bodies_, number_;
  std::vector<Eigen::Vector3d> centres_;
  std::vector<double> sizes_;
};

}  // namespace mortise
