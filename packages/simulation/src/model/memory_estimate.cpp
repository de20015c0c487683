#include "mortise/simulation/model/memory_estimate.hpp"

#include <algorithm>
#include <cmath>

#include "mortise/core/types.hpp"

namespace mortise {
namespace {

/// Value and column of each entry of a matrix on the nodes' pairs.
double matrix_bytes(const SystemSize& size) {
  return (sizeof(double) + sizeof(LocalOrdinal)) * static_cast<double>(size.dimension * size.dimension) * size.node_pairs;
}

}  // namespace

// The system matrix, that of multigrid, and what multigrid takes at its peak, while it makes its first coarse matrix C_1 = P^T C P. These are the
// prolongator P, the product C P, and the copy by which Tpetra gives back what it allocated too much for that. Together as much as 5 of the first, or
// 7 where rows travel between ranks (measured: docs/scaling.md). The basis of GMRES is allocated later, in the place of C P, which is larger.
double multigrid_bytes(const SystemSize& size) { return (size.parallel ? 7.0 : 5.0) * matrix_bytes(size); }

// Nested dissection (George 1973) cuts a square of n^2 = N nodes by a cross of lines, a cube of n^3 = N by three planes, and goes on in the parts. A
// separator of s nodes in a part whose neighbours outside are b separator nodes brings s^2 / 2 + s b blocks to L. A square whose f of four sides are
// cut brings so 1.75 + 1.5 f times the square of its side, a cube with f of six 2.875 + 1.75 f times the fourth power. On level k = 0, 1, ... the
// parts have f = 4 (1 - 2^-k) or 6 (1 - 2^-k) on average; summed over the levels:
//   square  |L| = 7.75 N log2(n) - 12 N,    cube  |L| = (2.875 * 2 + 10.5 * (2 - 4/3)) N^(4/3) = 12.75 N^(4/3).
// While the last separator, a dense block of n^2 or n^4, is eliminated, the contributions of its two neighbours, as large as itself, have just been
// summed up. L and U are stored alike. The matrix is there three times: in Tpetra's form, as row, column and value, and as MUMPS sorts it.
double factorisation_bytes(const SystemSize& size) {
  const double N = std::max(size.nodes, 1.0), of_matrix = 0.5 * size.node_pairs;
  const bool plane = size.dimension == 2;
  const double L = plane ? (7.75 * 0.5 * std::log2(N) - 12.0) * N : 12.75 * std::pow(N, 4.0 / 3.0);
  const double stack = 3.0 * (plane ? N : std::pow(N, 4.0 / 3.0));
  const double blocks = 2.0 * std::max(L, of_matrix) + stack;
  return 3.0 * matrix_bytes(size) + sizeof(double) * static_cast<double>(size.dimension * size.dimension) * blocks;
}

}  // namespace mortise
