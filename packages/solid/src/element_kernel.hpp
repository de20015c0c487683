#pragma once
// The one element: residual, tangent and point data for every cell, kinematics, formulation and law.

#include <algorithm>
#include <array>
#include <cmath>
#include <type_traits>

#include "element_tangent.hpp"
#include "mortise/material/plane_stress.hpp"
#include "mortise/solid/bodies.hpp"

namespace mortise {

/// Points that integrate the stiffness of an undistorted cell exactly. Axisymmetric triangles need more for radii and hoop strains: with one point,
/// the hoop strain of linear ones leaves a mode without stiffness.
template <class Cell>
constexpr int quadrature_points(Kinematics kinematics) {
  if constexpr (Cell::dimension == 2)
    if (kinematics == Kinematics::axisymmetric) return Cell::axisymmetric_stiffness_points;
  return Cell::stiffness_points;
}

/// The components of the tangent that the kinematics takes.
template <Kinematics kinematics>
using ComponentsOf = std::conditional_t<kinematics == Kinematics::three_dimensional, SolidComponents,
                                        std::conditional_t<kinematics == Kinematics::axisymmetric, AxisymmetricComponents, PlaneComponents>>;

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
  using Geometry = ElementGeometry<Cell, kinematics>;
  static constexpr int nodes = Cell::nodes, dimension = Cell::dimension, dofs = dimension * nodes, points = quadrature_points<Cell>(kinematics);
  static constexpr bool f_bar = formulation == ElementFormulation::f_bar;
  using Components = ComponentsOf<kinematics>;
  using Tangent = ElementTangent<Geometry, Components, f_bar>;
  using AnyLaw = std::conditional_t<kinematics == Kinematics::plane_stress, PlaneStress<PlainLaw>, Unconstrained<PlainLaw>>;
  static constexpr bool small_strain = AnyLaw::small_strain, history = has_history<PlainLaw>;
  using State = typename AnyLaw::State;
  using States = std::array<State, points>;  ///< memory of the points of an element

  using Positions = typename Geometry::Positions;
  using Point = typename Geometry::Point;
  using Force = std::array<double, dofs>;
  using Stiffness = typename Tangent::Stiffness;  ///< columns Tangent::column(b, k)

  ElementKernel(const PlainLaw& law, double thickness) : law_{law}, thickness_(thickness) {
    const auto rule = Cell::rule(points);
    for (int q = 0; q < points; ++q) rule_[q] = Geometry::shape_at(rule[q].template position<dimension>(), rule[q].weight);
    centre_ = Geometry::shape_at(Cell::centroid, 0.0);
  }

  const AnyLaw& law() const { return law_; }

  /// Adds f_int to `force` and, with_tangent, d f_int / du to `stiffness`. In trouble nothing of use is added.
  template <bool with_tangent>
  ElementTrouble add(const Positions& X, const Positions& u, const States& states, Force& force, Stiffness& stiffness) const {
    [[maybe_unused]] Centre centre = centre_point(X, u);
    if constexpr (f_bar) {
      if (!(centre.determinant > 0.0)) return {ElementTrouble::Kind::inverted, -1, centre.determinant};
      Geometry::push_forward(centre);
    }
    [[maybe_unused]] Tangent tangent(centre, stiffness);
    for (int q = 0; q < points; ++q) {
      Point at = Geometry::point(rule_[q], X, u, thickness_);
      if constexpr (!small_strain) {
        if (!(determinant_of_law(at) > 0.0)) return {ElementTrouble::Kind::inverted, q, determinant_of_law(at)};
        Geometry::push_forward(at);
      }
      // f = integral of sigma(F_law) : grad eta det F dV0; sigma = tau / det F_law, det F_law = det F0 for F-bar.
      double weight = at.weight;
      if constexpr (f_bar) weight *= at.determinant / centre.determinant;
      const Matrix3 F = deformation_gradient_of_law(at, centre);
      if constexpr (with_tangent) {
        const auto response = law_.template stress_and_tangent<Components>(F, states[q]);
        if (!has_stress(response.stress)) return {ElementTrouble::Kind::no_stress, q, at.determinant};
        add_point_force<Geometry>(at, response.stress, weight, force);
        tangent.add(at, response, weight);
      } else {
        const Matrix3 stress = law_.stress(F, states[q]);
        if (!has_stress(stress)) return {ElementTrouble::Kind::no_stress, q, at.determinant};
        add_point_force<Geometry>(at, stress, weight, force);
      }
    }
    if constexpr (with_tangent) tangent.finish();
    return {};
  }

  /// Memory of the points if the step that ends at u is accepted. Only for laws with a history.
  void commit(const Positions& X, const Positions& u, States& states) const {
    const Centre centre = centre_point(X, u);
    for (int q = 0; q < points; ++q)
      states[q] = law_.law.updated(deformation_gradient_of_law(Geometry::point(rule_[q], X, u, thickness_), centre), states[q]);
  }

  /// Point q for output.
  MaterialPoint material_point(int q, const Positions& X, const Positions& u, const States& states) const {
    const Centre centre = centre_point(X, u);
    const Point at = Geometry::point(rule_[q], X, u, thickness_);
    MaterialPoint result;
    result.point = q;
    for (int a = 0; a < nodes; ++a)
      for (int i = 0; i < dimension; ++i) {
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
    for (const Shape& shape : rule_) {
      const Point at = Geometry::point(shape, X, Positions{}, thickness_);
      for (int a = 0; a < nodes; ++a) volumes[a] += at.weight * at.N[a];
    }
  }

  /// The smallest dX/dxi determinant (areas or volumes; also that of the centre), which a mesh has to have positive.
  double smallest_reference_determinant(const Positions& X) const {
    double smallest = Geometry::jacobian(centre_, X).determinant();
    for (const Shape& shape : rule_) smallest = std::min(smallest, Geometry::jacobian(shape, X).determinant());
    return smallest;
  }

 private:
  using Centre = typename Tangent::Centre;
  using Shape = typename Geometry::Shape;

  /// Elastic laws have a stress wherever det F > 0.
  static bool has_stress([[maybe_unused]] const Matrix3& stress) {
    if constexpr (history)
      return stress.allFinite();
    else
      return true;
  }

  Centre centre_point(const Positions& X, const Positions& u) const {
    if constexpr (f_bar)
      return Geometry::point(centre_, X, u, thickness_);
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

  /// F, or of F-bar (det F0 / det F)^(1/n) F: the in-plane gradient with n = 2 in plane strain, the full one with n = 3 otherwise.
  static Matrix3 deformation_gradient_of_law(const Point& at, [[maybe_unused]] const Centre& centre) {
    if constexpr (!f_bar) {
      return at.F;
    } else if constexpr (kinematics == Kinematics::plane_strain) {
      Matrix3 F = at.F;
      F.topLeftCorner<2, 2>() *= std::sqrt(centre.determinant / at.determinant);
      return F;
    } else {
      return std::cbrt(centre.determinant / at.determinant) * at.F;
    }
  }

  AnyLaw law_;
  double thickness_;
  std::array<Shape, points> rule_;
  Shape centre_;
};

}  // namespace mortise
