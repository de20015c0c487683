#pragma once
// Data of a point of an element: shape functions, gradients, deformation gradient, volume.

#include <Eigen/Dense>
#include <array>
#include <type_traits>

#include "mortise/material/tensor_components.hpp"
#include "mortise/shape/quadrature.hpp"
#include "mortise/solid/element_type.hpp"

namespace mortise {

template <class Cell, Kinematics kinematics>
struct ElementGeometry {
  static constexpr int nodes = Cell::nodes, dimension = Cell::dimension;
  static_assert(dimension == mortise::dimension(kinematics));
  static constexpr bool axisymmetric = kinematics == Kinematics::axisymmetric;

  using Positions = std::array<std::array<double, dimension>, nodes>;  ///< of the nodes, or their displacements

  /// Shape functions at a point of the reference cell.
  struct Shape {
    std::array<double, nodes> N;
    Positions gradient;  ///< dN_a / dxi
    double weight;
  };

  struct Point {
    std::array<double, nodes> N;
    Positions gradient;              ///< dN_a/dX, after push_forward dN_a/dx
    std::array<double, nodes> hoop;  ///< N_a/R, after push_forward N_a/r; axisymmetric only
    double weight;                   ///< reference volume
    Matrix3 F;
    double determinant;  ///< det F, hoop included
  };

  static Shape shape_at(const std::array<double, dimension>& xi, double weight) { return {Cell::values(xi), Cell::gradients(xi), weight}; }

  /// dX/dxi.
  static Eigen::Matrix<double, dimension, dimension> jacobian(const Shape& shape, const Positions& X) {
    Eigen::Matrix<double, dimension, dimension> J;
    J.setZero();
    for (int a = 0; a < nodes; ++a)
      for (int i = 0; i < dimension; ++i)
        for (int k = 0; k < dimension; ++k) J(i, k) += X[a][i] * shape.gradient[a][k];
    return J;
  }

  /// F = I + sum_a u_a x dN_a/dX, in 2D with F_33 = r / R where axisymmetric. `thickness` counts for 2D kinematics.
  static Point point(const Shape& shape, const Positions& X, const Positions& u, double thickness) {
    Point at;
    at.N = shape.N;
    at.F.setIdentity();
    const auto J = jacobian(shape, X);
    if constexpr (dimension == 3) {
      const Matrix3 inverse = J.inverse();
      at.gradient = times(shape.gradient, inverse);
      add_gradient(u, at);
      at.weight = shape.weight * J.determinant();
      at.determinant = at.F.determinant();
    } else {
      const double area = J(0, 0) * J(1, 1) - J(0, 1) * J(1, 0);
      for (int a = 0; a < nodes; ++a) {
        const auto& g = shape.gradient[a];
        at.gradient[a] = {(J(1, 1) * g[0] - J(1, 0) * g[1]) / area, (J(0, 0) * g[1] - J(0, 1) * g[0]) / area};
      }
      add_gradient(u, at);
      at.weight = shape.weight * area * add_hoop(shape, X, u, thickness, at);
      // A reversed meridian plane and a negative radius together would look like a positive volume.
      const double in_plane = at.F(0, 0) * at.F(1, 1) - at.F(0, 1) * at.F(1, 0);
      at.determinant = in_plane > 0.0 ? in_plane * at.F(2, 2) : in_plane;
    }
    return at;
  }

  /// dN/dx = dN/dX F^-1,  N/r = N/R / F_33.
  static void push_forward(Point& at) {
    if constexpr (dimension == 3) {
      const Matrix3 inverse = at.F.inverse();
      at.gradient = times(at.gradient, inverse);
    } else {
      const double in_plane = at.F(0, 0) * at.F(1, 1) - at.F(0, 1) * at.F(1, 0);
      for (int a = 0; a < nodes; ++a) {
        const std::array<double, 2> g = at.gradient[a];
        at.gradient[a] = {(g[0] * at.F(1, 1) - g[1] * at.F(1, 0)) / in_plane, (g[1] * at.F(0, 0) - g[0] * at.F(0, 1)) / in_plane};
        if constexpr (axisymmetric) at.hoop[a] /= at.F(2, 2);
      }
    }
  }

 private:
  /// The rows of `gradient` times a matrix, in 3D.
  static Positions times(const Positions& gradient, const Matrix3& matrix) {
    Positions result;
    for (int a = 0; a < nodes; ++a)
      for (int k = 0; k < 3; ++k) result[a][k] = gradient[a][0] * matrix(0, k) + gradient[a][1] * matrix(1, k) + gradient[a][2] * matrix(2, k);
    return result;
  }

  static void add_gradient(const Positions& u, Point& at) {
    for (int a = 0; a < nodes; ++a)
      for (int i = 0; i < dimension; ++i)
        for (int k = 0; k < dimension; ++k) at.F(i, k) += u[a][i] * at.gradient[a][k];
  }

  /// Puts in what the direction across the plane has; what is left is the factor that makes an area a volume.
  static double add_hoop([[maybe_unused]] const Shape& shape, [[maybe_unused]] const Positions& X, [[maybe_unused]] const Positions& u,
                         double thickness, Point& at) {
    if constexpr (axisymmetric) {
      double radius = 0.0, change = 0.0;
      for (int a = 0; a < nodes; ++a) {
        radius += shape.N[a] * X[a][0];
        change += shape.N[a] * u[a][0];
      }
      for (int a = 0; a < nodes; ++a) at.hoop[a] = shape.N[a] / radius;
      at.F(2, 2) += change / radius;
      return 2.0 * EIGEN_PI * radius;
    } else {
      at.hoop.fill(0.0);
      return thickness;
    }
  }
};

}  // namespace mortise
