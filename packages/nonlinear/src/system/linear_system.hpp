#pragma once
// The linear system of a Newton step as a pipeline: assemble, add contact, condense, reduce, merge, constrain, solve.

#include <functional>
#include <optional>
#include <vector>

#include "mortise/contact/contact_linearisation.hpp"
#include "mortise/nonlinear/linear_solver.hpp"
#include "mortise/nonlinear/system_linearisation.hpp"
#include "system/system_model.hpp"

namespace mortise::detail {

/// Multipliers that stay unknowns: blocks of the saddle point system, and the right-hand side of the rows of C, as forces.
struct KeptMultipliers {
  SaddlePointBlocks blocks;
  RCP<Vector> rhs;
};

/// A u = b. Each stage takes one and gives the next. The matrix is moved through.
struct LinearSystem {
  RCP<Matrix> matrix;
  bool has_new_pattern = true;  ///< once it is constrained: its entries are not those of the system before
  RCP<Vector> rhs;
  std::vector<LocalOrdinal> prescribed;              ///< owned rows of the matrix
  RCP<Vector> increment;                             ///< [rows of the matrix] of what is prescribed
  MultigridInput multigrid;                          ///< of this matrix
  std::optional<KeptMultipliers> kept;               ///< none: multipliers are condensed, or already merged
  std::shared_ptr<const NodeElimination> condensed;  ///< null: they are kept, or there are none
  RCP<const Matrix> further;                         ///< [dofs x multipliers] of contact contributions; null: none
  /// The way back: dd from u, and dz of kept multipliers. Those that are condensed follow by NodeElimination::complete().
  std::function<void(const Vector& u, Vector& dd, Vector& dz)> recover;
  /// Both ways for further right-hand sides, where nothing is prescribed and followers are where they follow: b from rows of the dofs, dd from u.
  std::function<RCP<Vector>(const Vector& rows)> restricted;
  std::function<RCP<Vector>(const Vector& u)> prolonged;
};

/// K dd = -r with the prescribed increments that F asks for. Dofs that are held, none of which follows others, are prescribed not to move.
LinearSystem assembled(const SystemModel& model, const std::shared_ptr<const EvaluatedSystem>& at, const Vector& F,
                       const std::vector<LocalOrdinal>& held);

/// The linearised contact. Multipliers are condensed,
///   (K + C~ condensed) dd = rhs,   dz from dd,
/// or kept:
///   ( K + C~  B ) dd   -r
///   ( C_d   C_z ) dz = -C    with the rows of C as forces, A_j C.
LinearSystem with_contact(const SystemModel& model, const EvaluatedSystem& at, const Vector& F, GeometricContactStiffness geometric_stiffness,
                          LinearSystem system);

/// With dd = T dq + d0 for what follows: see FollowedUnknowns.
LinearSystem reduced(const SystemModel& model, const EvaluatedSystem& at, LinearSystem system);

/// Blocks of kept multipliers in one matrix.
LinearSystem merged(const SystemModel& model, LinearSystem system);

/// Prescribed rows become s u = s increment, their columns go to the right-hand side.
LinearSystem constrained(const SystemModel& model, LinearSystem system);

}  // namespace mortise::detail
