#include "readers/abaqus/abaqus_placement.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace mortise {

AbaqusPlacement::AbaqusPlacement(const AbaqusInstance& instance, const AbaqusLines& lines, FileErrors& errors) {
  std::copy(instance.translation.begin(), instance.translation.end(), translation_.begin());
  if (instance.rotation.empty()) return;
  for (std::size_t i = 0; i < 3; ++i) {
    point_[i] = instance.rotation[i];
    axis_[i] = instance.rotation[3 + i] - instance.rotation[i];
  }
  const double length = std::hypot(axis_[0], axis_[1], axis_[2]);
  if (!(length > 0.0) || !std::isfinite(length))
    errors.stop(lines.place(instance.spot), fmt::format("instance {}: the two points of the axis of its rotation are the same", instance.name));
  for (double& component : axis_) component /= length;
  const double angle = instance.rotation[6] * std::acos(-1.0) / 180.0;
  cosine_ = std::cos(angle);
  sine_ = std::sin(angle);
}

std::array<double, 3> AbaqusPlacement::operator()(const std::array<double, 3>& x) const {
  std::array<double, 3> y, moved;
  for (std::size_t i = 0; i < 3; ++i) y[i] = x[i] + translation_[i] - point_[i];
  const double along = axis_[0] * y[0] + axis_[1] * y[1] + axis_[2] * y[2];
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    moved[i] = point_[i] + y[i] * cosine_ + (axis_[j] * y[k] - axis_[k] * y[j]) * sine_ + axis_[i] * along * (1.0 - cosine_);
  }
  return moved;
}

}  // namespace mortise
