#pragma once
// One-step time integration of u, du/dt and d2u/dt2: coefficients of a scheme, rates within a step.

#include <array>
#include <memory>
#include <vector>

#include "mortise/core/types.hpp"
#include "mortise/nonlinear/contribution.hpp"

namespace mortise {

/// A scheme of the generalised-alpha family (Chung, Hulbert 1993). With D = u_(n+1) - u_n and a step of length h its rates at the end of a step are
///
///     v_(n+1) = velocity[0] D / h + velocity[1] v_n + velocity[2] h a_n,     a_(n+1) = acceleration[0] D / h^2 + acceleration[1] v_n / h +
///     acceleration[2] a_n
///
/// Internal and external forces, f = f_int - f_ext, are those of the ends of the step; a law with a history is never asked for a state between.
struct TimeScheme {
  /// Where forces are in balance.
  enum class Balance {
    /// r = M ((1 - alpha_m) a_(n+1) + alpha_m a_n) + C ((1 - alpha_f) v_(n+1) + alpha_f v_n) + (1 - alpha_f) f_(n+1) + alpha_f f_n + f_c(u_(n+1), z).
    /// Multipliers are constant over the step. Contact does the work sum z (g_(n+1) - g_n) <= 0 (Kane, Repetto, Ortiz, Marsden 1999).
    over_step,
    /// r = M w_(n+1) + C v_(n+1) + f_(n+1) + f_c(u_(n+1), z_(n+1)), w_(n+1) = ((1 - alpha_m) a_(n+1) + alpha_m a_n - alpha_f w_n) / (1 - alpha_f)
    /// (Arnold, Bruels 2007).
    at_end
  };
  Balance balance = Balance::over_step;                 ///< of momentum
  double alpha_m = 0.0;                                 ///< of the acceleration
  double alpha_f = 0.0;                                 ///< of forces and the velocity
  std::array<double, 3> velocity{2.0, -1.0, 0.0};       ///< coefficients of D / h, v_n, h a_n
  std::array<double, 3> acceleration{4.0, -4.0, -1.0};  ///< of D / h^2, v_n / h, a_n

  /// Whether forces of a step's start are needed.
  bool blends_forces() const { return balance == Balance::over_step && alpha_f != 0.0; }
  /// Whether w differs from a.
  bool has_balanced_acceleration() const { return balance == Balance::at_end && (alpha_f != 0.0 || alpha_m != 0.0); }
  /// Of forces without time derivatives.
  double force_share() const { return balance == Balance::over_step ? 1.0 - alpha_f : 1.0; }
};

/// Second order, with numerical damping of high frequencies alone.
/// @param spectral_radius  at infinite frequency: 1 damps nothing, 0 within a step; in [0, 1]
TimeScheme generalised_alpha(double spectral_radius, TimeScheme::Balance balance);
/// Newmark's method. 2 beta >= gamma >= 1/2 makes it unconditionally stable; gamma = 1/2 of second order.
TimeScheme newmark(double beta, double gamma);
/// v_(n+1) = D / h, a_(n+1) = (v_(n+1) - v_n) / h: first order, damps all frequencies.
TimeScheme backward_euler();

/// Time derivatives of the unknowns in an accepted state, on the owned dofs, and forces that the next step needs.
struct AcceptedRates {
  RCP<const Vector> velocity;               ///< of dofs without mass: the mean over the last step
  RCP<const Vector> acceleration;           ///< of Newmark's formulas
  RCP<const Vector> balanced_acceleration;  ///< w; null where it is the acceleration
  RCP<const Vector> external_forces;        ///< -f_ext at the end of the last step; null where the scheme does not need it
};

/// Time integration of a system.
struct TimeIntegration {
  TimeScheme scheme;  ///< its coefficients
  /// Owned dofs without mass, ascending: their velocity is the mean over a step, D / h.
  std::vector<LocalOrdinal> massless;
  /// [owned dofs squared] v = P v gives dofs without mass the value of those with mass around them: the identity in rows of others, columns of dofs
  /// without mass empty. Null: all have mass, or no one says.
  RCP<const Matrix> extension;
};

/// What the unknowns were at the start of a step, and how rates follow from what they are at its end. A value.
struct TimeStep {
  const TimeIntegration* integration = nullptr;  ///< has to outlive it
  double dt = 0.0;                               ///< length of the step
  RCP<const Vector> unknowns;                    ///< at its start
  AcceptedRates start;                           ///< likewise
  RCP<const Vector> internal_forces;             ///< likewise; null where the scheme does not need them

  /// Of the Jacobian of contributions with time derivatives; that of the displacement is 1.
  JacobianWeights weights() const;
};

/// Rates at which contributions are evaluated.
struct BlendedRates {
  RCP<Vector> velocity;      ///< [owned dofs]
  RCP<Vector> acceleration;  ///< [owned dofs]
};
BlendedRates blended_rates(const TimeStep& step, const Vector& unknowns);
/// What a step that ended at these unknowns leaves. `external_forces`: -f_ext at its end.
AcceptedRates rates_at_end(const TimeStep& step, const Vector& unknowns, const Vector& external_forces);
/// u_n + P (h v_n + h^2/2 a_n), P the extension: exact for constant acceleration.
RCP<Vector> predicted_unknowns(const TimeStep& step);
/// Shares of the Jacobian's velocity weight on the owned dofs: dofs without mass have D / h in the place of the scheme's velocity.
RCP<Vector> velocity_shares(const TimeStep& step);

}  // namespace mortise
