#pragma once
// Finite strain plasticity with the von Mises yield condition.

#include <array>

#include "mortise/material/hardening.hpp"
#include "mortise/material/hencky.hpp"

namespace mortise {

/// Multiplicative plasticity F = F_e F_p with Hencky's elasticity and isotropic hardening. Sources: Simo 1992, CMAME 99; de Souza Neto, Peric, Owen
/// 2008, chapter 14.
///   b_e = F C_p^-1 F^T,  C_p = F_p^T F_p,   e = 1/2 ln b_e,   tau = 2 G dev e + K tr e I,   q = sqrt(3/2) |dev tau| <= sigma_y(alpha).
/// Plastic flow is along dev tau. Backward Euler with the exponential map keeps the axes of the trial b_e. The trial takes C_p^-1 of the last step:
///   e = e_tr - x (3/2) dev tau_tr / q_tr,   q = q_tr - 3 G x = sigma_y(alpha + x).
struct FiniteJ2 {
  static constexpr const char* name = "j2 plasticity";
  static constexpr const char* sentence = "von Mises plasticity at finite strain on Hencky's elasticity, with a hardening law";
  static constexpr bool small_strain = false;
  static constexpr bool plane_stress = false;

  /// Memory of a point: the last converged step.
  struct State {
    std::array<double, 6> inverse_plastic_metric{1.0, 1.0, 1.0, 0.0, 0.0, 0.0};  ///< C_p^-1: 11, 22, 33, 12, 23, 13
    double equivalent_plastic_strain = 0.0;                                      ///< alpha
  };

  Hencky elastic;
  Hardening hardening;
  double yield_factor = 1.0;  ///< sigma_y is that of the hardening law times this factor, > 0; with it heat softens
  FiniteJ2(const ElasticConstants& constants, Hardening law) : elastic(constants), hardening(std::move(law)) {}

  /// Kirchhoff stress; NaN where no stress is found (b_e not positive definite to round-off, overflow).
  Matrix3 stress(const Matrix3& F, const State& state) const {
    const Return end = return_to_yield_surface(F, state);
    return kirchhoff(end);
  }

  /// Elastic energy per reference volume.
  double energy(const Matrix3& F, const State& state) const { return elastic.energy(elastic_strain(return_to_yield_surface(F, state))); }

  /// alpha at the end of the step.
  double equivalent_plastic_strain(const Matrix3& F, const State& state) const {
    return state.equivalent_plastic_strain + return_to_yield_surface(F, state).increment.strain;
  }

  /// Memory of the point if the step that ends at F is accepted.
  State updated(const Matrix3& F, const State& state) const {
    const Return end = return_to_yield_surface(F, state);
    if (end.increment.strain == 0.0) return state;
    const Matrix3 inverse = F.inverse(), b = in_axes_of(end.trial, (2.0 * elastic_strain(end)).array().exp().matrix());
    const Matrix3 metric = inverse * b * inverse.transpose();
    return {{metric(0, 0), metric(1, 1), metric(2, 2), 0.5 * (metric(0, 1) + metric(1, 0)), 0.5 * (metric(1, 2) + metric(2, 1)),
             0.5 * (metric(0, 2) + metric(2, 0))},
            state.equivalent_plastic_strain + end.increment.strain};
  }

  /// With D = d tau_a / d e_a in the trial axes and N the unit deviator, d x = d q_tr / (3 G + sigma_y'):
  ///   D = K 1 x 1 + 2 G (1 - 3 G x / q_tr) (I - 1/3 1 x 1) + 2 G (3 G x / q_tr - 3 G / (3 G + sigma_y')) N x N.
  template <class Components>
  StressAndTangent<Components> stress_and_tangent(const Matrix3& F, const State& state) const {
    return stress_and_tangent<Components>(return_to_yield_surface(F, state));
  }

  /// End of a step.
  struct Return {
    Spectrum trial;              ///< b_e of the trial
    Eigen::Vector3d deviator;    ///< of the trial strain, in the axes of b_e
    double volumetric = 0.0;     ///< tr e, which flow does not change
    PlasticIncrement increment;  ///< x, and d sigma_y / d alpha with the yield factor
    double scale = 1.0;          ///< dev e / dev e_tr = 1 - 3 G x / q_tr
  };

  /// The step from `state` that ends at F. Its increment is NaN where no stress is found.
  Return return_to_yield_surface(const Matrix3& F, const State& state) const {
    const auto& c = state.inverse_plastic_metric;
    Matrix3 metric;
    metric << c[0], c[3], c[5], c[3], c[1], c[4], c[5], c[4], c[2];
    Return end;
    end.trial = spectral_decomposition(F * metric * F.transpose());
    const Eigen::Vector3d strain = logarithmic_strain(end.trial);
    end.volumetric = strain.sum();
    end.deviator = strain.array() - end.volumetric / 3.0;
    const double q = std::sqrt(6.0) * elastic.shear_modulus * end.deviator.norm();
    const double yield = yield_factor * yield_stress(hardening, state.equivalent_plastic_strain);
    // A point left on the yield surface comes back with round-off of C_p^-1 and of e; it is elastic until it flows for good.
    const double round_off = 1e-12 * yield + 64.0 * std::numeric_limits<double>::epsilon() * elastic.shear_modulus;
    if (q - yield <= round_off) return end;
    // q - 3 G x = s sigma_y(alpha + x), over the yield factor s.
    end.increment = return_map(hardening, q / yield_factor, state.equivalent_plastic_strain, 3.0 * elastic.shear_modulus / yield_factor);
    end.increment.slope *= yield_factor;
    end.scale = 1.0 - 3.0 * elastic.shear_modulus * end.increment.strain / q;
    return end;
  }

  /// Principal elastic strains at the end, in the axes of the trial b_e.
  static Eigen::Vector3d elastic_strain(const Return& end) { return end.scale * end.deviator + end.volumetric / 3.0 * Eigen::Vector3d::Ones(); }

  /// Kirchhoff stress at the end.
  Matrix3 kirchhoff(const Return& end) const {
    return in_axes_of(end.trial,
                      2.0 * elastic.shear_modulus * end.scale * end.deviator + elastic.bulk_modulus * end.volumetric * Eigen::Vector3d::Ones());
  }

  template <class Components>
  StressAndTangent<Components> stress_and_tangent(const Return& end) const {
    const double shear = end.scale * elastic.shear_modulus;
    StressAndTangent<Components> result;
    result.stress = kirchhoff(end);
    result.tangent = logarithmic_tangent<Components>(end.trial, elastic.bulk_modulus - 2.0 / 3.0 * shear, shear, result.stress);
    if (end.increment.strain > 0.0) {
      const double stiffness = 3.0 * elastic.shear_modulus;
      const Matrix3 direction = in_axes_of(end.trial, end.deviator.normalized());
      Eigen::Matrix<double, Components::size, 1> N;
      for (int p = 0; p < Components::size; ++p) N(p) = direction(Components::row[p], Components::column[p]);
      const double slope = 1.0 - end.scale - stiffness / (stiffness + end.increment.slope);
      result.tangent.noalias() += 2.0 * elastic.shear_modulus * slope * N * N.transpose();
    }
    return result;
  }
};

}  // namespace mortise
