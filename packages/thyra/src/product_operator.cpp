#include "product_operator.hpp"

#include <Thyra_DefaultProductVector.hpp>
#include <Thyra_TpetraLinearOp.hpp>
#include <Tpetra_CrsGraph.hpp>
#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <vector>

#include "mortise/core/trilinos_versions.hpp"
#include "tpetra_of_thyra.hpp"

namespace mortise::detail {
namespace {

using ProductVector = ::Thyra::ProductVectorBase<Scalar>;

RCP<const Vector> part(const ::Thyra::VectorBase<Scalar>& vector, int block) {
  return TpetraOfThyra::getConstTpetraVector(dynamic_cast<const ProductVector&>(vector).getVectorBlock(block));
}
RCP<Vector> part(::Thyra::VectorBase<Scalar>& vector, int block) {
  return TpetraOfThyra::getTpetraVector(dynamic_cast<ProductVector&>(vector).getNonconstVectorBlock(block));
}

void set_rows_to_zero(const std::vector<LocalOrdinal>& rows, Vector& vector) {
  const auto view = vector.getLocalViewHost(Tpetra::Access::ReadWrite);
  for (const LocalOrdinal row : rows) view(row, 0) = 0.0;
}

// Adds a row, times `factor`, to a matrix whose rows are sized for it.
void add_row(const Matrix& from, LocalOrdinal row, double factor, GlobalOrdinal to_row, Matrix& to) {
  Matrix::local_inds_host_view_type columns;
  Matrix::values_host_view_type values;
  from.getLocalRowView(row, columns, values);
  std::vector<GlobalOrdinal> ids(columns.extent(0));
  std::vector<double> scaled(columns.extent(0));
  for (std::size_t k = 0; k < ids.size(); ++k) {
    ids[k] = from.getColMap()->getGlobalElement(columns(k));
    scaled[k] = factor * values(k);
  }
  to.insertGlobalValues(to_row, static_cast<LocalOrdinal>(ids.size()), scaled.data(), ids.data());
}

// Between matrices on one graph.
void copy_row(const Matrix& from, LocalOrdinal row, Matrix& to) {
  Matrix::local_inds_host_view_type columns;
  Matrix::values_host_view_type values;
  from.getLocalRowView(row, columns, values);
  to.replaceLocalValues(row, static_cast<LocalOrdinal>(columns.extent(0)), values.data(), columns.data());
}

RCP<const ::Thyra::LinearOpBase<Scalar>> as_operator(const RCP<Matrix>& matrix) {
  return ::Thyra::constTpetraLinearOp<Scalar, LocalOrdinal, GlobalOrdinal, NodeType>(space_of(matrix->getRangeMap()),
                                                                                     space_of(matrix->getDomainMap()), matrix);
}

}  // namespace

ProductOperator::ProductOperator(std::shared_ptr<StepMemory> memory, RCP<const ::Thyra::ProductVectorSpaceBase<Scalar>> space)
    : memory_(std::move(memory)), space_(std::move(space)) {}

void ProductOperator::assemble(const RCP<const Matrix>& K, double weight, const ContactIterate& iterate) {
  K_ = K;
  weight_ = weight;
  linearised_ = iterate.at.linearise(iterate.laws);
  if (whole_.open(memory_->contact, iterate.at, *K)) ++graph_number_;
  whole_.add(*K, 1.0 / weight);
  linearised_->add_stiffness(*whole_.matrix());
  heat_ = iterate.heat;
  if (heat_) heat_->add_slopes(*whole_.matrix());
  whole_.replace_rows(memory_->replaced, *K, 1.0 / weight, memory_->stiffness);
  whole_.replace_rows(memory_->kept, *K, 1.0 / weight, 0.0);
  whole_.matrix()->fillComplete(memory_->dofs, memory_->dofs);
  blocks_ = linearised_->saddle_point_blocks();
}

RCP<const ::Thyra::LinearOpBase<Scalar>> ProductOperator::condensed() const {
  if (memory_->contact.keeps_multipliers()) return merged();
  const RCP<const Graph> graph = whole_.matrix()->getCrsGraph();
  if (solved_.is_null() || solved_->getCrsGraph() != graph)
    solved_ = rcp(new Matrix(graph));
  else
    solved_->resumeFill();
  for (LocalOrdinal row = 0; row < static_cast<LocalOrdinal>(local_row_count(*graph)); ++row) copy_row(*whole_.matrix(), row, *solved_);
  Vector none(memory_->dofs);
  elimination_ = linearised_->condense(*solved_, none);
  if (heat_) heat_->add_substituted(*elimination_, *solved_);
  for (const LocalOrdinal row : memory_->prescribed) copy_row(*whole_.matrix(), row, *solved_);
  solved_->fillComplete(memory_->dofs, memory_->dofs);
  return as_operator(solved_);
}

RCP<const ::Thyra::LinearOpBase<Scalar>> ProductOperator::merged() const {
  const Matrix &K = *whole_.matrix(), *G = of_heat();
  const RCP<const Map>&dofs = memory_->dofs, &multipliers = memory_->contact.multiplier_map();
  std::vector<GlobalOrdinal> ids;  // those of multipliers lie above those of dofs
  for (const auto& map : {dofs, multipliers})
    for (const GlobalOrdinal id : local_ids(*map)) ids.push_back(id);
  std::vector<std::size_t> sizes;
  for (std::size_t row = 0; row < local_id_count(*dofs); ++row)
    sizes.push_back(K.getNumEntriesInLocalRow(static_cast<LocalOrdinal>(row)) + blocks_.B->getNumEntriesInLocalRow(static_cast<LocalOrdinal>(row)) +
                    (G != nullptr ? G->getNumEntriesInLocalRow(static_cast<LocalOrdinal>(row)) : 0));
  for (std::size_t row = 0; row < local_id_count(*multipliers); ++row)
    sizes.push_back(blocks_.C_d->getNumEntriesInLocalRow(static_cast<LocalOrdinal>(row)) +
                    blocks_.C_z->getNumEntriesInLocalRow(static_cast<LocalOrdinal>(row)));
  const auto invalid = Teuchos::OrdinalTraits<Tpetra::global_size_t>::invalid();
  const auto map = rcp(new Map(invalid, ids.data(), static_cast<LocalOrdinal>(ids.size()), 0, dofs->getComm()));
  solved_ = rcp(new Matrix(map, Teuchos::arrayViewFromVector(sizes)));
  for (LocalOrdinal row = 0; row < static_cast<LocalOrdinal>(local_id_count(*dofs)); ++row) {
    const GlobalOrdinal id = dofs->getGlobalElement(row);
    add_row(K, row, 1.0, id, *solved_);
    if (std::find(memory_->prescribed.begin(), memory_->prescribed.end(), row) != memory_->prescribed.end()) continue;
    add_row(*blocks_.B, row, 1.0, id, *solved_);
    if (G != nullptr) add_row(*G, row, 1.0, id, *solved_);
  }
  const RCP<const Vector> weights = memory_->contact.weights();
  for (LocalOrdinal row = 0; row < static_cast<LocalOrdinal>(local_id_count(*multipliers)); ++row) {
    const GlobalOrdinal id = multipliers->getGlobalElement(row);
    const double area = weights->getData()[row];
    add_row(*blocks_.C_d, row, area, id, *solved_);
    add_row(*blocks_.C_z, row, area, id, *solved_);
  }
  solved_->fillComplete();
  return as_operator(solved_);
}

void ProductOperator::solve(const ::Thyra::VectorBase<Scalar>& b, const NodeElimination::Solve& inner, ::Thyra::VectorBase<Scalar>& x) const {
  const RCP<const Vector> b_d = part(b, 0), b_z = part(b, 1);
  const RCP<Vector> x_d = part(x, 0), x_z = part(x, 1);
  if (elimination_) {
    const RCP<const Vector> weights = memory_->contact.weights();
    Vector rhs(*b_d, Teuchos::Copy), C(b_z->getMap());
    {
      const auto to = C.getLocalViewHost(Tpetra::Access::OverwriteAll);
      const auto from = b_z->getLocalViewHost(Tpetra::Access::ReadOnly), area = weights->getLocalViewHost(Tpetra::Access::ReadOnly);
      for (std::size_t i = 0; i < to.extent(0); ++i) to(i, 0) = -from(i, 0) / area(i, 0);
    }
    const NodeElimination elimination = elimination_->apply(rhs, C);
    if (heat_) heat_->take_constant(elimination, rhs);
    {
      const auto rows = rhs.getLocalViewHost(Tpetra::Access::ReadWrite);
      const auto of_model = b_d->getLocalViewHost(Tpetra::Access::ReadOnly);
      for (const LocalOrdinal row : memory_->prescribed) rows(row, 0) = of_model(row, 0);
    }
    elimination.solve(rhs, inner, *x_d, *x_z, of_heat());
  } else {
    Vector right(solved_->getRangeMap()), solution(solved_->getDomainMap());
    const std::size_t rows = b_d->getLocalLength();
    {
      const auto to = right.getLocalViewHost(Tpetra::Access::OverwriteAll);
      const auto d = b_d->getLocalViewHost(Tpetra::Access::ReadOnly), z = b_z->getLocalViewHost(Tpetra::Access::ReadOnly);
      for (std::size_t i = 0; i < to.extent(0); ++i) to(i, 0) = i < rows ? d(i, 0) : z(i - rows, 0);
    }
    inner(right, solution);
    const auto from = solution.getLocalViewHost(Tpetra::Access::ReadOnly);
    const auto d = x_d->getLocalViewHost(Tpetra::Access::OverwriteAll), z = x_z->getLocalViewHost(Tpetra::Access::OverwriteAll);
    for (std::size_t i = 0; i < from.extent(0); ++i) (i < rows ? d(i, 0) : z(i - rows, 0)) = from(i, 0);
  }
  if (weight_ == 1.0) return;
  x_d->scale(1.0 / weight_);
  x_z->scale(1.0 / weight_);
}

void ProductOperator::applyImpl(const ::Thyra::EOpTransp transposed, const ::Thyra::MultiVectorBase<Scalar>& x,
                                const Teuchos::Ptr<::Thyra::MultiVectorBase<Scalar>>& y, const Scalar alpha, const Scalar beta) const {
  if (transposed != ::Thyra::NOTRANS) throw std::logic_error("contact: W is not applied transposed");
  const RCP<const Vector> weights = memory_->contact.weights();
  for (int j = 0; j < x.domain()->dim(); ++j) {
    const RCP<const ::Thyra::VectorBase<Scalar>> column = x.col(j);
    const RCP<::Thyra::VectorBase<Scalar>> result = y->col(j);
    const RCP<const Vector> d = part(*column, 0), z = part(*column, 1);
    Vector of_d(d->getMap()), of_z(z->getMap()), scaled(z->getMap());
    blocks_.B->apply(*z, of_d);
    if (of_heat() != nullptr) of_heat()->apply(*z, of_d, Teuchos::NO_TRANS, 1.0, 1.0);
    set_rows_to_zero(memory_->prescribed, of_d);
    whole_.matrix()->apply(*d, of_d, Teuchos::NO_TRANS, 1.0, 1.0);
    blocks_.C_d->apply(*d, of_z);
    blocks_.C_z->apply(*z, of_z, Teuchos::NO_TRANS, 1.0, 1.0);
    scaled.elementWiseMultiply(1.0, *weights, of_z, 0.0);
    const RCP<Vector> y_d = part(*result, 0), y_z = part(*result, 1);
    y_d->update(alpha * weight_, of_d, beta);
    y_z->update(alpha * weight_, scaled, beta);
  }
}

}  // namespace mortise::detail
