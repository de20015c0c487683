#pragma once
// Data of closed contact for multigrid.

#include "mortise/core/types.hpp"

namespace mortise {

/// A change of unknowns dd = S u and of equations L under which a condensed system A dd = b falls apart (docs/solvers.md). Of a closed slave node j
/// let M^_jl = M_jl / D_jj. Let N_j be n n^T where it slips and the projector on its free components where it sticks. F_j is the projector on
/// prescribed components. S = L = I but for
///   S_jl = N_j M^_jl,   L_jj = N_j + F_j + Q_j,   L_lj = -M^_jl Q_j.
/// In the directions of N_j, u_j is the motion of the node relative to the master. Without friction Q_j is P_j = I - F_j - N_j. In 3D friction is a
/// spring across the direction t of slip, next to a share of the node's momentum. There Q_j makes the momentum whole, or, where the spring is
/// stiffer, N_j has t t^T too. So what slave nodes transfer to the master is the momentum along N_j alone, and that of springs. Entries at prescribed
/// components of the master are left out. All matrices are on the owned dofs and have rows of closed slave nodes only.
struct Decoupling {
  RCP<const Matrix> trial;       ///< S (I - N) - I
  RCP<const Matrix> test;        ///< (I - N) L - I, transposed
  RCP<const Matrix> eliminated;  ///< N, block diagonal
  int dimension = 0;             ///< dofs of a node, which stand together
};

}  // namespace mortise
