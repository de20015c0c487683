#pragma once
// Radon's 7 point rule on a triangle, exact for degree 5.

#include <array>
#include <cmath>

namespace mortise {

/// A point by its shares of the triangle's vertices; the weights sum to 1/2.
struct TrianglePoint {
  std::array<double, 3> share;
  double weight;
};

inline const std::array<TrianglePoint, 7>& radon_rule() {
  static const std::array<TrianglePoint, 7> rule = [] {
    const double root = std::sqrt(15.0), a = (6.0 - root) / 21.0, b = (6.0 + root) / 21.0;
    const double of_a = (155.0 - root) / 2400.0, of_b = (155.0 + root) / 2400.0, third = 1.0 / 3.0;
    return std::array<TrianglePoint, 7>{{{{third, third, third}, 9.0 / 80.0},
                                         {{a, a, 1.0 - 2.0 * a}, of_a},
                                         {{a, 1.0 - 2.0 * a, a}, of_a},
                                         {{1.0 - 2.0 * a, a, a}, of_a},
                                         {{b, b, 1.0 - 2.0 * b}, of_b},
                                         {{b, 1.0 - 2.0 * b, b}, of_b},
                                         {{1.0 - 2.0 * b, b, b}, of_b}}};
  }();
  return rule;
}

}  // namespace mortise
