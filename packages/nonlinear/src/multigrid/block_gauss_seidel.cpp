#include "multigrid/block_gauss_seidel.hpp"

#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_MultiVector.hpp>
#include <cstdlib>

namespace mortise::detail {

FieldBlocks::FieldBlocks(const Matrix& A, const FieldsOfRows& fields) : parts_(field_parts(A.getRowMap(), fields)) {
  for (const FieldPart& rows : parts_) {
    blocks_.emplace_back();
    for (const FieldPart& columns : parts_) blocks_.back().push_back(field_block(A, rows, columns));
  }
}

void BlockGaussSeidel::apply(const MultiVector& x, MultiVector& y, Teuchos::ETransp, Scalar, Scalar) const {
  const std::size_t fields = blocks_->fields();
  std::vector<RCP<MultiVector>> solved(fields);
  const auto solve = [&](std::size_t field, const std::vector<std::size_t>& others) {
    const RCP<MultiVector> rest = blocks_->part(field).of(x);
    for (const std::size_t other : others) blocks_->block(field, other)->apply(*solved[other], *rest, Teuchos::NO_TRANS, -1.0, 1.0);
    const auto change = rcp(new MultiVector(rest->getMap(), rest->getNumVectors()));
    preconditioners_[field]->apply(*rest, *change);
    if (solved[field].is_null())
      solved[field] = change;
    else
      solved[field]->update(1.0, *change, 1.0);
  };
  for (std::size_t field = fields; field-- > 0;) {
    std::vector<std::size_t> later;
    for (std::size_t other = field + 1; other < fields; ++other) later.push_back(other);
    solve(field, later);
  }
  static const bool back = std::getenv("MORTISE_BACK") != nullptr;
  if (back) solve(1, {0, 1});
  for (std::size_t field = 0; field < fields; ++field) blocks_->part(field).put(*solved[field], y);
}

}  // namespace mortise::detail
