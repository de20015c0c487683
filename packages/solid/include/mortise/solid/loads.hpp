#pragma once
// External loads: forces on nodes and surfaces, moments, dead tractions, follower pressures, gravity, rotation.

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "mortise/core/parameters.hpp"
#include "mortise/solid/bodies.hpp"

namespace mortise {

/// A load on bodies. Every rank computes the sides and elements that touch its nodes and writes only the rows it owns.
/// A function without a finite value is put into `failure` if that is empty (kind input); nothing throws on one rank only.
class Load {
 public:
  virtual ~Load() = default;

  /// residual -= f_ext on owned dofs, at pseudo-time `time`.
  virtual void add_residual(double time, const Vector& local_displacement, Vector& residual, std::optional<StepFailure>& failure) const = 0;

  /// matrix -= factor d f_ext / d displacement; `matrix` has the graph of the bodies. Does nothing for loads that do not follow the deformation.
  virtual void add_jacobian(double /*time*/, const Vector& /*local_displacement*/, Matrix& /*matrix*/, std::optional<StepFailure>& /*failure*/,
                            double /*factor*/ = 1.0) const {}

  /// True if add_jacobian does something.
  virtual bool follows() const { return false; }

  /// True if the load is weight. Without inertia it is that of what has a density. With inertia it is mass times add_acceleration(), so that a body
  /// in free fall bears no stress, whichever of its nodes have mass.
  virtual bool is_weight() const { return false; }
  /// acceleration += that of the weight on the owned dofs, at pseudo-time `time`.
  virtual void add_acceleration(double /*time*/, Vector& /*acceleration*/, std::optional<StepFailure>& /*failure*/) const {}
};

/// A load by its parameters; each kind declares its parameters.
struct LoadOptions : Described {
  /// Makes the load. Collective. Throws InputError on all ranks for sets and bodies that do not exist, and for a z in 2D.
  virtual std::unique_ptr<Load> make(const std::shared_ptr<const Bodies>& bodies) const = 0;
};

/// One force on each node of a set. Axisymmetric: the force on the whole circle. [force]
struct NodalForceOptions : LoadOptions {
  Located<std::string> set;
  ScalarFunction x, y;              ///< of t and the node's reference position
  std::optional<ScalarFunction> z;  ///< only in three dimensions
  void describe(Parameters& parameters) override;
  std::unique_ptr<Load> make(const std::shared_ptr<const Bodies>& bodies) const override;
};

/// A moment of fixed direction on a reference point that rotates. [force length]
struct MomentOptions : LoadOptions {
  Located<std::string> point;
  std::optional<ScalarFunction> moment;                        ///< of t; in 2D
  std::array<std::optional<ScalarFunction>, 3> moment_vector;  ///< of t; in 3D, about axes that do not turn; no value: 0
  void describe(Parameters& parameters) override;
  std::unique_ptr<Load> make(const std::shared_ptr<const Bodies>& bodies) const override;
};

/// Force per reference area, of fixed direction. [stress]
struct DeadTractionOptions : LoadOptions {
  Located<std::string> set;
  ScalarFunction x, y;              ///< of t and the reference position
  std::optional<ScalarFunction> z;  ///< only in three dimensions
  void describe(Parameters& parameters) override;
  std::unique_ptr<Load> make(const std::shared_ptr<const Bodies>& bodies) const override;
};

/// A force of fixed direction on a whole surface, spread evenly over its reference area. Axisymmetric: the force on the whole circle. [force]
struct SurfaceForceOptions : LoadOptions {
  Located<std::string> set;
  ScalarFunction x, y;              ///< of t
  std::optional<ScalarFunction> z;  ///< only in three dimensions
  void describe(Parameters& parameters) override;
  std::unique_ptr<Load> make(const std::shared_ptr<const Bodies>& bodies) const override;
};

/// Pressure on the current surface, against its current outward normal. [stress]
/// f_ext_a = - integral of N_a p n dgamma; in 2D the thickness is the reference one.
struct FollowerPressureOptions : LoadOptions {
  Located<std::string> set;
  ScalarFunction pressure;  ///< of t and the reference position
  void describe(Parameters& parameters) override;
  std::unique_ptr<Load> make(const std::shared_ptr<const Bodies>& bodies) const override;
};

/// Weight: density times acceleration. [length / time^2]
struct GravityOptions : LoadOptions {
  Located<std::string> body;        ///< empty: every body
  ScalarFunction x, y;              ///< acceleration, of t
  std::optional<ScalarFunction> z;  ///< only in three dimensions
  void describe(Parameters& parameters) override;
  std::unique_ptr<Load> make(const std::shared_ptr<const Bodies>& bodies) const override;
};

/// The centrifugal force on bodies that turn at a given speed about a fixed axis, seen from the frame that turns with them: density times speed squared
/// times the current distance from the axis. [1 / time]
struct CentrifugalOptions : LoadOptions {
  Located<std::string> body;        ///< empty: every body with a density
  ScalarFunction speed;             ///< of t, in radians
  std::vector<double> point, axis;  ///< a point of the axis, empty: the origin; its direction, in 3D alone
  void describe(Parameters& parameters) override;
  std::unique_ptr<Load> make(const std::shared_ptr<const Bodies>& bodies) const override;
};

/// All kinds by name: "nodal force", "surface force", "moment", "dead traction", "follower pressure", "gravity", "centrifugal".
const Registry<LoadOptions>& load_registry();

}  // namespace mortise
