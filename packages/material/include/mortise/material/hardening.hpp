#pragma once
// The list of hardening laws: yield stress sigma_y as a function of the accumulated plastic strain alpha. A new law: its own header in hardening/,
// and its name in `Hardening` below.

#include <variant>

#include "mortise/core/parameters.hpp"
#include "mortise/material/hardening/linear.hpp"
#include "mortise/material/hardening/linear_voce.hpp"
#include "mortise/material/hardening/ludwik.hpp"
#include "mortise/material/hardening/perfect.hpp"
#include "mortise/material/hardening/swift.hpp"
#include "mortise/material/hardening/table.hpp"
#include "mortise/material/hardening/voce.hpp"

namespace mortise {

/// Every hardening law there is. Each has yield_stress(alpha), slope(alpha) >= 0 and plastic_work(alpha), the integral of the yield stress from 0;
/// one that may be arbitrarily steep also plastic_strain(stress), the inverse.
using Hardening =
    std::variant<PerfectPlasticity, LinearHardening, LudwikHardening, SwiftHardening, VoceHardening, LinearVoceHardening, TableHardening>;

/// sigma_y(alpha) [stress].
double yield_stress(const Hardening& hardening, double alpha);

/// int_0^alpha sigma_y: work of plastic flow per reference volume [stress].
double plastic_work(const Hardening& hardening, double alpha);

/// Result of the return map.
struct PlasticIncrement {
  double strain = 0.0;  ///< increment of alpha; NaN: there is none
  double slope = 0.0;   ///< d sigma_y / d alpha at the end; may be infinite
};

/// Solves trial_stress - stiffness x - sigma_y(alpha + x) = 0 for x in [0, (trial_stress - sigma_y(alpha)) / stiffness], with trial_stress >
/// sigma_y(alpha) and stiffness = 3 G > 0. The left side falls in x: there is exactly one root, and it is bracketed all the way. Newton's method with
/// bisection finds it in x. Hardening may take nearly all of the excess: near alpha = 0 of Ludwik's law x may be as small as 1e-42. There the unknown
/// is the stress s, with s + stiffness (alpha(s) - alpha) = trial_stress on [sigma_y(alpha), trial_stress]. TOMS 748 (Alefeld, Potra, Shi 1995) finds
/// it.
PlasticIncrement return_map(const Hardening& hardening, double trial_stress, double alpha, double stiffness);

/// A hardening law by its parameters.
struct HardeningOptions : Described {
  virtual Hardening hardening() const = 0;
};

/// All hardening laws by name.
const Registry<HardeningOptions>& hardening_registry();

}  // namespace mortise
