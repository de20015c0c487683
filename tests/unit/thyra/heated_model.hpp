#pragma once
// Two bodies with displacements and temperatures as a host whose equations are a Thyra::ModelEvaluator.

#include <Thyra_StateFuncModelEvaluatorBase.hpp>
#include <Thyra_VectorStdOps.hpp>
#include <memory>

#include "../thermal_contact/two_bodies.hpp"
#include "direct_solver.hpp"
#include "mortise/core/trilinos_versions.hpp"
#include "mortise/thyra/model_with_contact.hpp"

namespace mortise::test {

/// f = K x + C x' - loads p, with rows E (x - target) where `held` says so. x' is (x - before) / time_step, or the host's. W = beta K + alpha C.
/// Stresses depend on temperatures; C is the heat capacity.
class HeatedModel : public ::Thyra::StateFuncModelEvaluatorBase<Scalar> {
  using Base = ::Thyra::ModelEvaluatorBase;

 public:
  HeatedModel(std::shared_ptr<const TwoBodies> bodies, double modulus, double time_step, const std::function<bool(GlobalOrdinal id)>& held)
      : bodies_(std::move(bodies)),
        modulus_(modulus),
        time_step_(time_step),
        held_(held),
        dofs_(bodies_->table->dofs),
        space_(::Thyra::createVectorSpace<Scalar, LocalOrdinal, GlobalOrdinal, NodeType>(dofs_)),
        loads_(
            ::Thyra::createVectorSpace<Scalar, LocalOrdinal, GlobalOrdinal, NodeType>(rcp(new Map(2, 0, bodies_->comm, Tpetra::LocallyReplicated)))),
        K_(rcp(new Matrix(bodies_->graph()))),
        C_(rcp(new Matrix(K_->getCrsGraph()))),
        nominal_(createInArgs()),
        before(dofs_),
        target(dofs_) {
    bodies_->assemble(1e300, *K_);
    bodies_->visit(1.0, [&](GlobalOrdinal row, GlobalOrdinal column, double value) { C_->sumIntoGlobalValues(row, 1, &value, &column); });
    bodies_->visit(1e300, [&](GlobalOrdinal row, GlobalOrdinal column, double value) {
      const double negative = -value;
      C_->sumIntoGlobalValues(row, 1, &negative, &column);
    });
    K_->fillComplete(dofs_, dofs_);
    C_->fillComplete(dofs_, dofs_);
    for (const auto& set : {false, true}) {
      const auto zero = ::Thyra::createMember(set ? *loads_ : *space_);
      ::Thyra::assign(zero.ptr(), 0.0);
      set ? nominal_.set_p(0, zero) : nominal_.set_x(zero);
    }
  }

  /// K x + C x', without boundary conditions.
  RCP<Vector> unheld(const Vector& x) const {
    const auto r = rcp(new Vector(dofs_));
    Vector rate(x, Teuchos::Copy);
    rate.update(-1.0 / time_step_, before, 1.0 / time_step_);
    K_->apply(x, *r);
    C_->apply(rate, *r, Teuchos::NO_TRANS, 1.0, 1.0);
    return r;
  }

  RCP<const ::Thyra::VectorSpaceBase<Scalar>> get_x_space() const override { return space_; }
  RCP<const ::Thyra::VectorSpaceBase<Scalar>> get_f_space() const override { return space_; }
  RCP<const ::Thyra::VectorSpaceBase<Scalar>> get_p_space(int) const override { return loads_; }
  RCP<const Teuchos::Array<std::string>> get_p_names(int) const override { return Teuchos::null; }
  ThyraInArgs getNominalValues() const override { return nominal_; }
  RCP<::Thyra::LinearOpBase<Scalar>> create_W_op() const override {
    const RCP<Operator> matrix = rcp(new Matrix(K_->getCrsGraph()));
    Teuchos::rcp_dynamic_cast<Matrix>(matrix)->fillComplete(dofs_, dofs_);
    return ::Thyra::tpetraLinearOp<Scalar, LocalOrdinal, GlobalOrdinal, NodeType>(space_, space_, matrix);
  }
  RCP<const ::Thyra::LinearOpWithSolveFactoryBase<Scalar>> get_W_factory() const override { return rcp(new DirectSolverFactory); }
  ThyraInArgs createInArgs() const override {
    Base::InArgsSetup<Scalar> result;
    result.set_Np_Ng(1, 0);
    for (const auto argument : {Base::IN_ARG_x, Base::IN_ARG_x_dot, Base::IN_ARG_alpha, Base::IN_ARG_beta}) result.setSupports(argument);
    return result;
  }

 private:
  ThyraOutArgs createOutArgsImpl() const override {
    Base::OutArgsSetup<Scalar> result;
    result.set_Np_Ng(1, 0);
    result.setSupports(Base::OUT_ARG_f);
    result.setSupports(Base::OUT_ARG_W_op);
    result.setSupports(Base::OUT_ARG_DfDp, 0, Base::DERIV_MV_JACOBIAN_FORM);
    return result;
  }
  /// What a parameter pulls at, or heats: another number for each dof.
  double load(GlobalOrdinal id, int parameter) const { return held_(id) ? 0.0 : std::sin(1.0 + static_cast<double>(id * (parameter + 1))); }
  void evalModelImpl(const ThyraInArgs& in, const ThyraOutArgs& out) const override {
    const Vector& x = *TpetraOf::getConstTpetraVector(in.get_x());
    const bool has_rates = !in.get_x_dot().is_null();
    const double alpha = has_rates ? in.get_alpha() : 1.0 / time_step_, beta = has_rates ? in.get_beta() : 1.0;
    if (!out.get_f().is_null()) {
      const RCP<Vector> f = TpetraOf::getTpetraVector(out.get_f());
      if (has_rates) {
        K_->apply(x, *f);
        C_->apply(*TpetraOf::getConstTpetraVector(in.get_x_dot()), *f, Teuchos::NO_TRANS, 1.0, 1.0);
      } else {
        Tpetra::deep_copy(*f, *unheld(x));
      }
      const auto p = TpetraOf::getConstTpetraVector(in.get_p(0))->getData();
      for (const GlobalOrdinal id : local_ids(*dofs_)) {
        const LocalOrdinal row = dofs_->getLocalElement(id);
        f->sumIntoLocalValue(row, -p[0] * load(id, 0) - p[1] * load(id, 1));
        if (held_(id)) f->replaceLocalValue(row, modulus_ * (x.getData()[row] - target.getData()[row]));
      }
    }
    if (const auto columns = out.get_DfDp(0).getMultiVector(); !columns.is_null())
      for (int j = 0; j < 2; ++j)
        for (const GlobalOrdinal id : local_ids(*dofs_)) TpetraOf::getTpetraVector(columns->col(j))->replaceGlobalValue(id, -load(id, j));
    if (!out.get_W_op().is_null()) {
      const auto W = Teuchos::rcp_dynamic_cast<Matrix>(TpetraOf::getTpetraOperator(out.get_W_op()), true);
      W->resumeFill();
      W->setAllToScalar(0.0);
      for (LocalOrdinal row = 0; row < static_cast<LocalOrdinal>(local_id_count(*dofs_)); ++row) {
        const GlobalOrdinal id = dofs_->getGlobalElement(row);
        Matrix::local_inds_host_view_type columns;
        Matrix::values_host_view_type of_K, of_C;
        K_->getLocalRowView(row, columns, of_K);
        C_->getLocalRowView(row, columns, of_C);
        for (std::size_t k = 0; k < columns.extent(0); ++k) {
          const bool diagonal = K_->getColMap()->getGlobalElement(columns(k)) == id;
          const double value = held_(id) ? (diagonal ? beta * modulus_ : 0.0) : beta * of_K(k) + alpha * of_C(k);
          W->replaceLocalValues(row, 1, &value, &columns(k));
        }
      }
      W->fillComplete(dofs_, dofs_);
    }
  }

  std::shared_ptr<const TwoBodies> bodies_;
  double modulus_, time_step_;
  std::function<bool(GlobalOrdinal)> held_;
  RCP<const Map> dofs_;
  RCP<const ::Thyra::VectorSpaceBase<Scalar>> space_, loads_;
  RCP<Matrix> K_, C_;
  ThyraInArgs nominal_;

 public:
  Vector before;  ///< x when the step began
  Vector target;  ///< read where rows are held
};

}  // namespace mortise::test
