#pragma once
// J2 plasticity that knows the temperature.

#include "thermal_elasticity.hpp"

namespace mortise {

/// The law FiniteJ2 at F_e = exp(p) F with constants of the temperature and the yield stress s(theta) sigma_y(alpha). As thermal strain is spherical,
/// C_p^-1 does not see it. With the trial strain e, n = dev e / |dev e|, q = sqrt(6) G |dev e|, H = s dsigma_y/dalpha and Y = s' sigma_y,
///   d x / d e = 2 G sqrt(3/2) n / (3 G + H),   d x / d theta = (q G'/G - 3 G' x - Y) / (3 G + H)
/// follow from q - 3 G x - s sigma_y(alpha + x) = 0.
/// A point remembers C_p^-1, alpha, the plastic work if it is no function of alpha, and the principal elastic stretches if elastic strain heats.
class ThermalJ2Law final : public ThermalLaw {
 public:
  explicit ThermalJ2Law(const MaterialOptions& material);

  bool small_strain() const override { return false; }
  const char* name() const override { return FiniteJ2::name; }
  bool has_plasticity() const override { return true; }
  bool heats() const override { return heat_share_ > 0.0 || constants_.thermoelastic_heating(); }
  int state_size() const override { return stretches_start() + (constants_.thermoelastic_heating() ? 3 : 0); }
  void start(double* state) const override;
  std::optional<std::string> fault(const ThermalPoint& at) const override { return constants_.fault(at); }
  ThermalForces forces(const ThermalPoint& at, const double* state) const override;
  ThermalResponse respond(const ThermalPoint& at, const double* state) const override;
  ThermalOutput output(const ThermalPoint& at, const double* state) const override;
  void update(const ThermalPoint& at, double* state) const override;

 private:
  static constexpr int work_place = 7;  ///< after C_p^-1 and alpha
  int stretches_start() const { return work_place + (softens_ ? 1 : 0); }

  FiniteJ2 law_at(const ConstantsAtTemperature& constants) const;
  /// Principal elastic strains at the start, with the thermal strain of the end taken off.
  Eigen::Vector3d strain_at_start(const ConstantsAtTemperature& constants, const double* state) const;

  ThermalConstants constants_;
  Hardening hardening_;
  double heat_share_;  ///< chi
  bool softens_;       ///< the yield stress depends on the temperature
};

}  // namespace mortise
