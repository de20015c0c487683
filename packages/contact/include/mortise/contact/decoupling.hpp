#pragma once
// What multigrid needs to know of closed contact.

#include "mortise/core/types.hpp"

namespace mortise {

/// A change of unknowns dd = S u and of equations L under which a condensed system A dd = b falls apart (docs/solvers.md). With M^_jl = M_jl / D_jj
/// of a closed slave node j, N_j = n n^T where it slips and the projector on its free components where it sticks, and S = L = I but for
///   S_jl = N_j M^_jl,   L_jj = N_j + F_j + Q_j,   L_lj = -M^_jl Q_j,   F_j the projector on prescribed components:
/// u_j is, in the directions of N_j, the motion of the node relative to the master. Q_j is P_j = I - F_j - N_j without friction. In space friction is
/// a spring across the direction t of slip, next to a share of the node's momentum: Q_j makes it whole, or, where the spring is stiffer, N_j has t
/// t^T too. So the momentum that slave nodes hand to the master is what acts along N_j alone, and that of springs. Entries at prescribed components
/// of the master are left out. All matrices are on the owned dofs and have rows of closed slave nodes only.
struct Decoupling {
  RCP<const Matrix> trial;       ///< S (I - N) - I
  RCP<const Matrix> test;        ///< (I - N) L - I, transposed
  RCP<const Matrix> eliminated;  ///< N, block diagonal
  int dimension = 0;             ///< dofs of a node, which stand together
};

}  // namespace mortise
