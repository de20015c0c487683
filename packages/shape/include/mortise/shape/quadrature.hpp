#pragma once
// Quadrature on the reference cells.

#include <array>
#include <vector>

#include "mortise/shape/cell.hpp"

namespace mortise {

/// A point of a rule on a reference line, [-1, 1].
struct LinePoint {
  double xi = 0.0;
  double weight = 0.0;
};

/// Gauss-Legendre rule with `points` >= 1 points on [-1, 1], ascending; exact for polynomials of degree 2 points - 1.
/// Throws std::invalid_argument for points < 1.
std::vector<LinePoint> gauss_legendre(int points);

/// A point of a rule on a reference cell. The weights sum to the cell's reference area.
struct CellPoint {
  std::array<double, 2> xi{};
  double weight = 0.0;
};

/// Tensor product of gauss_legendre(points_per_direction) on [-1, 1]^2, xi running first.
std::vector<CellPoint> quadrilateral_rule(int points_per_direction);

/// Rule on the triangle (0,0), (1,0), (0,1): 1 point (exact for degree 1) or 3 interior points (degree 2).
/// Throws std::invalid_argument for any other number.
std::vector<CellPoint> triangle_rule(int points);

/// The rule that integrates the stiffness of a `shape`'s undistorted cell exactly: 2 x 2 for quadrilaterals, 1 point for triangles.
std::vector<CellPoint> full_rule(CellShape shape);

}  // namespace mortise
