#pragma once
// Contributions to the residual and to its Jacobian.

#include <optional>
#include <string>
#include <vector>

#include "mortise/core/dependence.hpp"
#include "mortise/core/error.hpp"
#include "mortise/core/state_archive.hpp"
#include "mortise/core/types.hpp"

namespace mortise {

/// Where a residual is evaluated: the unknowns of all fields.
struct Configuration {
  double time;                                 ///< pseudo-time
  const Vector& unknowns;                      ///< on the owned dofs
  const Vector& local_unknowns;                ///< on owned dofs followed by ghosts
  const Vector* velocity = nullptr;            ///< on the owned dofs; null in a system without time derivatives
  const Vector* local_velocity = nullptr;      ///< on owned dofs followed by ghosts; null likewise
  const Vector* acceleration = nullptr;        ///< on the owned dofs; null likewise
  const Vector* local_acceleration = nullptr;  ///< on owned dofs followed by ghosts; null likewise
};

/// Weights of a Jacobian: alpha dr/d(acceleration) + beta dr/d(velocity) + omega dr/d(unknowns), as Thyra's model evaluators have it.
struct JacobianWeights {
  double acceleration = 0.0;  ///< alpha
  double velocity = 0.0;      ///< beta
  double unknowns = 1.0;      ///< omega
  /// On owned dofs followed by ghosts: factors of beta, as dofs without mass take their velocity by another formula. Null: 1
  const Vector* local_velocity_shares = nullptr;
};

/// Fields and time derivatives that a contribution knows.
struct FieldUse {
  std::vector<std::string> reads = {"displacement"};   ///< names of the fields that it depends on
  std::vector<std::string> writes = {"displacement"};  ///< of those in whose rows it stands
  int time_derivatives = 0;                            ///< the highest that it reads: 0, 1 or 2
};

/// A summand of the residual r(u, du/dt, d2u/dt2, t) = f_int - f_ext (+ f_c). Only those that are wanted are made.
/// Evaluation never changes committed state; failures are put into `failure` (first one kept), the caller agrees on them over the ranks.
class Contribution {
 public:
  /// Part of the residual: of f_int, of f_ext, or acting between bodies. Others than internal ones are evaluated again at each step's start.
  enum class Kind { internal, external, interaction };
  virtual ~Contribution() = default;

  virtual std::string name() const = 0;  ///< by which its calls are counted and timed
  virtual Kind kind() const = 0;         ///< for the norms of forces
  /// What it reads and writes. A system refuses what it does not have.
  virtual FieldUse uses() const { return {}; }

  /// Of internal forces without time derivatives: true if they depend on time beside unknowns and committed state, as heat of plastic flow does on
  /// the length of a step. Those of a step's end are then not those of the next one's start.
  virtual bool depends_on_time() const { return false; }

  /// residual += this contribution with its sign in r (external forces enter with a minus). Owned dofs. Collective.
  /// Internal forces without time derivatives depend on unknowns and committed state, and on time where depends_on_time(). Else commit(at) does not
  /// change those at `at`.
  virtual void add_residual(const Configuration& at, Vector& residual, std::optional<StepFailure>& failure) = 0;

  /// jacobian += the derivatives of the residual with their weights. `jacobian` has the graph that the system was built with, or that and more
  /// (further columns come after its own), and is open for local sums.
  virtual void add_jacobian(const Configuration& at, const JacobianWeights& weights, Matrix& jacobian, std::optional<StepFailure>& failure) = 0;

  /// Both, where one pass is cheaper than two. Collective.
  virtual void add_residual_and_jacobian(const Configuration& at, const JacobianWeights& weights, Vector& residual, Matrix& jacobian,
                                         std::optional<StepFailure>& failure) {
    add_residual(at, residual, failure);
    add_jacobian(at, weights, jacobian, failure);
  }

  /// The step that ended at `at` is accepted.
  virtual void commit(const Configuration&) {}

  /// Stores or restores what it remembers of the last committed step. Collective.
  virtual void serialize(StateArchive&) {}
};

/// Constraints of what turns: unknowns of owned dofs that follow from others by a nonlinear function, as nodes of rigid bodies and of kinematic
/// couplings follow reference points.
class RigidConstraints {
 public:
  virtual ~RigidConstraints() = default;
  /// Owned dofs that follow, ascending; none of them is prescribed.
  virtual const std::vector<LocalOrdinal>& dofs() const = 0;
  /// Owned dofs that others may follow; none of them follows itself.
  virtual const std::vector<LocalOrdinal>& followed() const = 0;
  /// Dependences at unknowns (owned dofs, then ghosts), in the order of dofs().
  virtual std::vector<Dependence> evaluate(const Vector& local_unknowns) const = 0;
  /// Puts into `failure`, if that is empty, why equations of what is followed say nothing at unknowns; the caller agrees on it over the ranks.
  virtual void check(const Vector& local_unknowns, std::optional<StepFailure>& failure) const = 0;
};

}  // namespace mortise
