#pragma once
// The two blocks of tests/install/consumer as a host whose equations are a Thyra::ModelEvaluator.

#include <Thyra_StateFuncModelEvaluatorBase.hpp>
#include <Thyra_VectorStdOps.hpp>
#include <memory>

#include "../../install/consumer/blocks.hpp"
#include "direct_solver.hpp"
#include "mortise/core/trilinos_versions.hpp"
#include "mortise/thyra/model_with_contact.hpp"

namespace mortise::test {

/// The place of boundary conditions.
enum class Supports { none, in_rows };

/// f = m x'' + K x with parameters (down, right), by which the upper block's upper face has moved. W = omega m + beta K.
class BlocksModel : public ::Thyra::StateFuncModelEvaluatorBase<Scalar> {
  using Base = ::Thyra::ModelEvaluatorBase;

 public:
  BlocksModel(std::shared_ptr<const host::Blocks> blocks, Supports supports, double mass = 0.0)
      : blocks_(std::move(blocks)),
        supports_(supports),
        mass_(mass),
        space_(::Thyra::createVectorSpace<Scalar, LocalOrdinal, GlobalOrdinal, NodeType>(blocks_->dofs)),
        motion_(
            ::Thyra::createVectorSpace<Scalar, LocalOrdinal, GlobalOrdinal, NodeType>(rcp(new Map(2, 0, blocks_->comm, Tpetra::LocallyReplicated)))),
        K_(rcp(new Matrix(blocks_->graph()))),
        nominal_(createInArgs()) {
    blocks_->assemble(*K_);
    K_->fillComplete(blocks_->dofs, blocks_->dofs);
    const auto x = ::Thyra::createMember(*space_);
    ::Thyra::assign(x.ptr(), 0.0);
    nominal_.set_x(x);
    move(0.0, 0.0);
  }

  /// Sets the parameters, of nominal values too.
  void move(double down, double right) {
    const auto p = ::Thyra::createMember(*motion_);
    const auto values = TpetraOf::getTpetraVector(p);
    values->replaceLocalValue(0, down);
    values->replaceLocalValue(1, right);
    nominal_.set_p(0, p);
  }

  /// Displacements that `at` prescribes.
  void prescribe(const ThyraInArgs& at, Vector& values) const {
    const auto p = TpetraOf::getConstTpetraVector(at.get_p(0))->getData();
    for (const GlobalOrdinal id : local_ids(*blocks_->dofs)) {
      const GlobalOrdinal node = id / blocks_->dimension, i = id % blocks_->dimension;
      if (blocks_->held(node))
        values.replaceGlobalValue(id, blocks_->block_of(node) == 0 ? 0.0 : i == 0 ? p[1] : i == blocks_->dimension - 1 ? -p[0] : 0.0);
    }
  }
  HostDisplacements displacements() const {
    HostDisplacements result{numbered_by_nodes("displacement", blocks_->nodes, blocks_->dimension), blocks_->reference, blocks_->fixed, {}, {}};
    if (supports_ == Supports::none) result.prescribed = [this](const ThyraInArgs& at, Vector& values) { prescribe(at, values); };
    return result;
  }

  RCP<const ::Thyra::VectorSpaceBase<Scalar>> get_x_space() const override { return space_; }
  RCP<const ::Thyra::VectorSpaceBase<Scalar>> get_f_space() const override { return space_; }
  RCP<const ::Thyra::VectorSpaceBase<Scalar>> get_p_space(int) const override { return motion_; }
  RCP<const Teuchos::Array<std::string>> get_p_names(int) const override { return Teuchos::null; }
  RCP<const ::Thyra::VectorSpaceBase<Scalar>> get_g_space(int) const override { return motion_; }
  ThyraInArgs getNominalValues() const override { return nominal_; }
  RCP<::Thyra::LinearOpBase<Scalar>> create_W_op() const override {
    const RCP<Operator> matrix = rcp(new Matrix(K_->getCrsGraph()));
    Teuchos::rcp_dynamic_cast<Matrix>(matrix)->fillComplete(blocks_->dofs, blocks_->dofs);
    return ::Thyra::tpetraLinearOp<Scalar, LocalOrdinal, GlobalOrdinal, NodeType>(space_, space_, matrix);
  }
  RCP<const ::Thyra::LinearOpWithSolveFactoryBase<Scalar>> get_W_factory() const override {
    return has_solver ? rcp(new DirectSolverFactory) : Teuchos::null;
  }
  ThyraInArgs createInArgs() const override {
    Base::InArgsSetup<Scalar> result;
    result.set_Np_Ng(1, 1);
    result.setSupports(Base::IN_ARG_x);
    if (mass_ > 0.0) {
      result.setSupports(Base::IN_ARG_x_dot);
      result.setSupports(Base::IN_ARG_x_dot_dot);
      result.setSupports(Base::IN_ARG_alpha);
      result.setSupports(Base::IN_ARG_beta);
      result.setSupports(Base::IN_ARG_W_x_dot_dot_coeff);
    }
    return result;
  }

  bool has_solver = true;
  mutable int residuals = 0, matrices = 0;  ///< evaluations
  mutable bool fails = false;               ///< says so

 private:
  ThyraOutArgs createOutArgsImpl() const override {
    Base::OutArgsSetup<Scalar> result;
    result.set_Np_Ng(1, 1);
    result.setSupports(Base::OUT_ARG_f);
    result.setSupports(Base::OUT_ARG_W_op);
    return result;
  }
  void evalModelImpl(const ThyraInArgs& in, const ThyraOutArgs& out) const override {
    const RCP<const Vector> x = TpetraOf::getConstTpetraVector(in.get_x());
    Vector target(blocks_->dofs);
    prescribe(in, target);
    const bool moves = mass_ > 0.0 && !in.get_x_dot_dot().is_null();
    if (!out.get_g(0).is_null()) ::Thyra::assign(out.get_g(0).ptr(), x->norm2());
    if (!out.get_f().is_null()) {
      ++residuals;
      const RCP<Vector> f = TpetraOf::getTpetraVector(out.get_f());
      K_->apply(*x, *f);
      if (moves) f->update(mass_, *TpetraOf::getConstTpetraVector(in.get_x_dot_dot()), 1.0);
      for_supports([&](GlobalOrdinal id) {
        const LocalOrdinal row = blocks_->dofs->getLocalElement(id);
        f->replaceLocalValue(row, host::E * (x->getData()[row] - target.getData()[row]));
      });
    }
    if (!out.get_W_op().is_null()) {
      ++matrices;
      const auto W = Teuchos::rcp_dynamic_cast<Matrix>(TpetraOf::getTpetraOperator(out.get_W_op()), true);
      W->resumeFill();
      W->setAllToScalar(0.0);
      blocks_->assemble(*W);
      if (moves) W->scale(in.get_beta());
      for (const GlobalOrdinal id : local_ids(*blocks_->dofs)) {
        const double value = moves ? in.get_W_x_dot_dot_coeff() * mass_ : 0.0;
        W->sumIntoGlobalValues(id, 1, &value, &id);
      }
      for_supports([&](GlobalOrdinal id) {
        Teuchos::Array<GlobalOrdinal> columns(W->getNumEntriesInGlobalRow(id));
        Teuchos::Array<double> values(columns.size(), 0.0);
        const LocalOrdinal row = blocks_->dofs->getLocalElement(id);
        Matrix::local_inds_host_view_type local;
        Matrix::values_host_view_type unused;
        W->getLocalRowView(row, local, unused);
        for (Teuchos::Ordinal k = 0; k < columns.size(); ++k) {
          columns[k] = W->getColMap()->getGlobalElement(local(k));
          values[k] = columns[k] == id ? host::E * (moves ? in.get_beta() : 1.0) : 0.0;
        }
        W->replaceGlobalValues(id, columns(), values());
      });
      W->fillComplete(blocks_->dofs, blocks_->dofs);
    }
    if (fails) out.setFailed();
  }
  template <class Take>
  void for_supports(const Take& take) const {
    if (supports_ == Supports::none) return;
    for (const GlobalOrdinal id : local_ids(*blocks_->dofs))
      if (blocks_->held(id / blocks_->dimension)) take(id);
  }

  std::shared_ptr<const host::Blocks> blocks_;
  Supports supports_;
  double mass_;
  RCP<const ::Thyra::VectorSpaceBase<Scalar>> space_, motion_;
  RCP<Matrix> K_;
  ThyraInArgs nominal_;
};

}  // namespace mortise::test
