#pragma once
// Points of a study as curves from coarse to fine.

#include <string>
#include <vector>

#include "mortise/studies/study_points.hpp"

namespace mortise {

/// The points that differ in nothing but the value of the axis "along".
struct StudyCurve {
  std::string name;      ///< titles of the other axes, or what the scene is if there are none
  std::size_t base = 0;  ///< index of the curve with the first value of the axis "series" and otherwise this one's; its own if there is none
  std::vector<std::size_t> points;  ///< indices, in the order of the axis
};

std::vector<StudyCurve> study_curves(const StudyPlan& plan);

}  // namespace mortise
