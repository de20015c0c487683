#pragma once
// What has no meaning at a point of an element.

#include <array>

#include "elements/thermal_block.hpp"

namespace mortise {

/// Why an element has no residual.
struct HeatTrouble {
  enum class Kind { none, inverted, conductivity, specific_heat, source };
  Kind kind = Kind::none;
  double value = 0.0;  ///< det F, k, c or R
  double temperature = 0.0;
  std::array<double, 3> position{};  ///< of the reference configuration
  explicit operator bool() const { return kind != Kind::none; }
};

/// The same with body, element and what is allowed.
StepFailure failure_of(const HeatTrouble& trouble, const ThermalBlockContext& context, LocalOrdinal element, double time);

/// sum_a N_a X_a.
template <class Points, class Point>
std::array<double, 3> position_of(const Points& points, const Point& at) {
  std::array<double, 3> result{};
  const auto& X = points.positions();
  for (std::size_t a = 0; a < X.size(); ++a)
    for (std::size_t i = 0; i < X[a].size(); ++i) result[i] += at.N[a] * X[a][i];
  return result;
}

}  // namespace mortise
