#pragma once
// Drives a law along a path at one point.

#include <functional>
#include <vector>

#include "mortise/material/materials.hpp"
#include "mortise/material/point_path.hpp"

namespace mortise {

/// State of the point at the end of a step.
struct PointRecord {
  int step = 0;
  double time = 0.0;
  Matrix3 F;
  Matrix3 strain;     ///< 1/2 ln(F F^T); laws of small strain: sym(F - I)
  Matrix3 cauchy;     ///< sigma = tau / det F; laws of small strain know one stress
  Matrix3 kirchhoff;  ///< tau
  double equivalent_plastic_strain = 0.0;

  /// sqrt(3/2) |dev sigma|.
  double von_mises() const;
};

/// Takes the law through the points, one step each, and hands every state to `accepted`. Free stretches follow from tau_aa = 0 by Newton's method
/// with the law's tangent. Throws StepFailure, which names the step, if there are none or the law finds no stress.
void drive_point(const Law& law, const std::vector<PathPoint>& path, const std::function<void(const PointRecord&)>& accepted);

}  // namespace mortise
