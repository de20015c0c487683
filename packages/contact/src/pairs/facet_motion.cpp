#include "pairs/facet_motion.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>

namespace mortise::detail {
namespace {

/// b_ik of a_i = sum_k b_ik x_k: the edge of a line, two edges of a triangle, the middle lines of a quadrilateral.
double share(std::size_t corners, std::size_t along, std::size_t corner) {
  constexpr double line[2] = {-1.0, 1.0}, triangle[2][3] = {{-1.0, 1.0, 0.0}, {-1.0, 0.0, 1.0}},
                   quadrilateral[2][4] = {{-0.5, 0.5, 0.5, -0.5}, {-0.5, -0.5, 0.5, 0.5}};
  return corners == 2 ? line[corner] : corners == 3 ? triangle[along][corner] : quadrilateral[along][corner];
}

SpatialMatrix cross_matrix(const Eigen::Vector3d& v) {
  return (Eigen::Matrix3d() << 0.0, -v.z(), v.y(), v.z(), 0.0, -v.x(), -v.y(), v.x(), 0.0).finished();
}

/// (a_i, nu); `turn` gets d nu / d a_i. In 2D nu = J a / |a|, in 3D a_1 x a_2 over its length.
SpatialMatrix frame_of(const std::vector<SpatialVector>& corners, std::vector<SpatialMatrix>& turn) {
  const Eigen::Index dimension = corners[0].size();
  SpatialMatrix frame = SpatialMatrix::Zero(dimension, dimension);
  for (Eigen::Index i = 0; i + 1 < dimension; ++i)
    for (std::size_t k = 0; k < corners.size(); ++k) frame.col(i) += share(corners.size(), static_cast<std::size_t>(i), k) * corners[k];
  if (dimension == 2) {
    const SpatialMatrix J = (SpatialMatrix(2, 2) << 0.0, -1.0, 1.0, 0.0).finished();
    const double length = frame.col(0).norm();
    const SpatialVector along = frame.col(0) / length;
    frame.col(1) = J * along;
    turn = {J * (SpatialMatrix::Identity(2, 2) - along * along.transpose()) / length};
    return frame;
  }
  const Eigen::Vector3d first = frame.col(0), second = frame.col(1), across = first.cross(second);
  const double area = across.norm();
  const Eigen::Vector3d normal = across / area;
  frame.col(2) = normal;
  const Eigen::Matrix3d shared = (Eigen::Matrix3d::Identity() - normal * normal.transpose()) / area;
  turn = {-shared * cross_matrix(second), shared * cross_matrix(first)};
  return frame;
}

}  // namespace

FacetMotion::FacetMotion(const std::vector<SpatialVector>& start, const std::vector<SpatialVector>& now) : corners_(now.size()) {
  inverse_start_ = frame_of(start, turn_).inverse();
  carried_ = frame_of(now, turn_) * inverse_start_;
}

// With the components w = B_0^-1 W, which do not move,  d(B w) = sum_i (w_i I + w_nu dnu/da_i) da_i.
SpatialMatrix FacetMotion::slope(std::size_t corner, const SpatialVector& W) const {
  const SpatialVector components = inverse_start_ * W;
  const Eigen::Index dimension = W.size();
  SpatialMatrix result = SpatialMatrix::Zero(dimension, dimension);
  for (Eigen::Index i = 0; i + 1 < dimension; ++i)
    result += share(corners_, static_cast<std::size_t>(i), corner) *
              (components[i] * SpatialMatrix::Identity(dimension, dimension) + components[dimension - 1] * turn_[static_cast<std::size_t>(i)]);
  return result;
}

}  // namespace mortise::detail
