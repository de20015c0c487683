#pragma once
// Reflected bodies and rows or rings of equal ones.

#include <optional>
#include <string>
#include <vector>

#include "mortise/core/parameters.hpp"
#include "mortise/mesh/isometry.hpp"

namespace mortise {

/// At which plane through the origin a body is reflected, after all that its mesh says of its place.
enum class Mirror { none, x, y, z };

/// Copies of a body, each one step from the last: turned about an axis, then moved.
struct PatternOptions {
  int copies = 1;                            ///< bodies in all
  int begin = 0;                             ///< steps from the mesh to the first of them
  std::vector<double> translation;           ///< of a step; empty: none
  double rotation = 0.0;                     ///< of a step, in degrees
  std::vector<double> axis{0.0, 0.0, 1.0};   ///< direction that it turns about
  std::vector<double> point{0.0, 0.0, 0.0};  ///< on that axis
  void describe(Parameters& parameters);
};

/// From the mesh to the first body of a pattern; none if it stays where it is.
std::optional<Isometry> placement(Mirror mirror, const PatternOptions& pattern);

}  // namespace mortise
