#pragma once
// A three-dimensional law under plane stress.

#include "mortise/material/history.hpp"
#include "mortise/material/tensor_components.hpp"

namespace mortise {

/// Finds F_33 from tau_33 = 0 and condenses it out of the tangent. `Law` gives `with_plane_stress(F)`.
template <class Law>
struct PlaneStress {
  static_assert(!has_history<Law>, "no law with a history has a plane stress form");
  static constexpr bool small_strain = Law::small_strain;
  using State = NoState;

  Law law;

  /// F of the law: the in-plane components given, F_33 so that tau_33 = 0.
  Matrix3 deformation(const Matrix3& F) const { return law.with_plane_stress(F); }

  double energy(const Matrix3& F, NoState = {}) const { return law.energy(deformation(F)); }

  Matrix3 stress(const Matrix3& F, NoState = {}) const { return law.stress(deformation(F)); }

  /// Only for PlaneComponents. With tau_33 = 0, A_33kl L_kl = d tau_33 = 0 gives L_33, and
  ///   A_ijkl <- A_ijkl - A_ij33 A_33kl / A_3333.
  template <class Components>
  StressAndTangent<Components> stress_and_tangent(const Matrix3& F, NoState = {}) const {
    static_assert(Components::size == PlaneComponents::size, "plane stress knows the in-plane components only");
    const auto full = law.template stress_and_tangent<AxisymmetricComponents>(deformation(F));
    StressAndTangent<Components> result;
    result.stress = full.stress;
    result.tangent = full.tangent.template topLeftCorner<4, 4>();
    result.tangent.noalias() -= full.tangent.template topRightCorner<4, 1>() * full.tangent.template bottomLeftCorner<1, 4>() / full.tangent(4, 4);
    return result;
  }
};

/// A law as it stands: plane strain, axisymmetric, three dimensions. Same members as PlaneStress; `state` is passed on to laws that have one.
template <class Law>
struct Unconstrained {
  static constexpr bool small_strain = Law::small_strain;
  using State = typename StateOf<Law>::type;

  Law law;

  Matrix3 deformation(const Matrix3& F) const { return F; }
  double energy(const Matrix3& F, [[maybe_unused]] const State& state) const {
    if constexpr (has_history<Law>)
      return law.energy(F, state);
    else
      return law.energy(F);
  }
  Matrix3 stress(const Matrix3& F, [[maybe_unused]] const State& state) const {
    if constexpr (has_history<Law>)
      return law.stress(F, state);
    else
      return law.stress(F);
  }
  template <class Components>
  StressAndTangent<Components> stress_and_tangent(const Matrix3& F, [[maybe_unused]] const State& state) const {
    if constexpr (has_history<Law>)
      return law.template stress_and_tangent<Components>(F, state);
    else
      return law.template stress_and_tangent<Components>(F);
  }
};

}  // namespace mortise
