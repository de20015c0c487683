#include "contact_solve.hpp"

#include <Thyra_DefaultLinearOpSource.hpp>
#include <Thyra_LinearOpSourceBase.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_Vector.hpp>
#include <stdexcept>

#include "tpetra_of_thyra.hpp"

namespace mortise::detail {
namespace {

using Op = ::Thyra::LinearOpBase<Scalar>;
using OpSource = ::Thyra::LinearOpSourceBase<Scalar>;
using OpWithSolve = ::Thyra::LinearOpWithSolveBase<Scalar>;
using Status = ::Thyra::SolveStatus<Scalar>;

const SolvedByCondensing& as_contact(const Op& W) {
  const auto* of_contact = dynamic_cast<const SolvedByCondensing*>(&W);
  if (of_contact == nullptr) throw std::invalid_argument("contact: a solver of a model with contact gets another operator than a W_op of that model");
  return *of_contact;
}

class ContactSolve : public OpWithSolve {
 public:
  void initialize(const RCP<const OpSource>& source, const ThyraSolverFactory& factory, ::Thyra::ESupportSolveUse use) {
    source_ = source;
    W_ = source->getOp();
    const SolvedByCondensing& contact = as_contact(*W_);
    const auto condensed = rcp(new ::Thyra::DefaultLinearOpSource<Scalar>(contact.condensed()));
    if (inner_.is_null() || graph_number_ != contact.graph_number()) inner_ = factory.createOp();  // nothing symbolic is kept for another graph
    graph_number_ = contact.graph_number();
    factory.initializeOp(condensed, inner_.get(), use);
  }
  RCP<const OpSource> uninitialize() {
    const RCP<const OpSource> source = source_;
    source_ = Teuchos::null;
    W_ = Teuchos::null;
    inner_ = Teuchos::null;
    return source;
  }

  RCP<const ThyraSpace> range() const override { return W_.is_null() ? Teuchos::null : W_->range(); }
  RCP<const ThyraSpace> domain() const override { return W_.is_null() ? Teuchos::null : W_->domain(); }

 protected:
  bool opSupportedImpl(::Thyra::EOpTransp transposed) const override { return transposed == ::Thyra::NOTRANS; }
  void applyImpl(const ::Thyra::EOpTransp transposed, const ::Thyra::MultiVectorBase<Scalar>& x,
                 const Teuchos::Ptr<::Thyra::MultiVectorBase<Scalar>>& y, const Scalar alpha, const Scalar beta) const override {
    W_->apply(transposed, x, y, alpha, beta);
  }
  bool solveSupportsImpl(::Thyra::EOpTransp transposed) const override { return transposed == ::Thyra::NOTRANS; }
  bool solveSupportsNewImpl(::Thyra::EOpTransp transposed, const Teuchos::Ptr<const ::Thyra::SolveCriteria<Scalar>>) const override {
    return solveSupportsImpl(transposed);
  }
  bool solveSupportsSolveMeasureTypeImpl(::Thyra::EOpTransp transposed, const ::Thyra::SolveMeasureType& measure) const override {
    return solveSupportsImpl(transposed) && (inner_.is_null() || inner_->solveSupportsSolveMeasureType(transposed, measure));
  }
  Status solveImpl(const ::Thyra::EOpTransp transposed, const ::Thyra::MultiVectorBase<Scalar>& B,
                   const Teuchos::Ptr<::Thyra::MultiVectorBase<Scalar>>& X,
                   const Teuchos::Ptr<const ::Thyra::SolveCriteria<Scalar>> criteria) const override {
    if (transposed != ::Thyra::NOTRANS) throw std::logic_error("contact: no solve with the transpose of W");
    Status worst;
    worst.solveStatus = ::Thyra::SOLVE_STATUS_CONVERGED;
    bool first = true;
    const auto inner = [&](const Vector& right, Vector& dd) {
      dd.putScalar(0.0);
      const Status status = ::Thyra::solve<Scalar>(*inner_, ::Thyra::NOTRANS, *thyra(right), thyra(dd).ptr(), criteria);
      if (first || status.solveStatus != ::Thyra::SOLVE_STATUS_CONVERGED) worst = status;
      first = false;
    };
    for (int j = 0; j < B.domain()->dim(); ++j) as_contact(*W_).solve(*B.col(j), inner, *X->col(j));
    return worst;
  }

 private:
  RCP<const OpSource> source_;
  RCP<const Op> W_;
  RCP<OpWithSolve> inner_;
  long graph_number_ = 0;
};

class ContactSolveFactory : public ThyraSolverFactory {
 public:
  explicit ContactSolveFactory(RCP<const ThyraSolverFactory> inner) : inner_(std::move(inner)) {}

  bool isCompatible(const OpSource& source) const override { return dynamic_cast<const SolvedByCondensing*>(source.getOp().get()) != nullptr; }
  RCP<OpWithSolve> createOp() const override { return rcp(new ContactSolve); }
  void initializeOp(const RCP<const OpSource>& source, OpWithSolve* op, const ::Thyra::ESupportSolveUse use) const override {
    Teuchos::dyn_cast<ContactSolve>(*op).initialize(source, *inner_, use);
  }
  void uninitializeOp(OpWithSolve* op, RCP<const OpSource>* source, RCP<const ::Thyra::PreconditionerBase<Scalar>>* preconditioner,
                      RCP<const OpSource>* approximate, ::Thyra::ESupportSolveUse* use) const override {
    const RCP<const OpSource> held = Teuchos::dyn_cast<ContactSolve>(*op).uninitialize();
    if (source != nullptr) *source = held;
    if (preconditioner != nullptr) *preconditioner = Teuchos::null;
    if (approximate != nullptr) *approximate = Teuchos::null;
    if (use != nullptr) *use = ::Thyra::SUPPORT_SOLVE_UNSPECIFIED;
  }

  void setParameterList(const RCP<Teuchos::ParameterList>&) override {
    throw std::logic_error("contact: set parameters of the linear solver on the application's own factory");
  }
  RCP<Teuchos::ParameterList> getNonconstParameterList() override { return Teuchos::null; }
  RCP<Teuchos::ParameterList> unsetParameterList() override { return Teuchos::null; }
  RCP<const Teuchos::ParameterList> getParameterList() const override { return inner_->getParameterList(); }
  RCP<const Teuchos::ParameterList> getValidParameters() const override { return inner_->getValidParameters(); }

 private:
  RCP<const ThyraSolverFactory> inner_;
};

}  // namespace

RCP<const ThyraSolverFactory> contact_solver_factory(const RCP<const ThyraSolverFactory>& inner) { return rcp(new ContactSolveFactory(inner)); }

}  // namespace mortise::detail
