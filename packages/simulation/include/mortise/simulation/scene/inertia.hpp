#pragma once
// Inertia and damping of a scene, and motion at its start.

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "mortise/core/parameters.hpp"
#include "mortise/nonlinear/time_scheme.hpp"

namespace mortise {

/// Mass of a scene's bodies and how motion is integrated in time.
struct InertiaOptions {
  enum class Scheme { none, generalised_alpha, newmark, backward_euler };
  enum class Mass { consistent, lumped };
  enum class ContactMass { automatic, removed, kept };
  enum class ContactCondition { gap, gap_rate };
  enum class Start { in_balance, at_rest };
  Scheme scheme = Scheme::none;  ///< none: the scene has no inertia
  double spectral_radius = 0.8;  ///< of generalised-alpha at infinite frequency
  TimeScheme::Balance balance = TimeScheme::Balance::over_step;
  double beta = 0.25, gamma = 0.5;  ///< of Newmark's method
  Mass mass = Mass::consistent;
  ContactMass contact_mass = ContactMass::automatic;
  ContactCondition contact_condition = ContactCondition::gap;
  Start start = Start::in_balance;
  double mass_damping = 0.0;              ///< [1 / time] a of C = a M + b K_0
  double stiffness_damping = 0.0;         ///< [time] b
  std::optional<double> error_tolerance;  ///< of the local error of a step over the size of the motion; none: steps are constant
  std::optional<double>
      impact_tolerance;  ///< of the energy that contact takes by closing within a step, over the kinetic energy; none: not looked at
  Place place;           ///< of the list
  void describe(Parameters& parameters);

  bool acts() const { return scheme != Scheme::none; }
  TimeScheme time_scheme() const;
  /// Spectral radius at infinite frequency.
  double radius_at_infinity() const;
  /// Names of parameters that differ from their defaults and belong to another scheme.
  std::vector<std::string> idle_parameters() const;
};

/// Displacements and velocities of a body at the start. Functions are of the reference position x, y, z.
struct InitialConditionOptions {
  Located<std::string> body;                                  ///< empty: every body
  std::array<std::optional<ScalarFunction>, 3> displacement;  ///< [length] no value: 0
  std::array<std::optional<ScalarFunction>, 3> velocity;      ///< [length / time] no value: 0
  double spin = 0.0;                                          ///< [radians / time] about the axis; counterclockwise in 2D
  std::vector<double> axis;                                   ///< direction in 3D; empty: z
  std::vector<double> centre;                                 ///< on the axis; empty: the middle of the box around the body, or a reference point
  void describe(Parameters& parameters);
};

}  // namespace mortise
