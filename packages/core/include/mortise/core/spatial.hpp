#pragma once
// Vectors and matrices in 2D or 3D, by the model's dimension. They live on the stack.

#include <Eigen/Core>

namespace mortise {

/// Two or three components.
using SpatialVector = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, 3, 1>;
using SpatialMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, 3, 3>;

}  // namespace mortise
