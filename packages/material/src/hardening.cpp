#include "mortise/material/hardening.hpp"

#include <boost/math/tools/roots.hpp>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <type_traits>
#include <utility>

namespace mortise {
namespace {

template <class Law>
struct OptionsOfHardening : HardeningOptions {
  Law law;
  void describe(Parameters& parameters) override { law.describe(parameters); }
  Hardening hardening() const override { return law; }
};

template <class... Laws>
Registry<HardeningOptions> make_hardening_registry(const std::variant<Laws...>*) {
  Registry<HardeningOptions> registry;
  (registry.add<OptionsOfHardening<Laws>>(Laws::name, Laws::sentence), ...);
  return registry;
}

template <class Law, class = void>
struct HasInverse : std::false_type {};
template <class Law>
struct HasInverse<Law, std::void_t<decltype(std::declval<const Law&>().plastic_strain(0.0))>> : std::true_type {};

/// x of sigma_y(alpha + x) + stiffness x = trial_stress within [low, high] by Newton's method, bisecting where it would leave the bracket. A residual
/// within the round-off of the stresses counts as zero.
template <class Law>
double newton_within(const Law& law, double trial_stress, double alpha, double stiffness, double start, double low, double high) {
  if (!(low < high)) return high;  // nothing hardens
  const double round_off = 2.0 * std::numeric_limits<double>::epsilon() * trial_stress;
  const auto function = [&](double x) {
    const double value = law.yield_stress(alpha + x) + stiffness * x - trial_stress;
    return std::make_pair(std::abs(value) <= round_off ? 0.0 : value, law.slope(alpha + x) + stiffness);
  };
  std::uintmax_t iterations = 200;
  return boost::math::tools::newton_raphson_iterate(function, start, low, high, std::numeric_limits<double>::digits, iterations);
}

/// Newton's method with the stress as unknown, s + stiffness (alpha(s) - alpha) = trial_stress on [sigma_y(alpha), trial_stress], for increments that
/// are round-off of x but not of s.
template <class Law>
double increment_by_stress(const Law& law, double trial_stress, double yield, double alpha, double stiffness) {
  if constexpr (HasInverse<Law>::value) {
    const auto function = [&](double s) { return s - trial_stress + stiffness * (law.plastic_strain(s) - alpha); };
    const double at_low = function(yield), at_high = function(trial_stress);
    double stress = trial_stress;
    if (at_low == 0.0) {
      stress = yield;
    } else if (std::signbit(at_low) == std::signbit(at_high)) {  // round-off hides a change of sign that is at an end
      stress = std::abs(at_low) < std::abs(at_high) ? yield : trial_stress;
    } else if (at_high != 0.0) {
      std::uintmax_t iterations = 200;  // bisection alone needs 64
      const auto [left, right] =
          boost::math::tools::toms748_solve(function, yield, trial_stress, at_low, at_high,
                                            boost::math::tools::eps_tolerance<double>(std::numeric_limits<double>::digits - 1), iterations);
      stress = 0.5 * (left + right);
    }
    // Either difference has lost digits; that of the strains fewer where the law is steeper than the stiffness.
    const double end = law.plastic_strain(stress);
    return std::max(0.0, law.slope(end) > stiffness ? end - alpha : (trial_stress - stress) / stiffness);
  } else {
    throw std::logic_error("a hardening law without an inverse");
  }
}

}  // namespace

double yield_stress(const Hardening& hardening, double alpha) {
  return std::visit([&](const auto& law) { return law.yield_stress(alpha); }, hardening);
}

double plastic_work(const Hardening& hardening, double alpha) {
  return std::visit([&](const auto& law) { return law.plastic_work(alpha); }, hardening);
}

PlasticIncrement return_map(const Hardening& hardening, double trial_stress, double alpha, double stiffness) {
  if (!std::isfinite(trial_stress)) return {std::numeric_limits<double>::quiet_NaN(), 0.0};
  return std::visit(
      [&](const auto& law) -> PlasticIncrement {
        // As sigma_y does not fall: x <= high, so s <= sigma_y(alpha + high), so x >= low.
        const double yield = law.yield_stress(alpha), high = (trial_stress - yield) / stiffness;
        const double low = (trial_stress - law.yield_stress(alpha + high)) / stiffness;
        double increment = 0.0;
        if (HasInverse<std::decay_t<decltype(law)>>::value && !(low > 0.0)) {
          increment = increment_by_stress(law, trial_stress, yield, alpha, stiffness);
        } else {
          // The line at alpha is below the root for concave hardening, and Newton's steps stay there.
          const double line = (trial_stress - yield) / (stiffness + law.slope(alpha));
          increment = newton_within(law, trial_stress, alpha, stiffness, std::max(line, low), std::max(low, 0.0), high);
        }
        return {increment, law.slope(alpha + increment)};
      },
      hardening);
}

const Registry<HardeningOptions>& hardening_registry() {
  static const Registry<HardeningOptions> registry = make_hardening_registry(static_cast<const Hardening*>(nullptr));
  return registry;
}

}  // namespace mortise
