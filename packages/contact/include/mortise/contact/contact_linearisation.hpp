#pragma once
// The linearised contact at one iterate: condensed into the bodies' system, or as blocks of a saddle point system.

#include <utility>

#include "mortise/contact/contact_evaluation.hpp"
#include "mortise/contact/node_elimination.hpp"
#include "mortise/core/types.hpp"

namespace mortise {

/// The blocks of the saddle point form: f_c = B(d) z, C_d, C_z on the maps of d and z. B and C_d hold zeros, so that their patterns change only with
/// the candidates.
struct SaddlePointBlocks {
  RCP<Matrix> B;    ///< [dofs x multipliers]
  RCP<Matrix> C_d;  ///< [multipliers x dofs]
  RCP<Matrix> C_z;  ///< [multipliers x multipliers]
};

/// The linearised contact at a displacement and multipliers. Collective in all members.
class ContactLinearisation {
 public:
  /// K += C~ = d(f_c)/dd at fixed z. `system` is on the graph of ContactSystem::graph() for this evaluation, asked for last, and open for changes.
  /// @throws std::logic_error for a matrix on another graph, or one that is complete
  void add_stiffness(Matrix& system) const;

  /// Turns `system` (K~, in rows of prescribed dofs too) and `rhs` (-r without f_c) into the condensed system, and gives how its multipliers follow.
  /// It is made of the momentum rows of `system`, which it replaces: once for a matrix. Rows of prescribed dofs may be replaced afterwards, not
  /// before.
  /// @throws std::logic_error as add_stiffness(), and where the multipliers of a pair stay unknowns
  NodeElimination condense(Matrix& system, Vector& rhs) const;

  /// Rebuilt at each call.
  SaddlePointBlocks saddle_point_blocks() const;

  const ContactLaws& laws() const { return laws_; }  ///< that are linearised

 private:
  friend class DifferentiatedContact;
  explicit ContactLinearisation(ContactLaws laws) : laws_(std::move(laws)) {}
  ContactLaws laws_;
};

}  // namespace mortise
