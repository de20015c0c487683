#pragma once
// F(x) = 0, x = (d, z), at one iterate: an immutable value, and what it is a function of.

#include <array>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "mortise/contact/contact_evaluation.hpp"
#include "mortise/core/types.hpp"
#include "mortise/nonlinear/time_scheme.hpp"

namespace mortise {

class SystemEvaluation;

namespace detail {
struct EvaluatedSystem;
const EvaluatedSystem& evaluated(const SystemEvaluation& evaluation);
}  // namespace detail

/// The residual of one field of several.
struct FieldMerit {
  double merit = 0.0;      ///< (|r|^2 + |s (u - prescribed)|^2)^1/2 of its rows; with sum_j |A_j C_j|^2 in the first field [unit of the rows]
  double reference = 0.0;  ///< what |r| is relative to in ResidualNorms::momentum; likewise
};

/// Sizes of the residual's blocks at one iterate, over all ranks; what the status tests look at. With several fields relative norms are
/// the largest of all; absolute ones are in the units of the first, as if r were s times the size of each.
struct ResidualNorms {
  /// |r| on free dofs relative to max(|f_int|, |f_ext|, |f_c|, |f_rate|, 1e-6 s |d|), reactions included; f_rate has inertia and damping
  double momentum = 0.0;
  double momentum_absolute = 0.0;         ///< |r| on free dofs [force]
  double round_off = 0.0;                 ///< part of momentum_absolute that round-off alone may leave
  double prescribed = 0.0;                ///< max |d - prescribed| and |d - what it follows|, relative to the size of the field
  double gap = 0.0;                       ///< ContactNorms::gap
  double complementarity = 0.0;           ///< ContactNorms::complementarity
  double merit = 0.0;                     ///< (|r|^2 + |s (d - prescribed)|^2 + sum_j |A_j C_j|^2)^1/2, a force; infinite if that is not finite
  std::vector<FieldMerit> fields;         ///< [fields] where there are several, else empty
  int active = 0;                         ///< closed nodes
  int sticking = 0;                       ///< of them
  int changed = 0;                        ///< ContactNorms::changed
  std::array<long long, 2> active_set{};  ///< two hashes of the closed nodes and their states, independent of the partition
  bool finite = true;                     ///< true if all of the residual is
};

/// Arguments of F beside x within a step.
struct StepContext {
  double time = 0.0;                      ///< pseudo-time
  std::optional<ContactHistory> contact;  ///< the history that holds within the step; none without contact
  ContactStates states;                   ///< of the iterate that was linearised last: ResidualNorms::changed counts against them
  std::shared_ptr<const TimeStep> step;   ///< where it starts; null in a system without time derivatives
  /// The field that is solved for, its index in SystemParts::fields, while the others keep their values, and contact its multipliers unless it is the
  /// first. Their rows of F are 0, and norms leave them out. Nothing: all fields.
  std::optional<std::size_t> field;
};

/// A state that was accepted: what the next step starts from.
struct AcceptedState {
  RCP<const Vector> x;                 ///< (d, z)
  StepContext context;                 ///< its time, and the history of contact after it
  RCP<const Vector> internal_forces;   ///< f_int at d, which committing does not change; null: not known
  std::optional<AcceptedRates> rates;  ///< time derivatives of d; none in a system without
};

/// What follows an evaluation. Where it is linearised, internal forces and their stiffness come from one pass over the elements.
enum class StiffnessIs { not_known_to_be_needed, needed_next };

/// F at one x: residual, norms and contact conditions. A value that is cheap to copy and does not change.
class SystemEvaluation {
 public:
  const Vector& x() const;             ///< where
  const StepContext& context() const;  ///< with what
  const Vector& residual() const;      ///< F(x), see SemiSmoothSystem::evaluate()
  const ResidualNorms& norms() const;  ///< its sizes
  /// The contact conditions at x.
  /// @throws std::logic_error without contact
  const ContactLaws& contact_laws() const;
  /// The sum of all forces, as they are in balance, on all owned dofs, those of followers not gathered: f_int - f_ext + f_c without time derivatives,
  /// else see TimeScheme::Balance.
  const Vector& nodal_forces() const;
  /// f_int at x on all owned dofs.
  const Vector& internal_forces() const;
  /// -f_ext at x and the step's end on all owned dofs.
  const Vector& external_forces() const;
  /// Inertia and damping on all owned dofs.
  /// @throws std::logic_error without time derivatives
  const Vector& rate_forces() const;
  /// nodal_forces() without Dirichlet rows. On prescribed dofs, and on all of nodes that inclined supports hold, these are
  /// the reactions, those of followers gathered.
  RCP<Vector> forces() const;

 private:
  friend class SemiSmoothSystem;
  friend class SystemLinearisation;
  friend const detail::EvaluatedSystem& detail::evaluated(const SystemEvaluation& evaluation);
  explicit SystemEvaluation(std::shared_ptr<const detail::EvaluatedSystem> evaluated) : evaluated_(std::move(evaluated)) {}
  std::shared_ptr<const detail::EvaluatedSystem> evaluated_;
};

}  // namespace mortise
