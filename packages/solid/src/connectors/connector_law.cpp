#include "mortise/solid/connector_law.hpp"

namespace mortise {

using Eigen::Matrix3d;
using Eigen::Vector3d;

ConnectorForce ConnectorLaw::spring(const Vector3d& start, const Vector3d& motion) const {
  ConnectorForce result;
  if (!is_axial) {
    result.force = components.cwiseProduct(motion);
    result.by_motion = components.asDiagonal();
    result.energy = 0.5 * result.force.dot(motion);
    return result;
  }
  const Vector3d line = start + motion;
  const double length = line.norm();
  const Vector3d n = line / length;
  result.elongation = length - rest_length;
  result.along = axial * result.elongation;
  result.force = result.along * n;
  result.by_motion = axial * n * n.transpose() + result.along / length * (Matrix3d::Identity() - n * n.transpose());
  result.energy = 0.5 * result.along * result.elongation;
  return result;
}

ConnectorForce ConnectorLaw::dashpot(const Vector3d& start, const Vector3d& motion, const Vector3d& velocity) const {
  ConnectorForce result;
  if (!is_axial) {
    result.force = components.cwiseProduct(velocity);
    result.by_velocity = components.asDiagonal();
    return result;
  }
  const Vector3d line = start + motion;
  const double length = line.norm();
  const Vector3d n = line / length;
  const Matrix3d P = Matrix3d::Identity() - n * n.transpose();
  result.elongation = length - start.norm();
  result.along = axial * n.dot(velocity);
  result.force = result.along * n;
  result.by_velocity = axial * n * n.transpose();
  result.by_motion = axial / length * (n.dot(velocity) * P + n * (P * velocity).transpose());
  return result;
}

}  // namespace mortise
