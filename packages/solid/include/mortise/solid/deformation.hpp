#pragma once
// The deformation at a point of an element.

#include <array>

#include "mortise/material/tensor_components.hpp"
#include "mortise/solid/element_points.hpp"

namespace mortise {

/// What mechanics reads of displacements: F = I + sum_a u_a x dN_a/dX, in 2D with F_33 = r / R where axisymmetric.
template <class Geometry>
struct Deformation {
  static constexpr int nodes = Geometry::nodes, dimension = Geometry::dimension, components = dimension;
  using Displacements = std::array<std::array<double, dimension>, nodes>;
  using Point = typename Geometry::Point;

  Matrix3 F;
  double determinant;  ///< det F, hoop included

  Deformation(const Point& at, const Displacements& u) {
    F.setIdentity();
    for (int a = 0; a < nodes; ++a)
      for (int i = 0; i < dimension; ++i)
        for (int k = 0; k < dimension; ++k) F(i, k) += u[a][i] * at.gradient[a][k];
    if constexpr (dimension == 3) {
      determinant = F.determinant();
    } else {
      if constexpr (Geometry::axisymmetric) {
        double change = 0.0;
        for (int a = 0; a < nodes; ++a) change += at.N[a] * u[a][0];
        F(2, 2) += change / at.radius;
      }
      // A reversed meridian plane and a negative radius together would look like a positive volume.
      const double in_plane = F(0, 0) * F(1, 1) - F(0, 1) * F(1, 0);
      determinant = in_plane > 0.0 ? in_plane * F(2, 2) : in_plane;
    }
  }

  /// Makes gradients of a point those of the current configuration: dN/dx = dN/dX F^-1,  N/r = N/R / F_33.
  void push_forward(Point& at) const {
    if constexpr (dimension == 3) {
      const Matrix3 inverse = F.inverse();
      at.gradient = Geometry::times(at.gradient, inverse);
    } else {
      const double in_plane = F(0, 0) * F(1, 1) - F(0, 1) * F(1, 0);
      for (int a = 0; a < nodes; ++a) {
        const std::array<double, 2> g = at.gradient[a];
        at.gradient[a] = {(g[0] * F(1, 1) - g[1] * F(1, 0)) / in_plane, (g[1] * F(0, 0) - g[0] * F(0, 1)) / in_plane};
        if constexpr (Geometry::axisymmetric) at.hoop[a] /= F(2, 2);
      }
    }
  }
};

}  // namespace mortise
