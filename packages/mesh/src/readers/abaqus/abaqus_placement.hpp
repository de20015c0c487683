#pragma once
// Where an instance of a part is.

#include <array>

#include "readers/abaqus/abaqus_model.hpp"

namespace mortise {

/// x' = a + R (x + t - a): first the translation t, then the rotation by an angle about the axis from a to b. With the unit vector e along it and
/// y = x + t - a (Rodrigues):  R y = y cos + (e x y) sin + e (e . y)(1 - cos).
class AbaqusPlacement {
 public:
  /// @throws InputError if the rotation has no axis
  AbaqusPlacement(const AbaqusInstance& instance, const AbaqusLines& lines, FileErrors& errors);

  std::array<double, 3> operator()(const std::array<double, 3>& x) const;

 private:
  std::array<double, 3> translation_{}, point_{}, axis_{};
  double cosine_ = 1.0, sine_ = 0.0;
};

}  // namespace mortise
