#pragma once
// Preconditioner of a matrix of several fields.

#include <memory>
#include <vector>

#include "multigrid/fields/field_blocks.hpp"

namespace mortise::detail {

/// The matrix A of several fields by its blocks A_fg with g >= f: those that a sweep from the last field to the first needs.
class FieldBlocks {
 public:
  /// Collective.
  FieldBlocks(const Matrix& A, const FieldsOfRows& fields);

  std::size_t fields() const { return parts_.size(); }
  const FieldPart& part(std::size_t field) const { return parts_[field]; }
  /// @param columns  not before `rows`
  const RCP<const Matrix>& block(std::size_t rows, std::size_t columns) const { return blocks_[rows][columns - rows]; }

 private:
  std::vector<FieldPart> parts_;
  std::vector<std::vector<RCP<const Matrix>>> blocks_;
};

/// Block Gauss-Seidel with preconditioners P_f of the diagonal blocks, from the last field to the first:
///   y_f = P_f (x_f - sum_{g > f} A_fg y_g).
/// Temperatures come before displacements, for expansion is the strong coupling: A_dt, of the stiffness times the expansion coefficient.
class BlockGaussSeidel : public Operator {
 public:
  BlockGaussSeidel(RCP<const Map> all, std::shared_ptr<const FieldBlocks> blocks, std::vector<RCP<const Operator>> preconditioners)
      : all_(std::move(all)), blocks_(std::move(blocks)), preconditioners_(std::move(preconditioners)) {}
  Teuchos::RCP<const Map> getDomainMap() const override { return all_; }
  Teuchos::RCP<const Map> getRangeMap() const override { return all_; }
  void apply(const MultiVector& x, MultiVector& y, Teuchos::ETransp, Scalar, Scalar) const override;

 private:
  RCP<const Map> all_;
  std::shared_ptr<const FieldBlocks> blocks_;
  std::vector<RCP<const Operator>> preconditioners_;  ///< [fields]
};

}  // namespace mortise::detail
