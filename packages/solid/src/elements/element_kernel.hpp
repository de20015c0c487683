#pragma once
// Mechanics of one element: residual, tangent and point data for every cell, kinematics, formulation and law.

#include <array>
#include <cmath>
#include <tuple>
#include <type_traits>

#include "elements/element_tangent.hpp"
#include "mortise/material/plane_stress.hpp"
#include "mortise/solid/bodies.hpp"
#include "mortise/solid/deformation.hpp"

namespace mortise {

/// The components of the tangent that the kinematics takes.
template <Kinematics kinematics>
using ComponentsOf = std::conditional_t<kinematics == Kinematics::three_dimensional, SolidComponents,
                                        std::conditional_t<kinematics == Kinematics::axisymmetric, AxisymmetricComponents, PlaneComponents>>;

/// F that the law sees; of F-bar (det F0 / det F)^(1/n) F: the in-plane gradient with n = 2 in plane strain, the full one with n = 3 otherwise.
/// `centre` is the element's centre for F-bar.
template <Kinematics kinematics, bool f_bar, class Motion, class Centre>
Matrix3 deformation_gradient_of_law(const Motion& motion, [[maybe_unused]] const Centre& centre) {
  if constexpr (!f_bar) {
    return motion.F;
  } else if constexpr (kinematics == Kinematics::plane_strain) {
    Matrix3 F = motion.F;
    F.topLeftCorner<2, 2>() *= std::sqrt(std::get<0>(centre.fields).determinant / motion.determinant);
    return F;
  } else {
    return std::cbrt(std::get<0>(centre.fields).determinant / motion.determinant) * motion.F;
  }
}

/// Puts positions and weight of point q into `result`. The displacement is the first field of `points`.
template <class Points>
void set_place(int q, const Points& points, MaterialPoint& result) {
  const auto at = points[q];
  const auto &X = points.positions(), &u = std::get<0>(points.values());
  result.point = q;
  for (std::size_t a = 0; a < X.size(); ++a)
    for (std::size_t i = 0; i < X[a].size(); ++i) {
      result.reference_position[i] += at.N[a] * X[a][i];
      result.position[i] += at.N[a] * (X[a][i] + u[a][i]);
    }
  result.weight = at.weight;
}

/// Why an element has no residual.
struct ElementTrouble {
  enum class Kind { none, inverted, no_stress };
  Kind kind = Kind::none;
  int point = -1;            ///< -1: the centre
  double determinant = 1.0;  ///< det F there
  explicit operator bool() const { return kind != Kind::none; }
};

/// f_int, the integral of tau : grad eta dV0, with d f_int / du. An integrand, see ElementLoop.
template <class Cell, Kinematics kinematics, ElementFormulation formulation, class PlainLaw>
class Mechanics {
 public:
  using Geometry = ElementGeometry<Cell, kinematics == Kinematics::axisymmetric>;
  static_assert(Geometry::dimension == mortise::dimension(kinematics));
  static constexpr int nodes = Cell::nodes, dimension = Cell::dimension, components = dimension, point_count = Geometry::stiffness_points;
  static constexpr bool f_bar = formulation == ElementFormulation::f_bar;
  using Motion = Deformation<Geometry>;
  using Reads = std::tuple<Motion>;
  using AnyLaw = std::conditional_t<kinematics == Kinematics::plane_stress, PlaneStress<PlainLaw>, Unconstrained<PlainLaw>>;
  static constexpr bool small_strain = AnyLaw::small_strain, history = has_history<PlainLaw>;
  using State = typename AnyLaw::State;
  using States = std::array<State, point_count>;
  using Residual = std::array<double, components * nodes>;
  using Components = ComponentsOf<kinematics>;
  using TangentSum = ElementTangent<Geometry, Components, f_bar>;
  using Tangent = typename TangentSum::Stiffness;

  explicit Mechanics(const PlainLaw& law) : law_{law} {}

  /// In trouble nothing of use is added.
  template <class Points, class Sums>
  ElementTrouble add(const Points& points, const States& states, Sums& sums) const {
    auto centre = centre_of(points);
    if constexpr (f_bar) {
      const Motion& motion = std::get<0>(centre.fields);
      if (!(motion.determinant > 0.0)) return {ElementTrouble::Kind::inverted, -1, motion.determinant};
      motion.push_forward(centre);
    }
    [[maybe_unused]] auto tangent = [&] {
      if constexpr (Sums::with_tangent)
        return TangentSum(centre, sums.tangent);
      else
        return 0;
    }();
    for (int q = 0; q < point_count; ++q) {
      auto at = points[q];
      const Motion& motion = std::get<0>(at.fields);
      if constexpr (!small_strain) {
        if (!(determinant_of_law(motion) > 0.0)) return {ElementTrouble::Kind::inverted, q, determinant_of_law(motion)};
        motion.push_forward(at);
      }
      // f = integral of sigma(F_law) : grad eta det F dV0; sigma = tau / det F_law, det F_law = det F0 for F-bar.
      double weight = at.weight;
      if constexpr (f_bar) weight *= motion.determinant / std::get<0>(centre.fields).determinant;
      const Matrix3 F = deformation_gradient_of_law<kinematics, f_bar>(motion, centre);
      if constexpr (Sums::with_tangent) {
        const auto response = law_.template stress_and_tangent<Components>(F, states[q]);
        if (!has_stress(response.stress)) return {ElementTrouble::Kind::no_stress, q, motion.determinant};
        if constexpr (Sums::with_residual) add_point_force<Geometry>(at, response.stress, weight, sums.residual);
        tangent.add(at, response, weight);
      } else {
        const Matrix3 stress = law_.stress(F, states[q]);
        if (!has_stress(stress)) return {ElementTrouble::Kind::no_stress, q, motion.determinant};
        add_point_force<Geometry>(at, stress, weight, sums.residual);
      }
    }
    if constexpr (Sums::with_tangent) tangent.finish();
    return {};
  }

  /// What the points remember if the step that ends here is accepted. Only for laws with a history.
  template <class Points>
  void commit(const Points& points, States& states) const {
    const auto centre = centre_of(points);
    for (int q = 0; q < point_count; ++q)
      states[q] = law_.law.updated(deformation_gradient_of_law<kinematics, f_bar>(std::get<0>(points[q].fields), centre), states[q]);
  }

  /// Point q for output.
  template <class Points>
  MaterialPoint material_point(int q, const Points& points, const States& states) const {
    const auto centre = centre_of(points);
    const auto at = points[q];
    const Motion& motion = std::get<0>(at.fields);
    MaterialPoint result;
    set_place(q, points, result);
    const Matrix3 F = deformation_gradient_of_law<kinematics, f_bar>(motion, centre);
    result.deformation_gradient = law_.deformation(F);
    result.volume_ratio = small_strain ? 1.0 : determinant_of_law(motion);
    double law_volume_ratio = result.volume_ratio;
    if constexpr (f_bar) law_volume_ratio = std::get<0>(centre.fields).determinant;
    result.cauchy_stress = law_.stress(F, states[q]) / law_volume_ratio;
    result.energy = law_.energy(F, states[q]);
    if constexpr (history) {
      result.equivalent_plastic_strain = law_.law.equivalent_plastic_strain(F, states[q]);
      result.plastic_work = plastic_work(law_.law.hardening, result.equivalent_plastic_strain);
    }
    return result;
  }

 private:
  /// Elastic laws have a stress wherever det F > 0.
  static bool has_stress([[maybe_unused]] const Matrix3& stress) {
    if constexpr (history)
      return stress.allFinite();
    else
      return true;
  }

  template <class Points>
  static auto centre_of([[maybe_unused]] const Points& points) {
    if constexpr (f_bar)
      return points.centre();
    else
      return typename TangentSum::Centre{};
  }

  /// det F with the stretch that plane stress finds.
  double determinant_of_law(const Motion& motion) const {
    if constexpr (kinematics == Kinematics::plane_stress)
      return motion.determinant > 0.0 ? motion.determinant * law_.deformation(motion.F)(2, 2) : motion.determinant;
    else
      return motion.determinant;
  }

  AnyLaw law_;
};

}  // namespace mortise
