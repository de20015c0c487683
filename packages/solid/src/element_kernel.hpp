#pragma once
// The one element: residual, tangent and point data for every cell, kinematics, formulation and law.

#include <array>
#include <type_traits>

#include "mortise/material/plane_stress.hpp"
#include "mortise/shape/quadrature.hpp"
#include "mortise/solid/bodies.hpp"

namespace mortise {

/// Axisymmetric triangles take 3 points: with one, the hoop strain leaves a mode without stiffness.
inline constexpr int quadrature_points(CellShape shape, Kinematics kinematics) {
  return shape == CellShape::quadrilateral4 ? 4 : kinematics == Kinematics::axisymmetric ? 3 : 1;
}

/// Why an element has no residual.
struct ElementTrouble {
  enum class Kind { none, inverted, no_stress };
  Kind kind = Kind::none;
  int point = -1;            ///< -1: the centre
  double determinant = 1.0;  ///< det F there
  explicit operator bool() const { return kind != Kind::none; }
};

template <class Cell, Kinematics kinematics, ElementFormulation formulation, class PlainLaw>
class ElementKernel {
 public:
  static constexpr int nodes = Cell::nodes, dofs = 2 * nodes, points = quadrature_points(Cell::shape, kinematics);
  static constexpr bool axisymmetric = kinematics == Kinematics::axisymmetric, f_bar = formulation == ElementFormulation::f_bar;
  using Components = std::conditional_t<axisymmetric, AxisymmetricComponents, PlaneComponents>;
  using AnyLaw = std::conditional_t<kinematics == Kinematics::plane_stress, PlaneStress<PlainLaw>, Unconstrained<PlainLaw>>;
  static constexpr bool small_strain = AnyLaw::small_strain, history = has_history<PlainLaw>;
  using State = typename AnyLaw::State;
  using States = std::array<State, points>;  ///< what the points of an element remember

  using Positions = std::array<std::array<double, 2>, nodes>;  ///< of the nodes, or their displacements
  using Force = std::array<double, dofs>;
  using Stiffness = std::array<std::array<double, dofs>, dofs>;

  /// What a point of the element has of its own.
  struct Point {
    std::array<double, nodes> N;
    Positions gradient;              ///< dN_a/dX, after push_forward dN_a/dx
    std::array<double, nodes> hoop;  ///< N_a/R, after push_forward N_a/r; axisymmetric only
    double weight;                   ///< reference volume
    Matrix3 F;
    double determinant;  ///< det F, hoop included
  };

  ElementKernel(const PlainLaw& law, double thickness) : law_{law}, thickness_(thickness) {
    const auto rule = cell_rule(Cell::shape, points);
    for (int q = 0; q < points; ++q) rule_[q] = {Cell::values(rule[q].position<2>()), Cell::gradients(rule[q].position<2>()), rule[q].weight};
    centre_ = {Cell::values(Cell::centroid), Cell::gradients(Cell::centroid), 0.0};
  }

  const AnyLaw& law() const { return law_; }

  /// Adds f_int to `force` and, with_tangent, d f_int / du to `stiffness`. In trouble nothing of use is added.
  template <bool with_tangent>
  ElementTrouble add(const Positions& X, const Positions& u, const States& states, Force& force, Stiffness& stiffness) const {
    [[maybe_unused]] Centre centre = centre_point(X, u);
    if constexpr (f_bar) {
      if (!(centre.determinant > 0.0)) return {ElementTrouble::Kind::inverted, -1, centre.determinant};
      push_forward(centre);
    }
    for (int q = 0; q < points; ++q) {
      Point at = point(rule_[q], X, u);
      if constexpr (!small_strain) {
        if (!(determinant_of_law(at) > 0.0)) return {ElementTrouble::Kind::inverted, q, determinant_of_law(at)};
        push_forward(at);
      }
      // f = integral of sigma(F_law) : grad eta det F dV0; sigma = tau / det F_law, det F_law = det F0 for F-bar.
      double weight = at.weight;
      if constexpr (f_bar) weight *= at.determinant / centre.determinant;
      const Matrix3 F = deformation_gradient_of_law(at, centre);
      if constexpr (with_tangent) {
        const auto response = law_.template stress_and_tangent<Components>(F, states[q]);
        if (!has_stress(response.stress)) return {ElementTrouble::Kind::no_stress, q, at.determinant};
        add_force(at, response.stress, weight, force);
        add_stiffness(at, centre, response, weight, stiffness);
      } else {
        const Matrix3 stress = law_.stress(F, states[q]);
        if (!has_stress(stress)) return {ElementTrouble::Kind::no_stress, q, at.determinant};
        add_force(at, stress, weight, force);
      }
    }
    return {};
  }

  /// What the points remember if the step that ends at u is accepted. Only for laws with a history.
  void commit(const Positions& X, const Positions& u, States& states) const {
    const Centre centre = centre_point(X, u);
    for (int q = 0; q < points; ++q) states[q] = law_.law.updated(deformation_gradient_of_law(point(rule_[q], X, u), centre), states[q]);
  }

  /// Point q for output.
  MaterialPoint material_point(int q, const Positions& X, const Positions& u, const States& states) const {
    const Centre centre = centre_point(X, u);
    const Point at = point(rule_[q], X, u);
    MaterialPoint result;
    result.point = q;
    for (int a = 0; a < nodes; ++a)
      for (int i = 0; i < 2; ++i) {
        result.reference_position[i] += at.N[a] * X[a][i];
        result.position[i] += at.N[a] * (X[a][i] + u[a][i]);
      }
    result.weight = at.weight;
    const Matrix3 F = deformation_gradient_of_law(at, centre);
    result.deformation_gradient = law_.deformation(F);
    result.volume_ratio = small_strain ? 1.0 : determinant_of_law(at);
    double law_volume_ratio = result.volume_ratio;
    if constexpr (f_bar) law_volume_ratio = centre.determinant;
    result.cauchy_stress = law_.stress(F, states[q]) / law_volume_ratio;
    result.energy = law_.energy(F, states[q]);
    if constexpr (history) {
      result.equivalent_plastic_strain = law_.law.equivalent_plastic_strain(F, states[q]);
      result.plastic_work = plastic_work(law_.law.hardening, result.equivalent_plastic_strain);
    }
    return result;
  }

  /// Adds the integrals of N_a dV0.
  void add_volumes(const Positions& X, std::array<double, nodes>& volumes) const {
    for (const ShapeAtPoint& shape : rule_) {
      const Point at = point(shape, X, Positions{});
      for (int a = 0; a < nodes; ++a) volumes[a] += at.weight * at.N[a];
    }
  }

  /// The smallest dX/dxi determinant (areas; also that of the centre), which a mesh has to have positive.
  double smallest_reference_determinant(const Positions& X) const {
    double smallest = jacobian(centre_, X).determinant();
    for (const ShapeAtPoint& shape : rule_) smallest = std::min(smallest, jacobian(shape, X).determinant());
    return smallest;
  }

 private:
  struct Nothing {};
  using Centre = std::conditional_t<f_bar, Point, Nothing>;

  /// Elastic laws have a stress wherever det F > 0.
  static bool has_stress([[maybe_unused]] const Matrix3& stress) {
    if constexpr (history)
      return stress.allFinite();
    else
      return true;
  }

  struct ShapeAtPoint {
    std::array<double, nodes> N;
    Positions gradient;  ///< dN_a / dxi
    double weight;
  };

  static Eigen::Matrix2d jacobian(const ShapeAtPoint& shape, const Positions& X) {
    Eigen::Matrix2d J = Eigen::Matrix2d::Zero();
    for (int a = 0; a < nodes; ++a)
      for (int i = 0; i < 2; ++i)
        for (int k = 0; k < 2; ++k) J(i, k) += X[a][i] * shape.gradient[a][k];
    return J;
  }

  /// F = I + sum_a u_a x dN_a/dX, F_33 = r / R where axisymmetric.
  Point point(const ShapeAtPoint& shape, const Positions& X, const Positions& u) const {
    Point at;
    at.N = shape.N;
    const Eigen::Matrix2d J = jacobian(shape, X);
    const double area = J(0, 0) * J(1, 1) - J(0, 1) * J(1, 0);
    at.F.setIdentity();
    for (int a = 0; a < nodes; ++a) {
      const auto& g = shape.gradient[a];
      at.gradient[a] = {(J(1, 1) * g[0] - J(1, 0) * g[1]) / area, (J(0, 0) * g[1] - J(0, 1) * g[0]) / area};
      for (int i = 0; i < 2; ++i)
        for (int k = 0; k < 2; ++k) at.F(i, k) += u[a][i] * at.gradient[a][k];
    }
    double depth = thickness_;
    if constexpr (axisymmetric) {
      double radius = 0.0, change = 0.0;
      for (int a = 0; a < nodes; ++a) {
        radius += shape.N[a] * X[a][0];
        change += shape.N[a] * u[a][0];
      }
      for (int a = 0; a < nodes; ++a) at.hoop[a] = shape.N[a] / radius;
      at.F(2, 2) += change / radius;
      depth = 2.0 * EIGEN_PI * radius;
    } else {
      at.hoop.fill(0.0);
    }
    at.weight = shape.weight * area * depth;
    // A reversed meridian plane and a negative radius together would look like a positive volume.
    const double in_plane = at.F(0, 0) * at.F(1, 1) - at.F(0, 1) * at.F(1, 0);
    at.determinant = in_plane > 0.0 ? in_plane * at.F(2, 2) : in_plane;
    return at;
  }

  Centre centre_point(const Positions& X, const Positions& u) const {
    if constexpr (f_bar)
      return point(centre_, X, u);
    else
      return {};
  }

  /// det F with the stretch that plane stress finds.
  double determinant_of_law(const Point& at) const {
    if constexpr (kinematics == Kinematics::plane_stress)
      return at.determinant > 0.0 ? at.determinant * law_.deformation(at.F)(2, 2) : at.determinant;
    else
      return at.determinant;
  }

  /// dN/dx = dN/dX F^-1,  N/r = N/R / F_33.
  static void push_forward(Point& at) {
    const double in_plane = at.F(0, 0) * at.F(1, 1) - at.F(0, 1) * at.F(1, 0);
    for (int a = 0; a < nodes; ++a) {
      const std::array<double, 2> g = at.gradient[a];
      at.gradient[a] = {(g[0] * at.F(1, 1) - g[1] * at.F(1, 0)) / in_plane, (g[1] * at.F(0, 0) - g[0] * at.F(0, 1)) / in_plane};
      if constexpr (axisymmetric) at.hoop[a] /= at.F(2, 2);
    }
  }

  /// F, or of F-bar (det F0 / det F)^(1/n) F: the in-plane gradient with n = 2 in plane strain, the full one with n = 3 if axisymmetric.
  static Matrix3 deformation_gradient_of_law(const Point& at, [[maybe_unused]] const Centre& centre) {
    if constexpr (!f_bar) {
      return at.F;
    } else if constexpr (axisymmetric) {
      return std::cbrt(centre.determinant / at.determinant) * at.F;
    } else {
      Matrix3 F = at.F;
      F.topLeftCorner<2, 2>() *= std::sqrt(centre.determinant / at.determinant);
      return F;
    }
  }

  static void add_force(const Point& at, const Matrix3& stress, double weight, Force& force) {
    for (int a = 0; a < nodes; ++a) {
      for (int i = 0; i < 2; ++i) force[2 * a + i] += weight * (stress(i, 0) * at.gradient[a][0] + stress(i, 1) * at.gradient[a][1]);
      if constexpr (axisymmetric) force[2 * a] += weight * stress(2, 2) * at.hoop[a];
    }
  }

  /// K += G^T A G, and for F-bar  + G^T q (tr G0 - tr G),  q = (1/n) A:(I x I) + (1/n) (1 - n) tau x I over the n directions that F-bar scales.
  static void add_stiffness(const Point& at, [[maybe_unused]] const Centre& centre, const StressAndTangent<Components>& response, double weight,
                            Stiffness& stiffness) {
    constexpr int size = Components::size;
    const auto& A = response.tangent;
    std::array<double, size> q{};
    if constexpr (f_bar) {
      constexpr double n = axisymmetric ? 3.0 : 2.0;
      for (int p = 0; p < size; ++p)
        q[p] =
            (A(p, 0) + A(p, 3) + (axisymmetric ? A(p, size - 1) : 0.0) + (1.0 - n) * response.stress(Components::row[p], Components::column[p])) / n;
    }
    for (int b = 0; b < nodes; ++b)
      for (int k = 0; k < 2; ++k) {
        // Change of (weight x stress, less the geometric part) with the dof (b, k), whose L has the row k = dN_b/dx and, for k = 0, L_33 = N_b/r.
        std::array<double, size> change;
        const double* gradient = at.gradient[b].data();
        for (int p = 0; p < size; ++p) {
          change[p] = A(p, 2 * k) * gradient[0] + A(p, 2 * k + 1) * gradient[1];
          if constexpr (axisymmetric)
            if (k == 0) change[p] += A(p, 4) * at.hoop[b];
        }
        if constexpr (f_bar) {
          double trace = centre.gradient[b][k] - gradient[k];
          if constexpr (axisymmetric)
            if (k == 0) trace += centre.hoop[b] - at.hoop[b];
          for (int p = 0; p < size; ++p) change[p] += q[p] * trace;
        }
        for (int p = 0; p < size; ++p) change[p] *= weight;
        const int column = 2 * b + k;
        for (int a = 0; a < nodes; ++a) {
          for (int i = 0; i < 2; ++i) stiffness[2 * a + i][column] += at.gradient[a][0] * change[2 * i] + at.gradient[a][1] * change[2 * i + 1];
          if constexpr (axisymmetric) stiffness[2 * a][column] += at.hoop[a] * change[4];
        }
      }
  }

  AnyLaw law_;
  double thickness_;
  std::array<ShapeAtPoint, points> rule_;
  ShapeAtPoint centre_;
};

}  // namespace mortise
