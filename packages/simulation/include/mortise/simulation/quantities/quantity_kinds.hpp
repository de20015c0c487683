#pragma once
// Options of the kinds of quantities that other code looks at.

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "mortise/simulation/quantities/exact_solution.hpp"
#include "mortise/simulation/quantities/quantity.hpp"

namespace mortise {

/// A Cartesian component: x, y (axisymmetric: r, z), in 3D also z.
enum class Component { x, y, z };

/// Sum over the nodes of a set of the forces by which supports act on the bodies: f_int - f_ext + f_c. [force] On a reference point that turns also
/// the moment, counterclockwise. In 3D it is about axes through the point that do not turn, and has no value at full turns of a point that a load
/// `moment` acts on. [force length]
struct Reaction : Quantity {
  enum class Of { x, y, z, rotation, rotation_x, rotation_y, rotation_z };
  Located<std::string> set;
  Of component = Of::y;
  void describe(Parameters& parameters) override;
  std::unique_ptr<QuantityEvaluator> make_evaluator(const QuantityContext& context) const override;
};

/// Common part of quantities of one pair. Its slave surface is where the pair's geometry is: in the current or in the reference configuration.
struct PairQuantity : Quantity {
  Located<std::string> pair;  ///< empty: the only one
  void describe(Parameters& parameters) override;
};

/// Sum of the contact forces on the slave side of a pair, or of the part along the nodes' normals (pressure) or across them (friction). [force]
struct ContactForce : PairQuantity {
  enum class Part { all, normal, tangential };
  Component component = Component::y;
  Part part = Part::all;
  void describe(Parameters& parameters) override;
  std::unique_ptr<QuantityEvaluator> make_evaluator(const QuantityContext& context) const override;
};

/// A number at points: at nodes (displacement), at quadrature points (stress), at slave nodes (contact).
enum class PointField {
  displacement_x,
  displacement_y,
  displacement_z,
  displacement_magnitude,
  temperature,
  stress_xx,
  stress_yy,
  stress_zz,
  stress_xy,
  stress_yz,
  stress_xz,
  von_mises,
  largest_principal_stress,
  middle_principal_stress,
  smallest_principal_stress,
  equivalent_plastic_strain,
  contact_pressure,
  gap
};

/// The field of Extremum and Mean.
struct FieldQuantity : Quantity {
  PointField field = PointField::von_mises;
  Located<std::string> on;  ///< a set of nodes or a body (displacement), a body (stress), a pair (contact); empty: everywhere
  void describe(Parameters& parameters) override;
};

struct Extremum : FieldQuantity {
  enum class Which { maximum, minimum, maximum_absolute };
  static const std::vector<std::pair<std::string, Which>>& names();
  Which which = Which::maximum;
  enum class Gives { value, x, y, z };
  Gives gives = Gives::value;  ///< the extremum, or where it is
  void describe(Parameters& parameters) override;
  std::unique_ptr<QuantityEvaluator> make_evaluator(const QuantityContext& context) const override;
};

/// Of displacement the mean over nodes; of stress over volume; of contact over the slave surface's reference area.
struct Mean : FieldQuantity {
  std::unique_ptr<QuantityEvaluator> make_evaluator(const QuantityContext& context) const override;
};

/// A point of a body, given by its reference position.
struct PointOptions {
  Located<double> x, y;
  std::optional<double> z;    ///< in three dimensions
  Located<std::string> body;  ///< empty: any
  void describe(Parameters& parameters);
};

/// Displacement of a point, interpolated in the element that holds it. [length]
struct PointDisplacement : Quantity {
  PointOptions point;
  Component component = Component::y;
  void describe(Parameters& parameters) override;
  std::unique_ptr<QuantityEvaluator> make_evaluator(const QuantityContext& context) const override;
};

/// Temperature of a point, in the same way. [temperature]
struct PointTemperature : Quantity {
  PointOptions point;
  void describe(Parameters& parameters) override;
  std::unique_ptr<QuantityEvaluator> make_evaluator(const QuantityContext& context) const override;
};

/// || u_h - u || / || u ||, L2: of the contact pressure p_h = sum N_j z_n,j along the slave surface, of displacement or stress over bodies.
/// NaN where || u || = 0.
struct ErrorNorm : Quantity {
  enum class Of { contact_pressure, displacement, stress };
  enum class Unit { length, half_width };
  Of of = Of::contact_pressure;
  Located<std::string> on;         ///< pair, or body (empty: the only pair, all bodies)
  std::optional<double> from, to;  ///< range of x (contact pressure): a length, or half widths of the exact contact zone from its centre
  Unit unit = Unit::length;
  Choice<ExactSolution> exact;
  void describe(Parameters& parameters) override;
  std::unique_ptr<QuantityEvaluator> make_evaluator(const QuantityContext& context) const override;
};

/// Where lengths along a slave surface and tractions on it are measured.
enum class TractionMeasure {
  pair,      ///< where the pair's geometry is: true tractions for the current one
  reference  ///< per undeformed area at undeformed positions, as theories of small strain mean them
};

/// 2 sqrt(int p (x - center)^2 ds / int p ds) along the slave surface: the half width of a Hertzian pressure. [length]
struct HalfWidth : PairQuantity {
  double center = 0.0;
  TractionMeasure measure = TractionMeasure::pair;
  void describe(Parameters& parameters) override;
  std::unique_ptr<QuantityEvaluator> make_evaluator(const QuantityContext& context) const override;
};

/// Nodal pressure, shear traction or component of the traction z of a pair at a position x of its slave surface, linear between nodes. It is 0 where
/// there is no such position, and the mean where there are several. Without x: the one of largest size. [stress]
struct ContactTraction : PairQuantity {
  enum class Part { pressure, shear, x, y };
  std::optional<double> x;
  Part part = Part::pressure;
  TractionMeasure measure = TractionMeasure::pair;
  void describe(Parameters& parameters) override;
  std::unique_ptr<QuantityEvaluator> make_evaluator(const QuantityContext& context) const override;
};

/// Largest nodal pressure; that of p_h = sum N_j z_n,j is the same, as p_h is linear between nodes. [stress]
struct PeakPressure : PairQuantity {
  std::unique_ptr<QuantityEvaluator> make_evaluator(const QuantityContext& context) const override;
};

/// Current length of the slave surface that belongs to closed nodes: of each facet one half for each closed end. [length]
struct ContactLength : PairQuantity {
  std::unique_ptr<QuantityEvaluator> make_evaluator(const QuantityContext& context) const override;
};

/// Area that belongs to closed nodes: their halves of the facets times the thickness or 2 pi r; in 3D sum_k D_jk. [area]
struct ContactArea : PairQuantity {
  std::unique_ptr<QuantityEvaluator> make_evaluator(const QuantityContext& context) const override;
};

/// Radius of a Hertzian pressure of revolution about an axis through `center`, with the normal forces F_j and current positions of the slave nodes:
///   a = sqrt(5/2 sum_j F_j r_j^2 / sum_j F_j).
/// It follows from int p r^2 = 2/5 a^2 int p for p = p_0 sqrt(1 - r^2 / a^2). 3D
/// only. [length]
struct ContactRadius : PairQuantity {
  std::vector<double> center{0.0, 0.0, 0.0};
  std::vector<double> axis{0.0, 0.0, 1.0};
  void describe(Parameters& parameters) override;
  std::unique_ptr<QuantityEvaluator> make_evaluator(const QuantityContext& context) const override;
};

/// Total variation of the nodal pressures along the slave surface: the sum over the facets of |p_2 - p_1|. It is twice the peak for a pressure that
/// rises from nothing and falls to nothing, and more if the pressure oscillates. [stress]
struct PressureVariation : PairQuantity {
  std::unique_ptr<QuantityEvaluator> make_evaluator(const QuantityContext& context) const override;
};

/// A formula of t, the scene's variables and the quantities that the scene names before this one. Not a number where the formula has no value.
struct FormulaQuantity : Quantity {
  Located<std::string> value;
  void describe(Parameters& parameters) override;
  std::unique_ptr<QuantityEvaluator> make_evaluator(const QuantityContext& context) const override;
};

}  // namespace mortise
