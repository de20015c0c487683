#pragma once
// Quadrature on the reference cells.

#include <array>
#include <vector>

namespace mortise {

/// A point of a rule on a reference line, [-1, 1].
struct LinePoint {
  double xi = 0.0;      ///< in [-1, 1]
  double weight = 0.0;  ///< of [-1, 1], whose length is 2
};

/// Gauss-Legendre rule with `points` >= 1 points on [-1, 1], ascending; exact for polynomials of degree 2 points - 1.
/// Throws std::invalid_argument for points < 1.
std::vector<LinePoint> gauss_legendre(int points);

/// A point of a rule on a reference cell. The weights sum to the cell's reference length, area or volume.
struct CellPoint {
  std::array<double, 3> xi{};  ///< 0 beyond the cell's dimension
  double weight = 0.0;         ///< share of the reference length, area or volume

  /// The first coordinates, as the shape functions take them.
  template <int dimension>
  std::array<double, dimension> position() const {
    std::array<double, dimension> result{};
    for (int i = 0; i < dimension; ++i) result[i] = xi[i];
    return result;
  }
};

/// Tensor product of gauss_legendre(points_per_direction) on [-1, 1]^2, xi running first.
std::vector<CellPoint> quadrilateral_rule(int points_per_direction);

/// The same on [-1, 1]^3.
std::vector<CellPoint> hexahedron_rule(int points_per_direction);

/// Rule on the triangle (0,0), (1,0), (0,1) with interior points and positive weights: 1 point (exact for degree 1), 3 (degree 2), 7
/// (degree 5), 12 (degree 6).
/// Throws std::invalid_argument for any other number.
std::vector<CellPoint> triangle_rule(int points);

/// Rule on the tetrahedron (0,0,0), (1,0,0), (0,1,0), (0,0,1) with interior points and positive weights: 1 point (degree 1), 4 (degree 2), 15
/// (degree 5). Throws std::invalid_argument for any other number.
std::vector<CellPoint> tetrahedron_rule(int points);

/// Tensor product of triangle_rule(triangle_points) and gauss_legendre(line_points), the triangle running first: on (0,0), (1,0), (0,1) times [-1,
/// 1].
std::vector<CellPoint> wedge_rule(int triangle_points, int line_points);

/// Conical product rule on the pyramid |xi|, |eta| <= 1 - zeta, 0 <= zeta <= 1: with xi = u (1 - zeta), eta = v (1 - zeta) its volume is
/// (1 - zeta)^2 du dv dzeta. It has the points of quadrilateral_rule(points_per_direction) in (u, v) and, along zeta, `heights` points of the
/// Gauss-Jacobi rule for the weight (1 - zeta)^2: 1 or 2. Exact for f(u, v) of degree 2 points_per_direction - 1 in each, and for its products with
/// polynomials in zeta of degree 2 heights - 1.
/// Throws std::invalid_argument for any other number.
std::vector<CellPoint> pyramid_rule(int points_per_direction, int heights = 1);

}  // namespace mortise
