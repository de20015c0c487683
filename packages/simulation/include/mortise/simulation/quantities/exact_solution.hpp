#pragma once
// Named exact solutions that error norms measure against.

#include <Eigen/Core>
#include <array>
#include <optional>

#include "mortise/core/parameters.hpp"

namespace mortise {

/// Part of a contact line where the exact pressure is not zero: |x - center| <= half_width.
struct ContactZone {
  double center = 0.0, half_width = 0.0;
};

/// An exact solution. A function that a solution does not know has no value.
struct ExactSolution : Described {
  using Point = std::array<double, 2>;

  /// Contact pressure [stress] at the position `x`.
  virtual std::optional<double> pressure(const Point& /*x*/, double /*time*/) const { return {}; }
  /// Displacement [length] of the reference position `x`.
  virtual std::optional<Point> displacement(const Point& /*x*/, double /*time*/) const { return {}; }
  /// Cauchy stress at the reference position `x`.
  virtual std::optional<Eigen::Matrix3d> stress(const Point& /*x*/, double /*time*/) const { return {}; }
  virtual std::optional<ContactZone> zone(double /*time*/) const { return {}; }
};

/// Hertz's line contact of two cylinders, or of a cylinder and a plane, plane strain. Formulas:
///   1/E' = (1 - nu1^2)/E1 + (1 - nu2^2)/E2,  1/R = 1/R1 + 1/R2,  a = sqrt(4 F R / (pi E')),  p0 = 2 F / (pi a),  p = p0 sqrt(1 - (x/a)^2).
struct HertzLineContact : ExactSolution {
  ScalarFunction load{0.0};  ///< F, of t: force per thickness on the whole contact, both halves
  double radius = 1.0;
  std::optional<double> second_radius;  ///< negative: concave; default: a plane
  double first_youngs_modulus = 1.0, first_poissons_ratio = 0.3, second_youngs_modulus = 1.0, second_poissons_ratio = 0.3;
  double center = 0.0;
  void describe(Parameters& parameters) override;

  double half_width(double time) const;
  double peak(double time) const;
  std::optional<double> pressure(const Point& x, double time) const override;
  std::optional<ContactZone> zone(double time) const override;
};

/// The same stress and contact pressure everywhere.
struct UniformState : ExactSolution {
  ScalarFunction contact_pressure{0.0}, xx{0.0}, yy{0.0}, zz{0.0}, xy{0.0};  ///< of t
  void describe(Parameters& parameters) override;
  std::optional<double> pressure(const Point& x, double time) const override;
  std::optional<Eigen::Matrix3d> stress(const Point& x, double time) const override;
};

/// u = u0 + G X.
struct LinearDisplacement : ExactSolution {
  ScalarFunction x{0.0}, y{0.0}, xx{0.0}, xy{0.0}, yx{0.0}, yy{0.0};  ///< of t: u0 and G = du_i/dX_j
  void describe(Parameters& parameters) override;
  std::optional<Point> displacement(const Point& x, double time) const override;
};

/// Lame's thick ring, plane strain, small strain; also two concentric rings of one material that touch each other without friction. With
/// A = (p_i a^2 - p_o b^2)/(b^2 - a^2)  and  B = (p_i - p_o) a^2 b^2/(b^2 - a^2)  the solution is
///   sigma_r = A - B/r^2,  sigma_theta = A + B/r^2,  sigma_z = 2 nu A,  u_r = (1 + nu)/E ((1 - 2 nu) A r + B/r).
/// The pressure between the rings at r is -sigma_r(r).
struct LameRing : ExactSolution {
  double inner_radius = 1.0, outer_radius = 2.0, youngs_modulus = 1.0, poissons_ratio = 0.3, center_x = 0.0, center_y = 0.0;
  ScalarFunction inner_pressure{0.0}, outer_pressure{0.0};  ///< of t
  void describe(Parameters& parameters) override;
  std::optional<double> pressure(const Point& x, double time) const override;
  std::optional<Point> displacement(const Point& x, double time) const override;
  std::optional<Eigen::Matrix3d> stress(const Point& x, double time) const override;

 private:
  struct Constants {
    double A, B;
  };
  Constants constants(double time) const;
};

/// All exact solutions by name.
const Registry<ExactSolution>& exact_solution_registry();

}  // namespace mortise
