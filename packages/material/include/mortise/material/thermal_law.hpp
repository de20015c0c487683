#pragma once
// Laws that know the temperature, one type for all of them: stress, heat and all derivatives at a point.

#include <limits>
#include <memory>
#include <optional>
#include <string>

#include "mortise/material/material_options.hpp"
#include "mortise/material/tensor_components.hpp"

namespace mortise {

/// Where a law is asked: the end of a step from the last committed state.
struct ThermalPoint {
  Matrix3 F;                                                   ///< deformation gradient, thermal strain included
  double expansion_temperature = 0.0;                          ///< theta of the thermal strain; an F-bar element takes that of its centre
  double temperature = 0.0;                                    ///< theta of everything else
  double time_step = std::numeric_limits<double>::infinity();  ///< Delta t > 0 of rates; infinite: nothing heats
};

/// Stress and heat. Where a law has none, `stress` is not finite.
struct ThermalForces {
  Matrix3 stress = Matrix3::Constant(std::numeric_limits<double>::quiet_NaN());  ///< Kirchhoff stress tau
  double heat = 0.0;       ///< H, power that becomes heat per reference volume: plastic and thermoelastic
  double thickness = 1.0;  ///< F_33 that plane stress finds; 1 otherwise
};

/// With the derivatives. For a change of F by dF = L F (small strain: dF = L)
///   d tau - tau L^T = A : L + stress_by_expansion d theta_e + stress_by_temperature d theta   (small strain: d tau alone on the left),
///   dH = heat_by_gradient : L + heat_by_expansion d theta_e + heat_by_temperature d theta,
/// where theta_e is the temperature of expansion. Plane stress: L has in-plane components only, and derivatives by others are 0.
struct ThermalResponse : ThermalForces {
  Eigen::Matrix<double, 9, 9> tangent = Eigen::Matrix<double, 9, 9>::Zero();  ///< A, in SolidComponents; see StressAndTangent
  Matrix3 stress_by_expansion = Matrix3::Zero();
  Matrix3 stress_by_temperature = Matrix3::Zero();
  Matrix3 heat_by_gradient = Matrix3::Zero();
  double heat_by_expansion = 0.0;
  double heat_by_temperature = 0.0;
};

/// The components of A that a kinematics takes.
template <class Components>
Eigen::Matrix<double, Components::size, Components::size> components_of(const Eigen::Matrix<double, 9, 9>& tangent) {
  if constexpr (Components::size == SolidComponents::size) {
    return tangent;
  } else {
    const auto place = [](int p) { return 3 * Components::row[p] + Components::column[p]; };
    Eigen::Matrix<double, Components::size, Components::size> result;
    for (int q = 0; q < Components::size; ++q)
      for (int p = 0; p < Components::size; ++p) result(p, q) = tangent(place(p), place(q));
    return result;
  }
}

/// Values for output.
struct ThermalOutput : ThermalForces {
  Matrix3 F;            ///< with the out-of-plane stretch of plane stress
  double energy = 0.0;  ///< of elastic strain per reference volume
  double equivalent_plastic_strain = 0.0;
  double plastic_work = 0.0;  ///< per reference volume
};

/// A law with the thermal properties of its material. With theta_0 the reference temperature and the secant coefficient alpha:
///   tau(F, theta) = tau of the law at F_e = exp(-alpha(theta) (theta - theta_0)) F with constants of theta; small strain: e - alpha (theta -
///   theta_0) I.
/// Of laws in logarithmic strain that is e - alpha (theta - theta_0) I too. With psi(F, theta), the energy of that stress,
///   H = chi sigma_y(alpha_p, theta) Delta alpha_p / Delta t + theta (d psi/d theta (F, theta) - d psi/d theta (F_n, theta)) / Delta t,
/// with the accumulated plastic strain alpha_p. The second part is theta (d tau/d theta) : d_e in the limit of short steps; it is unchanged by
/// rotations, as it takes differences of a function of elastic stretches. Source: Simo, Miehe 1992, CMAME 98.
///
/// With the share s of the start of a step
///   H = chi ((1 - s) sigma_y(alpha_p, theta) + s sigma_y(alpha_p,n, theta_n)) Delta alpha_p / Delta t
///       + ((1 - s) theta (m(E, theta) - m(E_n, theta)) + s theta_n (m(E, theta_n) - m(E_n, theta_n))) / Delta t,
/// where m(E, theta) = d psi/d theta and E is F without plastic flow: elastic and thermal strain. Both parts are integrals over the step, of
/// chi sigma_y d alpha_p and of theta (dm/dE) : dE, of which s = 1/2 takes the trapezoidal rule: of second order.
///
/// A point remembers state_size() numbers, which the caller keeps.
class ThermalLaw {
 public:
  virtual ~ThermalLaw() = default;
  virtual bool small_strain() const = 0;
  virtual const char* name() const = 0;         ///< of the law, as people know it
  virtual bool has_plasticity() const = 0;      ///< flows
  virtual bool heats() const = 0;               ///< H may differ from 0
  virtual int state_size() const = 0;           ///< numbers of a point's memory; 0: none
  virtual void start(double* state) const = 0;  ///< puts there the memory of a point that never was deformed, [state_size()]
  /// Puts there the temperatures at which the first step starts, which heat with a share of the start needs.
  virtual void begin(const ThermalPoint& at, double* state) const = 0;
  virtual ThermalForces forces(const ThermalPoint& at, const double* state) const = 0;
  virtual ThermalResponse respond(const ThermalPoint& at, const double* state) const = 0;
  virtual ThermalOutput output(const ThermalPoint& at, const double* state) const = 0;
  /// Moves the memory on to the end of a step that is accepted.
  virtual void update(const ThermalPoint& at, double* state) const = 0;
  /// Property without meaning at the temperatures of a step, with its value and what is allowed; none: all have one.
  virtual std::optional<std::string> fault(const ThermalPoint& at, const double* state) const = 0;
};

/// The law of a material whose ThermomechanicalProperties::given().
/// @param plane_stress  the law finds F_33 from tau_33 = 0; it needs a law with a plane stress form
/// @param share_at_start  s of the heat, 0 <= s < 1
/// @throws std::invalid_argument without a reference temperature, or for plane stress of a law that has no such form
std::unique_ptr<const ThermalLaw> make_thermal_law(const MaterialOptions& material, bool plane_stress, double share_at_start = 0.0);

}  // namespace mortise
