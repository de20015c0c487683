#pragma once
// The points of an element: shape functions, gradients, volumes and the values of fields there.

#include <Eigen/Dense>
#include <array>
#include <cstddef>
#include <tuple>
#include <utility>

#include "mortise/shape/quadrature.hpp"

namespace mortise {

/// The reference configuration of a kind of cell. In 2D the direction across the plane has a thickness, or the cells turn about the axis.
template <class CellType, bool is_axisymmetric = false>
struct ElementGeometry {
  using Cell = CellType;
  static constexpr int nodes = Cell::nodes, dimension = Cell::dimension;
  static constexpr bool axisymmetric = is_axisymmetric;
  static_assert(!axisymmetric || dimension == 2);
  /// Points of the rule that is exact for the stiffness of undistorted cells. Axisymmetric triangles need more for radii and hoop strains: with one
  /// point, the hoop strain of linear ones leaves a mode without stiffness.
  static constexpr int stiffness_points = [] {
    if constexpr (axisymmetric)
      return Cell::axisymmetric_stiffness_points;
    else
      return Cell::stiffness_points;
  }();
  /// Points of the rule that is exact for products of two shape functions on undistorted cells.
  static constexpr int mass_points = [] {
    if constexpr (axisymmetric)
      return Cell::axisymmetric_mass_points;
    else
      return Cell::mass_points;
  }();

  using Positions = std::array<std::array<double, dimension>, nodes>;  ///< of the nodes

  /// Shape functions at a point of the reference cell.
  struct Shape {
    std::array<double, nodes> N;
    Positions gradient;  ///< dN_a / dxi
    double weight;
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

  /// The rows of `gradient` times a matrix, in 3D.
  static Positions times(const Positions& gradient, const Eigen::Matrix3d& matrix) {
    Positions result;
    for (int a = 0; a < nodes; ++a)
      for (int k = 0; k < 3; ++k) result[a][k] = gradient[a][0] * matrix(0, k) + gradient[a][1] * matrix(1, k) + gradient[a][2] * matrix(2, k);
    return result;
  }

  /// Shape functions at a point of an element.
  struct Point {
    std::array<double, nodes> N;
    Positions gradient;              ///< dN_a/dX
    std::array<double, nodes> hoop;  ///< N_a/R; axisymmetric only, else 0 in 2D
    double radius;                   ///< R; axisymmetric only
    double weight;                   ///< reference volume

    /// `thickness` counts for plane cells that do not turn about an axis.
    Point(const Shape& shape, const Positions& X, double thickness) : N(shape.N) {
      const auto J = jacobian(shape, X);
      if constexpr (dimension == 3) {
        const Eigen::Matrix3d inverse = J.inverse();
        gradient = times(shape.gradient, inverse);
        weight = shape.weight * J.determinant();
      } else {
        const double area = J(0, 0) * J(1, 1) - J(0, 1) * J(1, 0);
        for (int a = 0; a < nodes; ++a) {
          const auto& g = shape.gradient[a];
          gradient[a] = {(J(1, 1) * g[0] - J(1, 0) * g[1]) / area, (J(0, 0) * g[1] - J(0, 1) * g[0]) / area};
        }
        weight = shape.weight * area * depth(X, thickness);
      }
    }

   private:
    /// Sets what the direction across the plane has; returns the factor that makes an area a volume.
    double depth([[maybe_unused]] const Positions& X, double thickness) {
      if constexpr (axisymmetric) {
        radius = 0.0;
        for (int a = 0; a < nodes; ++a) radius += N[a] * X[a][0];
        for (int a = 0; a < nodes; ++a) hoop[a] = N[a] / radius;
        return 2.0 * EIGEN_PI * radius;
      } else {
        hoop.fill(0.0);
        return thickness;
      }
    }
  };
};

/// The value of a field with so many components at a point: sum_a N_a v_a.
template <int field_components>
struct FieldValue {
  static constexpr int components = field_components;
  std::array<double, components> value{};

  template <class Point, class NodalValues>
  FieldValue(const Point& at, const NodalValues& v) {
    for (std::size_t a = 0; a < v.size(); ++a)
      for (int i = 0; i < components; ++i) value[i] += at.N[a] * v[a][i];
  }
};

/// The gradient of a field at a point: sum_a v_a x dN_a/dX.
template <int field_components, int dimension>
struct FieldGradient {
  static constexpr int components = field_components;
  std::array<std::array<double, dimension>, components> gradient{};

  template <class Point, class NodalValues>
  FieldGradient(const Point& at, const NodalValues& v) {
    for (std::size_t a = 0; a < v.size(); ++a)
      for (int i = 0; i < components; ++i)
        for (int k = 0; k < dimension; ++k) gradient[i][k] += v[a][i] * at.gradient[a][k];
  }
};

/// Shape functions at the points of a rule, and at the centroid.
template <class Geometry, int count>
struct ElementRule {
  std::array<typename Geometry::Shape, count> points;
  typename Geometry::Shape centre;
  double thickness;

  explicit ElementRule(double of_thickness) : thickness(of_thickness) {
    const auto rule = Geometry::Cell::rule(count);
    for (int q = 0; q < count; ++q) points[q] = Geometry::shape_at(rule[q].template position<Geometry::dimension>(), rule[q].weight);
    centre = Geometry::shape_at(Geometry::Cell::centroid, 0.0);
  }
};

/// The points of one element with what an integrand reads there. A type of `Reads`, as FieldValue, has `components` of its field and is made of a
/// point and of the field's values at the nodes. What no one asks for is not computed.
template <class Geometry, int count, class Reads>
class ElementPoints;

template <class Geometry, int count, class... Reads>
class ElementPoints<Geometry, count, std::tuple<Reads...>> {
 public:
  static constexpr int size = count;  ///< number of points
  using Rule = ElementRule<Geometry, count>;
  using Positions = typename Geometry::Positions;
  using NodalValues = std::tuple<std::array<std::array<double, Reads::components>, Geometry::nodes>...>;

  /// A point: shape functions, and `fields`, one of each type of Reads.
  struct Point : Geometry::Point {
    std::tuple<Reads...> fields;

    Point(const typename Geometry::Shape& shape, const ElementPoints& element) : Point(shape, element, std::index_sequence_for<Reads...>{}) {}

   private:
    template <std::size_t... n>
    Point(const typename Geometry::Shape& shape, const ElementPoints& element, std::index_sequence<n...>)
        : Geometry::Point(shape, element.positions_, element.rule_.thickness), fields(Reads(*this, std::get<n>(element.values_))...) {}
  };

  ElementPoints(const Rule& rule, const Positions& positions, const NodalValues& values) : rule_(rule), positions_(positions), values_(values) {}

  Point operator[](int q) const { return {rule_.points[q], *this}; }
  Point centre() const { return {rule_.centre, *this}; }
  const Positions& positions() const { return positions_; }  ///< of the nodes
  const NodalValues& values() const { return values_; }      ///< of the fields at the nodes

 private:
  const Rule& rule_;
  Positions positions_;
  NodalValues values_;
};

}  // namespace mortise
