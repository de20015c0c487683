#pragma once
// Rotation vectors: turning by them, and moments on them.

#include <Eigen/Core>
#include <array>

namespace mortise {

/// A vector that depends on a rotation vector theta, and its derivatives with respect to the components of theta.
struct OfRotation {
  Eigen::Vector3d value;
  std::array<Eigen::Vector3d, 3> gradient;
  std::array<std::array<Eigen::Vector3d, 3>, 3> curvature;
};

/// R(theta) x: R turns by |theta| [radians] about the direction of theta (Rodrigues), for theta of any length, 0 included.
OfRotation turn(const Eigen::Vector3d& theta, const Eigen::Vector3d& x);

/// T(theta), which turns the rates of the components into the spin about fixed axes: dR = [d omega]x R with d omega = T d theta. At full turns,
/// theta| = 2 pi, 4 pi, ..., it takes everything across theta to 0.
Eigen::Matrix3d spin(const Eigen::Vector3d& theta);

/// T(theta)^T m, by which a moment m about fixed axes works on the components of theta: m . d omega = T^T m . d theta.
OfRotation generalised_moment(const Eigen::Vector3d& theta, const Eigen::Vector3d& m);

/// Smallest |T(theta) v| of the unit vectors v that have the `free` components alone; 1 if there are none. With all of them 2 |sin(t/2)| / t, t =
/// |theta|.
double least_spin(const Eigen::Vector3d& theta, const std::array<bool, 3>& free);

/// Below this least_spin the free components do not say any more how to turn: what they balance is weighted by it.
constexpr double smallest_spin = 1e-4;

/// The moment m whose T(theta)^T m is `generalised`; not a number at full turns, unless that is 0.
Eigen::Vector3d spatial_moment(const Eigen::Vector3d& theta, const Eigen::Vector3d& generalised);

}  // namespace mortise
