#include "multigrid/fields/weighted_equations.hpp"

#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_MultiVector.hpp>
#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace mortise::detail {
namespace {

/// y = D A x
class ScaledRows : public Operator {
 public:
  ScaledRows(RCP<const Operator> A, RCP<const Vector> D) : A_(std::move(A)), D_(std::move(D)) {}
  Teuchos::RCP<const Map> getDomainMap() const override { return A_->getDomainMap(); }
  Teuchos::RCP<const Map> getRangeMap() const override { return A_->getRangeMap(); }
  void apply(const MultiVector& x, MultiVector& y, Teuchos::ETransp, Scalar alpha, Scalar beta) const override {
    MultiVector product(y.getMap(), y.getNumVectors());
    A_->apply(x, product);
    y.elementWiseMultiply(alpha, *D_, product, beta);
  }

 private:
  RCP<const Operator> A_;
  RCP<const Vector> D_;
};

/// y = A D x
class ScaledColumns : public Operator {
 public:
  ScaledColumns(RCP<const Operator> A, RCP<const Vector> D) : A_(std::move(A)), D_(std::move(D)) {}
  Teuchos::RCP<const Map> getDomainMap() const override { return A_->getDomainMap(); }
  Teuchos::RCP<const Map> getRangeMap() const override { return A_->getRangeMap(); }
  void apply(const MultiVector& x, MultiVector& y, Teuchos::ETransp, Scalar, Scalar) const override {
    MultiVector scaled(x.getMap(), x.getNumVectors());
    scaled.elementWiseMultiply(1.0, *D_, x, 0.0);
    A_->apply(scaled, y);
  }

 private:
  RCP<const Operator> A_;
  RCP<const Vector> D_;
};

/// 1 / W_f
std::vector<double> sizes_of_fields(const FieldsOfRows& fields, const Vector& b) {
  const std::size_t count = fields.weights.size();
  std::vector<double> mine(count, 0.0), sizes(count);
  const auto value = b.getLocalViewHost(Tpetra::Access::ReadOnly);
  for (std::size_t row = 0; row < fields.field_of_row.size(); ++row) mine[fields.field_of_row[row]] += value(row, 0) * value(row, 0);
  Teuchos::reduceAll(*b.getMap()->getComm(), Teuchos::REDUCE_SUM, static_cast<int>(count), mine.data(), sizes.data());
  double largest = 0.0;
  for (std::size_t field = 0; field < count; ++field) {
    sizes[field] = std::sqrt(sizes[field]);
    largest = std::max(largest, fields.weights[field] * sizes[field]);
  }
  for (std::size_t field = 0; field < count; ++field)
    sizes[field] = std::max(sizes[field], WeightedEquations::least_share * largest / fields.weights[field]);
  return sizes;
}

}  // namespace

WeightedEquations::WeightedEquations(RCP<const Matrix> A, const FieldsOfRows* fields, const Vector& b) : A_(A), b_(Teuchos::rcpFromRef(b)) {
  if (fields == nullptr) {
    size_ = b.norm2();
    return;
  }
  const std::vector<double> sizes = sizes_of_fields(*fields, b);
  const auto weights = rcp(new Vector(b.getMap())), inverse = rcp(new Vector(b.getMap())), weighted = rcp(new Vector(b.getMap()));
  {
    const auto weight = weights->getLocalViewHost(Tpetra::Access::OverwriteAll), size = inverse->getLocalViewHost(Tpetra::Access::OverwriteAll);
    for (std::size_t row = 0; row < fields->field_of_row.size(); ++row) {
      size(row, 0) = sizes[fields->field_of_row[row]];
      weight(row, 0) = 1.0 / size(row, 0);
    }
  }
  weighted->elementWiseMultiply(1.0, *weights, b, 0.0);
  A_ = rcp(new ScaledRows(A, weights));
  b_ = weighted;
  inverse_weights_ = inverse;
  size_ = weighted->norm2();
}

RCP<const Operator> WeightedEquations::preconditioner(const RCP<const Operator>& P) const {
  if (inverse_weights_.is_null()) return P;
  return rcp(new ScaledColumns(P, inverse_weights_));
}

}  // namespace mortise::detail
