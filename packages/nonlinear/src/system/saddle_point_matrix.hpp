#pragma once
// The linear system of (d, z) as one matrix.

#include <array>
#include <vector>

#include "mortise/core/types.hpp"

namespace mortise::detail {

/// Numbers the rows of two maps as those of one map without gaps, which linear solvers ask for. On each rank those of the first map come first, then
/// those of the second. Collective in all members.
class SaddlePointMatrix {
 public:
  SaddlePointMatrix(RCP<const Map> first, RCP<const Map> second);

  /// ( A  B ; S C  S D ) with the diagonal S on the second rows. A, B are on the rows of the first map, C, D on those of the second, all filled;
  /// the result is filled. It is the same matrix with new values as long as the blocks have the same entries.
  RCP<Matrix> merged(const Matrix& A, const Matrix& B, const Matrix& C, const Matrix& D, const Vector& S);

  RCP<Vector> merged(const Vector& first, const Vector& second) const;
  void split(const Vector& both, Vector& first, Vector& second) const;

 private:
  using Blocks = std::array<const Matrix*, 4>;
  void build(const Blocks& blocks);
  std::vector<GlobalOrdinal> column_ids(const Matrix& block, const Vector& ids) const;

  RCP<const Map> first_, second_, both_;
  RCP<Vector> first_ids_, second_ids_;
  RCP<Matrix> matrix_;
  std::array<RCP<const Graph>, 4> graphs_;           ///< of the blocks
  std::array<std::vector<std::size_t>, 4> offsets_;  ///< [entries of a block] in the values of the matrix
};

}  // namespace mortise::detail
