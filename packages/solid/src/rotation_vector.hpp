#pragma once
// Turning by a rotation vector.

#include <Eigen/Core>
#include <array>

namespace mortise {

/// R(theta) x and its derivatives with respect to the components of theta.
struct Turned {
  Eigen::Vector3d value;
  std::array<Eigen::Vector3d, 3> gradient;
  std::array<std::array<Eigen::Vector3d, 3>, 3> curvature;
};

/// R turns by |theta| [radians] about the direction of theta (Rodrigues), for theta of any length, 0 included.
Turned turn(const Eigen::Vector3d& theta, const Eigen::Vector3d& x);

}  // namespace mortise
