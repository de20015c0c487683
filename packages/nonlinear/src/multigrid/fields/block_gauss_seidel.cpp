#include "multigrid/fields/block_gauss_seidel.hpp"

#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_MultiVector.hpp>

namespace mortise::detail {

FieldBlocks::FieldBlocks(const Matrix& A, const FieldsOfRows& fields) : parts_(field_parts(A.getRowMap(), fields)) {
  blocks_.resize(parts_.size());
  for (std::size_t rows = 0; rows < parts_.size(); ++rows)
    for (std::size_t columns = rows; columns < parts_.size(); ++columns) blocks_[rows].push_back(field_block(A, parts_[rows], parts_[columns]));
}

void BlockGaussSeidel::apply(const MultiVector& x, MultiVector& y, Teuchos::ETransp, Scalar, Scalar) const {
  const std::size_t fields = blocks_->fields();
  std::vector<RCP<MultiVector>> solved(fields);
  for (std::size_t field = fields; field-- > 0;) {
    const RCP<MultiVector> rest = blocks_->part(field).of(x);
    for (std::size_t other = field + 1; other < fields; ++other)
      blocks_->block(field, other)->apply(*solved[other], *rest, Teuchos::NO_TRANS, -1.0, 1.0);
    solved[field] = rcp(new MultiVector(rest->getMap(), rest->getNumVectors()));
    preconditioners_[field]->apply(*rest, *solved[field]);
    blocks_->part(field).put(*solved[field], y);
  }
}

}  // namespace mortise::detail
