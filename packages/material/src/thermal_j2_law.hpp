#pragma once
// J2 plasticity that knows the temperature.

#include "thermal_elasticity.hpp"

namespace mortise {

/// The law FiniteJ2 at F_e = exp(p) F with constants of the temperature and the yield stress s(theta) sigma_y(alpha). As thermal strain is spherical,
/// C_p^-1 does not see it. With the trial strain e, n = dev e / |dev e|, q = sqrt(6) G |dev e|, H = s dsigma_y/dalpha and Y = s' sigma_y,
///   d x / d e = 2 G sqrt(3/2) n / (3 G + H),   d x / d theta = (q G'/G - 3 G' x - Y) / (3 G + H)
/// follow from q - 3 G x - s sigma_y(alpha + x) = 0.
/// A point remembers C_p^-1, alpha, the plastic work if it is no function of alpha, the principal elastic stretches if elastic strain heats, and what
/// HeatWeights needs.
class ThermalJ2Law final : public ThermalLaw {
 public:
  ThermalJ2Law(const MaterialOptions& material, double share_at_start);

  bool small_strain() const override { return false; }
  const char* name() const override { return FiniteJ2::name; }
  bool has_plasticity() const override { return true; }
  bool heats() const override { return heat_share_ > 0.0 || constants_.thermoelastic_heating(); }
  int state_size() const override { return temperatures_start() + (heats() ? weights_.state_size() : 0); }
  void start(double* state) const override;
  void begin(const ThermalPoint& at, double* state) const override;
  std::optional<std::string> fault(const ThermalPoint& at, const double* state) const override;
  ThermalForces forces(const ThermalPoint& at, const double* state) const override;
  ThermalResponse respond(const ThermalPoint& at, const double* state) const override;
  ThermalOutput output(const ThermalPoint& at, const double* state) const override;
  void update(const ThermalPoint& at, double* state) const override;

 private:
  static constexpr int work_place = 7;  ///< after C_p^-1 and alpha
  int stretches_start() const { return work_place + (softens_ ? 1 : 0); }
  int temperatures_start() const { return stretches_start() + (constants_.thermoelastic_heating() ? 3 : 0); }
  bool has_start() const { return heats() && weights_.has_start(); }
  /// The end of the step with the temperatures of its start, if the heat needs them.
  ThermalPoint with_start(const ThermalPoint& at, const double* state) const { return HeatWeights::with_start(at, state + temperatures_start()); }

  FiniteJ2 law_at(const ConstantsAtTemperature& constants) const;
  /// Principal elastic strains at the start, with the thermal strain of `constants` taken off.
  Eigen::Vector3d strain_at_start(const ConstantsAtTemperature& constants, const double* state) const;
  /// What the temperatures theta_n of the start give: s chi s(theta_n) sigma_y(alpha_n) x / Delta t + s theta_n (m(E, theta_n) - m(E_n, theta_n)) /
  /// Delta t.
  struct HeatOfStart {
    bool valid = true;                                    ///< false: the constants have no meaning there
    double by_flow = 0.0;                                 ///< of the first part, over x
    double thermoelastic = 0.0;                           ///< the second part
    Eigen::Vector3d by_strain = Eigen::Vector3d::Zero();  ///< its derivative by E, in the axes of the trial
  };
  /// @param strain  principal values of E at the end, elastic and thermal strain
  HeatOfStart heat_of_start(const ThermalPoint& at, const double* state, const Eigen::Vector3d& strain) const;
  /// (1 - s) s(theta) + s s(theta_n), the mean factor of the yield stress over the step.
  double mean_yield_factor(const ConstantsAtTemperature& end, const ThermalPoint& at, const double* state) const;

  ThermalConstants constants_;
  Hardening hardening_;
  double heat_share_;  ///< chi
  bool softens_;       ///< the yield stress depends on the temperature
  HeatWeights weights_;
};

}  // namespace mortise
