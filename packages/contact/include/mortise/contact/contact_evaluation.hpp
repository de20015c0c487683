#pragma once
// Contact at one displacement, and its conditions at given multipliers: immutable values.

#include <memory>
#include <optional>
#include <utility>

#include "mortise/contact/contact_history.hpp"
#include "mortise/core/error.hpp"
#include "mortise/core/types.hpp"

namespace mortise {

class ContactEvaluation;
class ContactLaws;
class ContactLinearisation;

namespace detail {
struct EvaluatedContact;
struct EvaluatedLaws;
const EvaluatedContact& evaluated(const ContactEvaluation& evaluation);
const EvaluatedLaws& evaluated(const ContactLaws& laws);
}  // namespace detail

/// Norms and counts at one iterate, over all ranks.
struct ContactNorms {
  double gap = 0.0;  ///< max |g_j| / (A_j h) over closed nodes of pairs that hold exactly
  double complementarity =
      0.0;                 ///< max |C| relative to max |z| (with a floor), without C_n of closed nodes that are not regularised: that is the gap
  double force = 0.0;      ///< |f_c|
  double violation = 0.0;  ///< |A_j C_j| over all nodes [force]
  int active = 0;          ///< closed nodes
  int sticking = 0;        ///< of them
  int changed = 0;         ///< nodes whose state is not the one they are compared with
};

/// The mortar matrices of a pair. Let u be the values of a field at nodes. Then (D u - M u)_j is the weighted jump of the field from the master to
/// slave node j. A flux q_j across the interface enters the rows of the nodes as D^T q - M^T q. Rows of D and of M have the same sum.
struct MortarMatrices {
  RCP<const Matrix> D;  ///< [slave nodes with a multiplier x nodes]
  RCP<const Matrix> M;  ///< [slave nodes with a multiplier x nodes]
};

/// The integrals of all pairs at a displacement: D, M, gaps, normals, slips. A function of the displacement and of the history alone. Collective in
/// all members.
class ContactEvaluation {
 public:
  /// States, bounds, residual rows and their partial derivatives of all nodes at multipliers z: once for each iterate.
  ContactLaws laws(const Vector& z) const;
  /// r += f_c(d, z) on the owned dofs.
  void add_force(const Vector& z, Vector& r) const;
  /// D and M of a pair, which couple other fields than displacements too. Rows are on the rank that owns the node, columns by the ids of nodes.
  MortarMatrices mortar_matrices(std::size_t pair) const;
  /// The parts of z across the normals, of pairs with friction; 0 elsewhere.
  RCP<Vector> shear_tractions(const Vector& z) const;
  /// The same integrals with a history that differs in what ContactSystem::augment() and allow_overlap() change.
  ContactEvaluation with(const ContactHistory& history) const;
  /// Multipliers z follow what is covered. Those of nodes that are not covered become 0. Those of nodes that are covered, and were not when `last`
  /// was taken, take the mean that they are tied to, if that keeps them closed. Only pairs with ties. True, on every rank, if any did.
  bool follow_cover(const ContactStates& last, Vector& z) const;

 protected:
  friend class ContactSystem;
  friend const detail::EvaluatedContact& detail::evaluated(const ContactEvaluation& evaluation);
  /// ContactSystem makes them.
  explicit ContactEvaluation(std::shared_ptr<const detail::EvaluatedContact> evaluated) : evaluated_(std::move(evaluated)) {}
  std::shared_ptr<const detail::EvaluatedContact> evaluated_;  ///< evaluated pairs and conditions
};

/// An evaluation that has the derivatives of its integrals with respect to the displacement.
class DifferentiatedContact : public ContactEvaluation {
 public:
  /// The linearised contact at the multipliers of `laws`, which are laws of this evaluation.
  /// @throws std::logic_error for laws of another one; StepFailure on every rank where a law of friction has no bound
  ContactLinearisation linearise(const ContactLaws& laws) const;
  /// As ContactEvaluation::with().
  DifferentiatedContact with(const ContactHistory& history) const;

 private:
  friend class ContactSystem;
  using ContactEvaluation::ContactEvaluation;
};

/// The conditions of all nodes at one displacement and multipliers. Collective in all members but the accessors.
class ContactLaws {
 public:
  /// States of the nodes.
  ContactStates states() const;
  /// C(d, z); rows in units of traction. NaN where a law of friction has no bound.
  void complementarity(Vector& C) const;
  /// r += f_c(d, z) on the owned dofs.
  void add_force(Vector& r) const;
  /// Norms and counts; `changed` counts nodes whose state is another one than in `last`. Two reductions.
  ContactNorms norms(const ContactStates& last) const;
  /// Error of the law of friction at a node of this rank where it has no bound (kind input); nothing where there is none.
  std::optional<StepFailure> friction_failure() const;
  const Vector& multipliers() const;            ///< z
  const ContactEvaluation& evaluation() const;  ///< whose laws they are

 private:
  friend class ContactEvaluation;
  friend class DifferentiatedContact;
  friend const detail::EvaluatedLaws& detail::evaluated(const ContactLaws& laws);
  explicit ContactLaws(std::shared_ptr<const detail::EvaluatedLaws> laws) : laws_(std::move(laws)) {}
  std::shared_ptr<const detail::EvaluatedLaws> laws_;
};

}  // namespace mortise
