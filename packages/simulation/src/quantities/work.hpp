#pragma once
// Works, summed up over the steps.

#include <memory>

#include "mortise/simulation/quantities/quantity.hpp"

namespace mortise {

/// Energies and works of a model.
enum class EnergyOf {
  stored,                 ///< int W dV0
  plastic_work,           ///< int int_0^alpha sigma_y dalpha dV0
  friction,               ///< of the shear tractions of all pairs with friction
  external_work,          ///< of loads and supports
  internal_work,          ///< of the internal forces
  kinetic,                ///< 1/2 v . M v
  contact_work,           ///< of all contact forces on the bodies, friction included: what contact takes is negative
  damping,                ///< taken by damping
  numerical_dissipation,  ///< external + contact work - change of stored and kinetic energy - plastic work - damping: what time integration takes
  springs,                ///< stored in springs
  dashpots,               ///< taken by dashpots; with inertia part of damping
  stabilisation           ///< taken by viscous stabilisation
};

/// The force that does the work of a step.
///   - trapezoidal: the mean of those at its ends. Over the step, with inertia: the one that is in balance, f_n at t_(n+1) - alpha_f h.
///   - central: with inertia over the step, f_n + (1/2 - alpha_f)(f_(n-1) - f_n), the force in its middle: of second order. Else trapezoidal.
///   - at_end: in statics that at its end, which viscous forces have throughout it (velocity dd / dt).
enum class WorkRule { trapezoidal, central, at_end };

/// The work of friction, of loads and supports, internal forces, contact, damping, dashpots or stabilisation.
std::unique_ptr<QuantityEvaluator> work(EnergyOf of, const QuantityContext& context, WorkRule rule = WorkRule::trapezoidal);

}  // namespace mortise
