#include "mortise/simulation/scene/inertia.hpp"

#include <fmt/format.h>

#include <cmath>

namespace mortise {

void InertiaOptions::describe(Parameters& parameters) {
  using Balance = TimeScheme::Balance;
  parameters.add("scheme", scheme,
                 {{"none", Scheme::none},
                  {"generalised alpha", Scheme::generalised_alpha},
                  {"newmark", Scheme::newmark},
                  {"backward euler", Scheme::backward_euler}},
                 "time integration; none: the scene is static and bodies have no mass. Generalised alpha is of second order and damps high "
                 "frequencies alone");
  parameters.add(
      "spectral radius", spectral_radius,
      Says("of generalised alpha at infinite frequency: 1 damps nothing, and lets contact forces ring; 0 damps high frequencies within a step")
          .unit("-")
          .at_least(0.0)
          .at_most(1.0));
  parameters.add("balance", balance, {{"over the step", Balance::over_step}, {"at the end", Balance::at_end}},
                 "of generalised alpha: over the step, contact forces are constant within a step and cannot add energy; at the end, contact forces "
                 "are those of the end of the step");
  parameters.add("beta", beta, Says("of Newmark's method").unit("-").above(0.0));
  parameters.add("gamma", gamma, Says("of Newmark's method; above 0.5 it damps, and is of first order").unit("-").at_least(0.5));
  if (scheme == Scheme::newmark && 2.0 * beta < gamma)
    parameters.error(
        "beta", fmt::format("\"beta\" is {}, and \"gamma\" {}; Newmark's method is unstable for 2 beta < gamma, please take a \"beta\" of {} or more",
                            beta, gamma, 0.5 * gamma));
  parameters.add("mass", mass, {{"consistent", Mass::consistent}, {"lumped", Mass::lumped}},
                 "consistent: integrals of products of shape functions; lumped: at the nodes alone");
  parameters.add("contact mass", contact_mass,
                 {{"automatic", ContactMass::automatic}, {"removed", ContactMass::removed}, {"kept", ContactMass::kept}},
                 "removed: nodes of contact surfaces give their mass to interior nodes of their body, so that contact forces do not chatter; "
                 "automatic: kept in bodies that yield, where a layer without mass would flow at once, else removed");
  parameters.add(
      "contact condition", contact_condition, {{"gap", ContactCondition::gap}, {"gap rate", ContactCondition::gap_rate}},
      "gap: closed nodes have no gap at the end of a step; gap rate: nodes that touch at the start of a step do not come closer in it, and "
      "others bear nothing (persistency condition). Contact then takes no energy, and surfaces overlap by up to a step's motion");
  const bool keeps_energy = scheme == Scheme::generalised_alpha && spectral_radius == 1.0 && balance == Balance::over_step;
  if (contact_condition == ContactCondition::gap_rate && !keeps_energy)
    parameters.error(
        "contact condition",
        "the condition \"gap rate\" keeps energy with the scheme \"generalised alpha\", a \"spectral radius\" of 1 and the balance \"over "
        "the step\" alone; please take these, or the condition \"gap\"");
  parameters.add("start", start, {{"in balance", Start::in_balance}, {"at rest", Start::at_rest}},
                 "accelerations of the first state: in balance with loads and stresses, or 0");
  parameters.add("mass damping", mass_damping, Says("a of the damping a M + b K, K the stiffness at the start").unit("1 / time").at_least(0.0));
  parameters.add("stiffness damping", stiffness_damping, Says("b of the damping a M + b K").unit("time").at_least(0.0));
  parameters.add(
      "error tolerance", error_tolerance,
      Says("bound on the local error of a step over the size of the motion; steps get as long as it allows; default: their length is constant")
          .unit("-")
          .above(0.0));
  parameters.add("impact tolerance", impact_tolerance,
                 Says("bound on the energy that contact takes by closing within a step, over the largest kinetic energy so far; a step with more is "
                      "halved; default: none")
                     .unit("-")
                     .above(0.0));
}

// Newmark's method without stiffness terms beside those of the step: beta l^2 + (1/2 + gamma - 2 beta) l + 1/2 - gamma + beta = 0.
double InertiaOptions::radius_at_infinity() const {
  if (scheme == Scheme::generalised_alpha) return spectral_radius;
  if (scheme == Scheme::backward_euler) return 0.0;
  const double b = (0.5 + gamma - 2.0 * beta) / beta, c = (0.5 - gamma + beta) / beta, discriminant = 0.25 * b * b - c;
  return discriminant < 0.0 ? std::sqrt(c) : 0.5 * std::abs(b) + std::sqrt(discriminant);
}

std::vector<std::string> InertiaOptions::idle_parameters() const {
  const InertiaOptions standard;
  std::vector<std::string> idle;
  if (scheme != Scheme::generalised_alpha && spectral_radius != standard.spectral_radius) idle.push_back("spectral radius");
  if (scheme != Scheme::newmark && beta != standard.beta) idle.push_back("beta");
  if (scheme != Scheme::newmark && gamma != standard.gamma) idle.push_back("gamma");
  return idle;
}

TimeScheme InertiaOptions::time_scheme() const {
  switch (scheme) {
    case Scheme::newmark:
      return newmark(beta, gamma);
    case Scheme::backward_euler:
      return backward_euler();
    default:
      return mortise::generalised_alpha(spectral_radius, balance);
  }
}

void InitialConditionOptions::describe(Parameters& parameters) {
  parameters.add("body", body, "body that has them; left out: every body");
  constexpr std::array<const char*, 3> names{"x", "y", "z"};
  const std::vector<std::string> arguments{"x", "y", "z"};
  for (std::size_t i = 0; i < 3; ++i)
    parameters.add(
        std::string("displacement ") + names[i], displacement[i],
        Says(fmt::format("displacement in {} at the start, of the reference position; left out: 0", names[i])).unit("length").arguments(arguments));
  for (std::size_t i = 0; i < 3; ++i)
    parameters.add(std::string("velocity ") + names[i], velocity[i],
                   Says(fmt::format("velocity in {} at the start, of the reference position; left out: 0", names[i]))
                       .unit("length / time")
                       .arguments(arguments));
  parameters.add("spin", spin, Says("angular velocity that is added, counterclockwise about the axis").unit("radians / time"));
  parameters.add("axis", axis, "direction of the axis of the spin in three dimensions, \"x, y, z\"; left out: z");
  parameters.add("centre", centre,
                 Says("point on the axis of the spin; left out: of a rigid body its reference point, else the middle of the box around the body")
                     .unit("length"));
  if (!axis.empty() && axis.size() != 3)
    parameters.error("axis", "needs three numbers, \"x, y, z\"");
  else if (!axis.empty() && std::hypot(axis[0], axis[1], axis[2]) == 0.0)
    parameters.error("axis", "has no direction");
}

}  // namespace mortise
