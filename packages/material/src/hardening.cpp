#include "mortise/material/hardening.hpp"

#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <limits>
#include <type_traits>

namespace mortise {
namespace {

template <class Law>
struct OptionsOfHardening : HardeningOptions {
  Law law;
  void describe(Parameters& parameters) override { law.describe(parameters); }
  Hardening hardening() const override { return law; }
};

template <class... Laws>
Registry<HardeningOptions> make_registry(const std::variant<Laws...>*) {
  Registry<HardeningOptions> registry;
  (registry.add<OptionsOfHardening<Laws>>(Laws::name, Laws::sentence), ...);
  return registry;
}

template <class Law, class = void>
struct HasInverse : std::false_type {};
template <class Law>
struct HasInverse<Law, std::void_t<decltype(std::declval<const Law&>().plastic_strain(0.0))>> : std::true_type {};

/// Root of a falling or rising function that changes sign on [low, high].
template <class Function>
double bracketed_root(const Function& function, double low, double high) {
  const double at_low = function(low), at_high = function(high);
  if (at_low == 0.0) return low;
  if (at_high == 0.0) return high;
  // Round-off may hide a change of sign that is at an end.
  if (!(std::signbit(at_low) != std::signbit(at_high))) return std::abs(at_low) < std::abs(at_high) ? low : high;
  std::uintmax_t iterations = 200;  // bisection alone needs 64 where the root is not much smaller than the bracket
  const auto [left, right] = boost::math::tools::toms748_solve(
      function, low, high, at_low, at_high, boost::math::tools::eps_tolerance<double>(std::numeric_limits<double>::digits - 1), iterations);
  return 0.5 * (left + right);
}

}  // namespace

double yield_stress(const Hardening& hardening, double alpha) {
  return std::visit([&](const auto& law) { return law.yield_stress(alpha); }, hardening);
}

PlasticIncrement return_map(const Hardening& hardening, double trial_stress, double alpha, double stiffness) {
  if (!std::isfinite(trial_stress)) return {std::numeric_limits<double>::quiet_NaN(), 0.0};
  return std::visit(
      [&](const auto& law) -> PlasticIncrement {
        const double yield = law.yield_stress(alpha);
        double increment = 0.0;
        if constexpr (HasInverse<std::decay_t<decltype(law)>>::value) {
          const double stress =
              bracketed_root([&](double s) { return s - trial_stress + stiffness * (law.plastic_strain(s) - alpha); }, yield, trial_stress);
          // Either difference has lost digits; that of the strains fewer where the law is steeper than the stiffness.
          const double end = law.plastic_strain(stress);
          increment = std::max(0.0, law.slope(end) > stiffness ? end - alpha : (trial_stress - stress) / stiffness);
        } else {
          increment = bracketed_root([&](double x) { return trial_stress - stiffness * x - law.yield_stress(alpha + x); }, 0.0,
                                     (trial_stress - yield) / stiffness);
        }
        return {increment, law.slope(alpha + increment)};
      },
      hardening);
}

const Registry<HardeningOptions>& hardening_registry() {
  static const Registry<HardeningOptions> registry = make_registry(static_cast<const Hardening*>(nullptr));
  return registry;
}

}  // namespace mortise
