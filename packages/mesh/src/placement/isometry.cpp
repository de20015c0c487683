#include "mortise/mesh/isometry.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>

namespace mortise {
namespace {

using RowMajor = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

Eigen::Map<const RowMajor> of(const Isometry& isometry) { return Eigen::Map<const RowMajor>(isometry.matrix[0].data()); }

Eigen::Vector3d of(const SpatialPoint& point) { return Eigen::Vector3d(point.data()); }

Isometry make(const RowMajor& matrix, const Eigen::Vector3d& translation) {
  Isometry result;
  Eigen::Map<RowMajor>(result.matrix[0].data()) = matrix;
  Eigen::Map<Eigen::Vector3d>(result.translation.data()) = translation;
  return result;
}

}  // namespace

SpatialPoint Isometry::operator()(const SpatialPoint& x) const {
  SpatialPoint result;
  Eigen::Map<Eigen::Vector3d>(result.data()) = of(*this) * of(x) + of(translation);
  return result;
}

bool Isometry::reflects() const { return of(*this).determinant() < 0.0; }

Isometry after(const Isometry& second, const Isometry& first) {
  return make(of(second) * of(first), of(second) * of(first.translation) + of(second.translation));
}

Isometry reflection(int direction) {
  Isometry result;
  result.matrix[direction][direction] = -1.0;
  return result;
}

Isometry rotation(double degrees, const SpatialPoint& axis, const SpatialPoint& point) {
  const RowMajor matrix = Eigen::AngleAxisd(degrees * EIGEN_PI / 180.0, of(axis).normalized()).toRotationMatrix();
  return make(matrix, of(point) - matrix * of(point));
}

}  // namespace mortise
