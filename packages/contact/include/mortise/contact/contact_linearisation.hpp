#pragma once
// The linearised contact at one iterate: condensed into the bodies' system, or as blocks of a saddle point system.

#include <memory>
#include <utility>

#include "mortise/contact/contact_evaluation.hpp"
#include "mortise/contact/decoupling.hpp"
#include "mortise/core/types.hpp"

namespace mortise {

namespace detail {
struct Condensation;
}  // namespace detail

/// The blocks of the saddle point form: f_c = B(d) z, C_d, C_z on the maps of d and z. B and C_d hold zeros, so that their patterns change only with
/// the candidates.
struct SaddlePointBlocks {
  RCP<Matrix> B;    ///< [dofs x multipliers]
  RCP<Matrix> C_d;  ///< [multipliers x dofs]
  RCP<Matrix> C_z;  ///< [multipliers x multipliers]
};

/// Recovery after condensation: the multipliers of a displacement increment, and further right-hand sides. Collective in all members but the
/// accessors.
class CondensedContact {
 public:
  /// z^{k+1} from the whole displacement increment, with that of prescribed dofs.
  void recover(const Vector& increment, Vector& z_new) const;

  /// True if hardly covered nodes that are in contact have multipliers that depend on one another's. Of these the condensed system has each node's
  /// own alone. It leaves the rest of the linearised conditions out, L(dd, dz) of apply_left_out(). The step of the condensed system then is not
  /// Newton's; it is that of  J~ = J - L. The same on every rank.
  bool leaves_out_couplings() const;
  /// y = L(dd, dz): rows of C.
  void apply_left_out(const Vector& dd, const Vector& dz, Vector& y) const;
  /// The right-hand side of the condensed system for J~ (dd, dz) = -(r, C) with any r and C: `rhs` holds -r and is turned into it. Then recover()
  /// gives dz.
  void condense_right_hand_side(const Vector& C, Vector& rhs);

  /// Data of the condensed system for multigrid.
  Decoupling decoupling() const;

 private:
  friend class ContactLinearisation;
  explicit CondensedContact(std::shared_ptr<detail::Condensation> condensation) : condensation_(std::move(condensation)) {}
  std::shared_ptr<detail::Condensation> condensation_;
};

/// The linearised contact at a displacement and multipliers. Collective in all members.
class ContactLinearisation {
 public:
  /// K += C~ = d(f_c)/dd at fixed z. `system` is on the graph of ContactSystem::graph() for this evaluation, asked for last, and open for changes.
  /// @throws std::logic_error for a matrix on another graph, or one that is complete
  void add_stiffness(Matrix& system) const;

  /// Turns `system` (K~, in rows of prescribed dofs too) and `rhs` (-r without f_c) into the condensed system. Rows of prescribed dofs may be
  /// replaced afterwards, not before.
  /// @throws std::logic_error as add_stiffness(), and where the multipliers of a pair stay unknowns
  CondensedContact condense(Matrix& system, Vector& rhs) const;

  /// Rebuilt at each call.
  SaddlePointBlocks saddle_point_blocks() const;

 private:
  friend class DifferentiatedContact;
  explicit ContactLinearisation(ContactLaws laws) : laws_(std::move(laws)) {}
  ContactLaws laws_;
};

}  // namespace mortise
