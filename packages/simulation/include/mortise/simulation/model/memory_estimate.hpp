#pragma once
// Memory of linear systems, from counted entries.

namespace mortise {

/// Sizes of a system, of one rank or of all together.
struct SystemSize {
  int dimension = 2;        ///< dofs a node
  double nodes = 0.0;       ///< owned
  double node_pairs = 0.0;  ///< owned nodes with every node of their elements, themselves included: blocks of the stiffness
  bool parallel = false;    ///< the model is shared by several ranks
};

/// Bytes of the system matrix and all that GMRES with multigrid holds beside it at its largest.
double multigrid_bytes(const SystemSize& size);

/// Bytes of the system matrix and all that a direct solver holds beside it at its largest, of the whole model.
double factorisation_bytes(const SystemSize& size);

}  // namespace mortise
