#pragma once
// The kinds of quantities.

#include <array>
#include <functional>
#include <memory>
#include <optional>

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
  void prepare(const QuantityContext& context) override;
  double evaluate(const QuantityContext& context) override;
};

/// Rotation of a reference point since the start, counterclockwise. [degrees]
struct Rotation : Quantity {
  Located<std::string> point;
  Component component = Component::z;
  void describe(Parameters& parameters) override;
  void prepare(const QuantityContext& context) override;
  double evaluate(const QuantityContext& context) override;
};

/// Sum of the contact forces on the slave side of a pair, or of the part along the nodes' normals (pressure) or across them (friction). [force]
struct ContactForce : Quantity {
  enum class Part { all, normal, tangential };
  Located<std::string> pair;  ///< empty: the only one
  Component component = Component::y;
  Part part = Part::all;
  void describe(Parameters& parameters) override;
  void prepare(const QuantityContext& context) override;
  double evaluate(const QuantityContext& context) override;

 private:
  std::size_t pair_ = 0;
};

/// How far forces are from balance. With f_c the contact forces on all nodes:
///   - contact: |sum f_c| / (1/2 sum |f_c|);
///   - total: |sum of loads + sum of reactions on prescribed dofs| / the larger sum of absolute values;
///   - both: the larger of the two.
/// Components in which bodies balance: both, axisymmetric the axial one (total).
struct MomentumImbalance : Quantity {
  enum class Of { contact, total, both };
  Of of = Of::both;
  void describe(Parameters& parameters) override;
  void prepare(const QuantityContext& context) override;
  double evaluate(const QuantityContext& context) override;
};

/// A number at points: at nodes (displacement), at quadrature points (stress), at slave nodes (contact).
enum class PointField {
  displacement_x,
  displacement_y,
  displacement_z,
  displacement_magnitude,
  stress_xx,
  stress_yy,
  stress_zz,
  stress_xy,
  stress_yz,
  stress_xz,
  von_mises,
  equivalent_plastic_strain,
  contact_pressure,
  gap
};

/// What Extremum and Mean look at.
struct FieldQuantity : Quantity {
  PointField field = PointField::von_mises;
  Located<std::string> on;  ///< a set of nodes or a body (displacement), a body (stress), a pair (contact); empty: everywhere
  void describe(Parameters& parameters) override;
  void prepare(const QuantityContext& context) override;

 protected:
  /// Calls visit(value, weight) for the points of this rank. Weights: 1, current volume, or A_j.
  void visit(const QuantityContext& context, const std::function<void(double, double)>& visit) const;

 private:
  std::optional<LocalOrdinal> body_;
  std::optional<std::size_t> pair_;
};

struct Extremum : FieldQuantity {
  enum class Which { maximum, minimum, maximum_absolute };
  static const std::vector<std::pair<std::string, Which>>& names();
  Which which = Which::maximum;
  void describe(Parameters& parameters) override;
  double evaluate(const QuantityContext& context) override;
};

/// Of displacement the mean over nodes; of stress over volume; of contact over the slave surface's reference area.
struct Mean : FieldQuantity {
  double evaluate(const QuantityContext& context) override;
};

/// max |sigma_ij - mean sigma_ij| / max |mean sigma_kl| over all quadrature points, all components (33 as well); the mean is weighted by volume.
struct Spread : Quantity {
  Located<std::vector<std::string>> bodies;  ///< empty: all
  void describe(Parameters& parameters) override;
  void prepare(const QuantityContext& context) override;
  double evaluate(const QuantityContext& context) override;

 private:
  std::vector<char> chosen_;  ///< [blocks]
};

/// Displacement of a point, given by its reference position, interpolated in the element that holds it. [length]
struct PointDisplacement : Quantity {
  Located<double> x, y;
  std::optional<double> z;    ///< in three dimensions
  Located<std::string> body;  ///< empty: any
  Component component = Component::y;
  void describe(Parameters& parameters) override;
  void prepare(const QuantityContext& context) override;
  double evaluate(const QuantityContext& context) override;

 private:
  int owner_ = 0;                    ///< rank whose element holds the point
  std::vector<LocalOrdinal> nodes_;  ///< of the element, on that rank
  std::vector<double> shares_;       ///< N_a at the point
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
  void prepare(const QuantityContext& context) override;
  double evaluate(const QuantityContext& context) override;

 private:
  bool is_known(double time) const;
  double pressure_error(const QuantityContext& context) const;
  double body_error(const QuantityContext& context) const;
  std::optional<LocalOrdinal> body_;
  std::size_t pair_ = 0;
};

/// What quantities of one pair share. Those along a line are of plane scenes only. Its slave surface stands where the pair's geometry is: in the
/// current or in the reference configuration.
struct PairQuantity : Quantity {
  Located<std::string> pair;  ///< empty: the only one
  void describe(Parameters& parameters) override;
  void prepare(const QuantityContext& context) override;

 protected:
  /// Whether it has a meaning in 2D (axisymmetric scenes included), and in 3D.
  virtual bool in_plane() const { return true; }
  virtual bool in_space() const { return false; }
  std::size_t pair_ = 0;
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
  double evaluate(const QuantityContext& context) override;
};

/// Half width of the part of the contact zone that sticks: 2 sqrt(int s (x - m)^2 ds / int s ds). Here s = rho - |z_tau| is what is left of the
/// friction bound, and m is its middle. In Cattaneo's and Mindlin's solution s is a Hertzian distribution of just that half width. [length]
struct StickHalfWidth : PairQuantity {
  TractionMeasure measure = TractionMeasure::pair;
  void describe(Parameters& parameters) override;
  double evaluate(const QuantityContext& context) override;
};

/// Nodal pressure, shear traction or component of the traction z of a pair at a position x of its slave surface, linear between nodes. It is 0 where
/// there is no such position, and the mean where there are several. Without x: the one of largest size. [stress]
struct ContactTraction : PairQuantity {
  enum class Part { pressure, shear, x, y };
  std::optional<double> x;
  Part part = Part::pressure;
  TractionMeasure measure = TractionMeasure::pair;
  void describe(Parameters& parameters) override;
  double evaluate(const QuantityContext& context) override;
};

/// Largest nodal pressure; that of p_h = sum N_j z_n,j is the same, as p_h is linear between nodes. [stress]
struct PeakPressure : PairQuantity {
  bool in_space() const override { return true; }
  double evaluate(const QuantityContext& context) override;
};

/// Current length of the slave surface that belongs to closed nodes: of each facet one half for each closed end. [length]
struct ContactLength : PairQuantity {
  double evaluate(const QuantityContext& context) override;
};

/// Area that belongs to closed nodes: their halves of the facets times the thickness or 2 pi r; in 3D sum_k D_jk. [area]
struct ContactArea : PairQuantity {
  bool in_space() const override { return true; }
  double evaluate(const QuantityContext& context) override;
};

/// Radius of a Hertzian pressure of revolution about an axis through `center`,
///   a = sqrt(5/2 sum_j F_j r_j^2 / sum_j F_j),
/// with the normal forces F_j and current positions of the slave nodes. It follows from int p r^2 = 2/5 a^2 int p for p = p_0 sqrt(1 - r^2 / a^2). 3D
/// only. [length]
struct ContactRadius : PairQuantity {
  std::vector<double> center{0.0, 0.0, 0.0};
  std::vector<double> axis{0.0, 0.0, 1.0};
  void describe(Parameters& parameters) override;
  bool in_plane() const override { return false; }
  bool in_space() const override { return true; }
  double evaluate(const QuantityContext& context) override;
};

/// Total variation of the nodal pressures along the slave surface: the sum over the facets of |p_2 - p_1|. It is twice the peak for a pressure that
/// rises from nothing and falls to nothing, and more if the pressure oscillates. [stress]
struct PressureVariation : PairQuantity {
  double evaluate(const QuantityContext& context) override;
};

/// Number of closed slave nodes.
struct ActiveCount : PairQuantity {
  bool in_space() const override { return true; }
  double evaluate(const QuantityContext& context) override;
};

/// A formula of t, the scene's variables and the quantities that the scene names before this one. Not a number where the formula has no value.
struct FormulaQuantity : Quantity {
  Located<std::string> value;
  void describe(Parameters& parameters) override;
  void prepare(const QuantityContext& context) override;
  double evaluate(const QuantityContext& context) override;

 private:
  std::optional<ScalarFunction> formula_;
};

/// The largest or smallest value that another quantity had at the end of any step so far; steps at which it was not a number are left out.
struct OverTime : Quantity {
  Located<std::string> quantity;  ///< named before this one
  Extremum::Which which = Extremum::Which::maximum;
  void describe(Parameters& parameters) override;
  void prepare(const QuantityContext& context) override;
  double evaluate(const QuantityContext& context) override;

 private:
  std::size_t index_ = 0;
  std::optional<double> extreme_;
};

/// Energies and works since the start. Works are sums of 1/2 (f_old + f) . (d - d_old) over the steps, the trapezoidal rule. So
///   external work = internal work + friction - (work of contact pressures on both sides)
/// holds to the tolerance of momentum, whatever the step. [work]
struct Energy : Quantity {
  enum class Of {
    stored,         ///< int W dV0
    plastic_work,   ///< int int_0^alpha sigma_y dalpha dV0
    friction,       ///< of the shear tractions of all pairs with friction
    external_work,  ///< of loads and supports
    internal_work   ///< of the internal forces
  };
  Of of = Of::stored;
  Located<std::string> body;  ///< stored energy and plastic work only; empty: all
  void describe(Parameters& parameters) override;
  void prepare(const QuantityContext& context) override;
  double evaluate(const QuantityContext& context) override;

 private:
  RCP<Vector> force(const QuantityContext& context) const;
  std::optional<LocalOrdinal> body_;
  double work_ = 0.0;
  RCP<Vector> force_, displacement_;  ///< at the last step
};

/// What is missing in the balance of works, over the largest of them:
///   - internal_work: external work - internal work - friction. It is what contact pressures have done, which is nothing where surfaces touch all
///     over.
///   - stored_and_plastic: external work - stored - plastic work - friction. It counts besides what F-bar, without a potential, and the steps of the
///     flow rule make of internal work.
/// NaN while nothing has been done.
struct EnergyError : Quantity {
  enum class Against { internal_work, stored_and_plastic };
  Against against = Against::internal_work;
  void describe(Parameters& parameters) override;
  void prepare(const QuantityContext& context) override;
  double evaluate(const QuantityContext& context) override;

 private:
  std::vector<Energy> spent_;
  Energy external_;
};

}  // namespace mortise
