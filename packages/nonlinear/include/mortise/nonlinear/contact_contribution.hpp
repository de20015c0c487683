#pragma once
// Contributions to the residual that depend on what contact does.

#include <optional>
#include <string>

#include "mortise/contact/contact_evaluation.hpp"
#include "mortise/contact/contact_linearisation.hpp"
#include "mortise/core/error.hpp"
#include "mortise/core/state_archive.hpp"
#include "mortise/core/types.hpp"
#include "mortise/nonlinear/contribution.hpp"

namespace mortise {

/// A summand r(u, z) of the residual in rows of other fields than the displacement: D, M, gaps, slips and multipliers of contact enter, as into the
/// heat across pairs. It has the weight 1 of contact in any time scheme. Collective in all members but name() and uses().
class ContactContribution {
 public:
  /// Derivatives of r. Null: it has none.
  struct Derivatives {
    RCP<const Matrix> of_unknowns;     ///< [dofs squared]
    RCP<const Matrix> of_multipliers;  ///< [dofs x multipliers]
  };
  virtual ~ContactContribution() = default;

  virtual std::string name() const = 0;  ///< for messages
  virtual FieldUse uses() const = 0;     ///< fields that it knows; a system refuses what it does not have

  /// residual += r, on the owned dofs. Failures as those of Contribution::add_residual().
  virtual void add_residual(const ContactLaws& laws, const Configuration& at, Vector& residual, std::optional<StepFailure>& failure) = 0;

  /// Derivatives at the same place. Their entries have places in ContactSystem::graph().
  virtual Derivatives differentiate(const ContactLinearisation& linearised, const Configuration& at, std::optional<StepFailure>& failure) = 0;

  /// The step that ended at `at` is accepted.
  virtual void commit(const ContactLaws&, const Configuration&) {}

  /// Stores or restores what it remembers of the last committed step.
  virtual void serialize(StateArchive&) {}
};

}  // namespace mortise
