#pragma once
// Names of the rigid motions of bodies, for people.

#include <Eigen/Core>
#include <utility>
#include <vector>

namespace mortise {

/// Mode of a body. Axisymmetric: the translation along the axis; plane: two translations and the rotation; space: three of each.
const char* rigid_mode_name(int dimension, bool axisymmetric, int mode);

/// Motions to name, as many as `motions` has columns. One at a time, the mode of a body with the greatest part in what is left of them is named and
/// taken out.
/// @param motions  [per_body * bodies x motions] orthonormal columns; mode m of body b stands in row per_body * b + m
/// @returns body and mode of each
std::vector<std::pair<int, int>> distinct_modes(Eigen::MatrixXd motions, int per_body);

}  // namespace mortise
