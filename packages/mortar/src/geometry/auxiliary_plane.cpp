#include "mortise/mortar/auxiliary_plane.hpp"

#include <Eigen/Geometry>

#include "mortise/mortar/quadratic_facet.hpp"

namespace mortise {
namespace {

// [a]x b = a x b
Eigen::Matrix3d cross_matrix(const Eigen::Vector3d& a) {
  Eigen::Matrix3d matrix;
  matrix << 0.0, -a.z(), a.y(), a.z(), 0.0, -a.x(), -a.y(), a.x(), 0.0;
  return matrix;
}

}  // namespace

void AuxiliaryPlane::to_global(const std::vector<Eigen::Vector3d>& vectors, Eigen::Ref<Eigen::MatrixXd> gradients) const {
  // w x r = (dp_1 r_3, dp_2 r_3, -dp_1 r_1 - dp_2 r_2) for p = (0, 0, 1)
  Eigen::MatrixX2d of_plane = Eigen::MatrixX2d::Zero(gradients.rows(), 2);
  for (std::size_t n = 0; n < vectors.size(); ++n) {
    const auto block = gradients.middleCols<3>(3 * static_cast<Eigen::Index>(n));
    const Eigen::Vector3d& r = vectors[n];
    of_plane.col(0) += r[0] * block.col(2) - r[2] * block.col(0);
    of_plane.col(1) += r[1] * block.col(2) - r[2] * block.col(1);
  }
  for (std::size_t a = 0; a < facet_corners(3, slave.size()); ++a) {
    auto block = gradients.middleCols<3>(3 * static_cast<Eigen::Index>(a));
    for (int i = 0; i < 3; ++i) block.col(i) += tilt[a](0, i) * of_plane.col(0) + tilt[a](1, i) * of_plane.col(1);
  }
  Eigen::MatrixX3d turned(gradients.rows(), 3);
  for (std::size_t n = 0; n < vectors.size(); ++n) {
    auto block = gradients.middleCols<3>(3 * static_cast<Eigen::Index>(n));
    turned.noalias() = block.lazyProduct(frame);
    block = turned;
  }
}

std::optional<AuxiliaryPlane> make_auxiliary_plane(const FacetVectors& slave) {
  AuxiliaryPlane plane;
  const bool triangle = facet_corners(3, slave.size()) == 3;
  const Eigen::Vector3d first = triangle ? Eigen::Vector3d(slave[1] - slave[0]) : Eigen::Vector3d(slave[2] - slave[0]);
  const Eigen::Vector3d second = triangle ? Eigen::Vector3d(slave[2] - slave[0]) : Eigen::Vector3d(slave[3] - slave[1]);
  const Eigen::Vector3d c = first.cross(second);
  const double area = c.norm();
  if (!(area > 0.0)) return std::nullopt;
  plane.frame.row(2) = (c / area).transpose();
  plane.frame.row(0) = first.normalized().transpose();
  plane.frame.row(1) = plane.frame.row(2).cross(plane.frame.row(0));
  plane.origin.setZero();
  for (const Eigen::Vector3d& x : slave) plane.origin += x / static_cast<double>(slave.size());
  for (const Eigen::Vector3d& x : slave) plane.slave.push_back(plane.to_frame(x));
  for (const FacetPart& part : linear_parts(3, slave.size()))
    if (!shows_side(part_of(plane.slave, part), 1.0, 0.0)) return std::nullopt;

  // dp = (I - p p^T) dc / |c|,   dc = -[second]x dfirst + [first]x dsecond
  const Eigen::Matrix<double, 2, 3> of_first = -cross_matrix(plane.frame * second).topRows<2>() / area;
  const Eigen::Matrix<double, 2, 3> of_second = cross_matrix(plane.frame * first).topRows<2>() / area;
  if (triangle)
    plane.tilt = {Eigen::Matrix<double, 2, 3>(-of_first - of_second), of_first, of_second};
  else
    plane.tilt = {Eigen::Matrix<double, 2, 3>(-of_first), Eigen::Matrix<double, 2, 3>(-of_second), of_first, of_second};
  return plane;
}

bool shows_side(const FacetVectors& in_frame, double side, double tolerance) {
  const std::size_t count = in_frame.size();
  for (std::size_t a = 0; a < count; ++a) {
    const Eigen::Vector3d next = in_frame[(a + 1) % count] - in_frame[a], previous = in_frame[(a + count - 1) % count] - in_frame[a];
    const Eigen::Vector3d corner = next.cross(previous);
    if (!(side * corner.z() > tolerance * corner.norm())) return false;
  }
  return true;
}

}  // namespace mortise
