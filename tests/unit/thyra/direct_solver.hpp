#pragma once
// Part of a host in tests: a dense solver of small systems, the same on all ranks.

#include <Eigen/Dense>
#include <Thyra_LinearOpSourceBase.hpp>
#include <Thyra_LinearOpWithSolveBase.hpp>
#include <Thyra_LinearOpWithSolveFactoryBase.hpp>
#include <Thyra_TpetraThyraWrappers.hpp>

#include "mortise/core/over_ranks.hpp"
#include "mortise/core/trilinos_versions.hpp"
#include "mortise/core/types.hpp"

namespace mortise::test {

using TpetraOf = ::Thyra::TpetraOperatorVectorExtraction<Scalar, LocalOrdinal, GlobalOrdinal, NodeType>;

class DirectSolve : public ::Thyra::LinearOpWithSolveBase<Scalar> {
 public:
  void initialize(const RCP<const ::Thyra::LinearOpSourceBase<Scalar>>& source) {
    op_ = source->getOp();
    const auto matrix = Teuchos::rcp_dynamic_cast<const Matrix>(TpetraOf::getConstTpetraOperator(op_), true);
    rows_ = matrix->getRowMap();
    const auto size = static_cast<Eigen::Index>(rows_->getMaxAllGlobalIndex() + 1);
    Eigen::MatrixXd A = Eigen::MatrixXd::Zero(size, size);
    Eigen::VectorXd there = Eigen::VectorXd::Zero(size);
    for (LocalOrdinal row = 0; row < static_cast<LocalOrdinal>(local_id_count(*rows_)); ++row) {
      Matrix::local_inds_host_view_type columns;
      Matrix::values_host_view_type values;
      matrix->getLocalRowView(row, columns, values);
      there[rows_->getGlobalElement(row)] = 1.0;
      for (std::size_t k = 0; k < columns.extent(0); ++k)
        A(rows_->getGlobalElement(row), matrix->getColMap()->getGlobalElement(columns(k))) += values(k);
    }
    A = sum_over_ranks(*rows_->getComm(), A);
    there = sum_over_ranks(*rows_->getComm(), there);
    for (Eigen::Index i = 0; i < size; ++i)
      if (there[i] == 0.0) A(i, i) = 1.0;
    lu_.compute(A);
  }
  RCP<const ::Thyra::VectorSpaceBase<Scalar>> range() const override { return op_.is_null() ? Teuchos::null : op_->range(); }
  RCP<const ::Thyra::VectorSpaceBase<Scalar>> domain() const override { return op_.is_null() ? Teuchos::null : op_->domain(); }

 protected:
  bool opSupportedImpl(::Thyra::EOpTransp transposed) const override { return transposed == ::Thyra::NOTRANS; }
  void applyImpl(const ::Thyra::EOpTransp transposed, const ::Thyra::MultiVectorBase<Scalar>& x,
                 const Teuchos::Ptr<::Thyra::MultiVectorBase<Scalar>>& y, const Scalar alpha, const Scalar beta) const override {
    op_->apply(transposed, x, y, alpha, beta);
  }
  bool solveSupportsImpl(::Thyra::EOpTransp transposed) const override { return transposed == ::Thyra::NOTRANS; }
  bool solveSupportsSolveMeasureTypeImpl(::Thyra::EOpTransp, const ::Thyra::SolveMeasureType&) const override { return true; }
  ::Thyra::SolveStatus<Scalar> solveImpl(const ::Thyra::EOpTransp, const ::Thyra::MultiVectorBase<Scalar>& B,
                                         const Teuchos::Ptr<::Thyra::MultiVectorBase<Scalar>>& X,
                                         const Teuchos::Ptr<const ::Thyra::SolveCriteria<Scalar>>) const override {
    const auto b = TpetraOf::getConstTpetraMultiVector(Teuchos::rcpFromRef(B));
    const auto x = TpetraOf::getTpetraMultiVector(Teuchos::rcpFromRef(*X));
    for (std::size_t j = 0; j < b->getNumVectors(); ++j) {
      Eigen::VectorXd right = Eigen::VectorXd::Zero(lu_.rows());
      const auto values = b->getData(j);
      for (Eigen::Index i = 0; i < values.size(); ++i) right[rows_->getGlobalElement(static_cast<LocalOrdinal>(i))] = values[i];
      const Eigen::VectorXd solution = lu_.solve(sum_over_ranks(*rows_->getComm(), right));
      for (Eigen::Index i = 0; i < values.size(); ++i)
        x->replaceLocalValue(static_cast<LocalOrdinal>(i), j, solution[rows_->getGlobalElement(static_cast<LocalOrdinal>(i))]);
    }
    ::Thyra::SolveStatus<Scalar> status;
    status.solveStatus = ::Thyra::SOLVE_STATUS_CONVERGED;
    return status;
  }

 private:
  RCP<const ::Thyra::LinearOpBase<Scalar>> op_;
  RCP<const Map> rows_;
  Eigen::PartialPivLU<Eigen::MatrixXd> lu_;
};

class DirectSolverFactory : public ::Thyra::LinearOpWithSolveFactoryBase<Scalar> {
  using Source = ::Thyra::LinearOpSourceBase<Scalar>;
  using Solve = ::Thyra::LinearOpWithSolveBase<Scalar>;

 public:
  bool isCompatible(const Source&) const override { return true; }
  RCP<Solve> createOp() const override { return rcp(new DirectSolve); }
  void initializeOp(const RCP<const Source>& source, Solve* op, const ::Thyra::ESupportSolveUse) const override {
    dynamic_cast<DirectSolve&>(*op).initialize(source);
  }
  void uninitializeOp(Solve*, RCP<const Source>*, RCP<const ::Thyra::PreconditionerBase<Scalar>>*, RCP<const Source>*,
                      ::Thyra::ESupportSolveUse*) const override {}
  void setParameterList(const RCP<Teuchos::ParameterList>&) override {}
  RCP<Teuchos::ParameterList> getNonconstParameterList() override { return Teuchos::null; }
  RCP<Teuchos::ParameterList> unsetParameterList() override { return Teuchos::null; }
};

}  // namespace mortise::test
