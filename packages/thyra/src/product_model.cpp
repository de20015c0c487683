#include "product_model.hpp"

#include <Thyra_DefaultProductVector.hpp>
#include <Thyra_DefaultProductVectorSpace.hpp>
#include <Thyra_VectorStdOps.hpp>
#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_Vector.hpp>
#include <optional>
#include <stdexcept>

#include "product_operator.hpp"
#include "tpetra_of_thyra.hpp"

namespace mortise::detail {
namespace {

using Base = ::Thyra::ModelEvaluatorBase;
using ProductVector = ::Thyra::ProductVectorBase<Scalar>;

RCP<const ThyraVector> block(const ThyraVector& x, int number) {
  const auto* product = dynamic_cast<const ProductVector*>(&x);
  if (product == nullptr || product->productSpace()->numBlocks() != 2)
    throw std::invalid_argument("contact: a vector without multipliers where x is (displacements, multipliers)");
  return product->getVectorBlock(number);
}

class ProductModel : public ModelWithContact {
 public:
  ProductModel(const RCP<ThyraModel>& model, const std::shared_ptr<StepMemory>& memory, const RCP<const ThyraSolverFactory>& solver)
      : ModelWithContact(model, memory),
        shared_memory_(memory),
        solver_(contact_solver_factory(solver)),
        of_model_(model->create_W_op()),
        bulk_(matrix_of(of_model_)),
        space_(::Thyra::productVectorSpace<Scalar>(
            Teuchos::tuple<RCP<const ThyraSpace>>(model->get_x_space(), space_of(memory->contact.multiplier_map())))) {}

  RCP<const ThyraSpace> get_x_space() const { return space_; }
  RCP<const ThyraSpace> get_f_space() const { return space_; }
  ThyraInArgs getNominalValues() const {
    const ThyraInArgs of_model = getUnderlyingModel()->getNominalValues();
    ThyraInArgs result = createInArgs();
    result.setArgs(of_model, true);
    set_product(of_model.get_x(), *memory().multipliers, [&](const RCP<ThyraVector>& x) { result.set_x(x); });
    const Vector none(memory().contact.multiplier_map());
    if (of_model.supports(Base::IN_ARG_x_dot)) set_product(of_model.get_x_dot(), none, [&](const RCP<ThyraVector>& x) { result.set_x_dot(x); });
    if (of_model.supports(Base::IN_ARG_x_dot_dot))
      set_product(of_model.get_x_dot_dot(), none, [&](const RCP<ThyraVector>& x) { result.set_x_dot_dot(x); });
    return result;
  }
  ThyraInArgs getLowerBounds() const { return createInArgs(); }
  ThyraInArgs getUpperBounds() const { return createInArgs(); }
  RCP<::Thyra::LinearOpBase<Scalar>> create_W_op() const { return rcp(new ProductOperator(shared_memory_, space_)); }
  RCP<::Thyra::LinearOpWithSolveBase<Scalar>> create_W() const { return ::Thyra::ModelEvaluatorDefaultBase<Scalar>::create_W(); }
  RCP<::Thyra::PreconditionerBase<Scalar>> create_W_prec() const { return Teuchos::null; }
  RCP<const ThyraSolverFactory> get_W_factory() const { return solver_; }

 private:
  template <class Set>
  void set_product(const RCP<const ThyraVector>& of_model, const Vector& z, const Set& set) const {
    if (of_model.is_null()) return;
    const RCP<ThyraVector> x = ::Thyra::createMember(*space_);
    auto& product = dynamic_cast<ProductVector&>(*x);
    Tpetra::deep_copy(*TpetraOfThyra::getTpetraVector(product.getNonconstVectorBlock(0)), *tpetra(*of_model));
    Tpetra::deep_copy(*TpetraOfThyra::getTpetraVector(product.getNonconstVectorBlock(1)), z);
    set(x);
  }

  ThyraOutArgs createOutArgsImpl() const override {
    const ThyraOutArgs of_model = getUnderlyingModel()->createOutArgs();
    Base::OutArgsSetup<Scalar> result = out_args_with_contact(*getUnderlyingModel());
    for (int l = 0; l < of_model.Np(); ++l) result.setSupports(Base::OUT_ARG_DfDp, l, Base::DerivativeSupport());
    for (int j = 0; j < of_model.Ng(); ++j) {
      result.setSupports(Base::OUT_ARG_DgDx, j, Base::DerivativeSupport());
      result.setSupports(Base::OUT_ARG_DgDx_dot, j, Base::DerivativeSupport());
    }
    return result;
  }

  void evalModelImpl(const ThyraInArgs& in, const ThyraOutArgs& out) const override {
    evaluate_or_fail(memory(), out, [&] { evaluate(in, out); });
  }

  void evaluate(const ThyraInArgs& in, const ThyraOutArgs& out) const {
    ThyraInArgs of_displacements = getUnderlyingModel()->createInArgs();
    of_displacements.setArgs(in, true);
    const auto take = [](const RCP<const ThyraVector>& x) { return x.is_null() ? x : block(*x, 0); };
    of_displacements.set_x(take(in.get_x()));
    if (in.supports(Base::IN_ARG_x_dot)) of_displacements.set_x_dot(take(in.get_x_dot()));
    if (in.supports(Base::IN_ARG_x_dot_dot)) of_displacements.set_x_dot_dot(take(in.get_x_dot_dot()));
    const auto W = Teuchos::rcp_dynamic_cast<ProductOperator>(out.get_W_op());
    if (W.is_null() && !out.get_W_op().is_null())
      throw std::invalid_argument("contact: W_op was not made by create_W_op() of the model with contact");
    auto* f = dynamic_cast<ProductVector*>(out.get_f().get());
    evaluate_host(*getUnderlyingModel(), of_displacements, out, f == nullptr ? Teuchos::null : f->getNonconstVectorBlock(0),
                  W.is_null() ? Teuchos::null : of_model_);
    if (f == nullptr && W.is_null()) return;
    const auto d = rcp(new Vector(*tpetra(*of_displacements.get_x()), Teuchos::Copy));
    const RCP<const Vector> z = tpetra(*block(*in.get_x(), 1));
    memory().of_nodes = memory().eliminated(in);
    if (memory().heat) memory().of_heat = memory().heat->conditions(in);
    const NodalDisplacement displacement = memory().displacement(*d, memory().of_nodes);
    if (W.is_null()) {
      const ContactLaws laws = memory().laws(memory().contact.evaluate(displacement, memory().history), *z);
      std::optional<ContactHeat> heat;
      if (memory().heat) heat = memory().heat->evaluate(laws, *d, memory().of_heat);
      add_contact(in, *d, laws, heat, *f);
      return;
    }
    const DifferentiatedContact at = memory().contact.differentiate(displacement, memory().history);
    const ContactIterate iterate = memory().iterate(d, at, *z);
    if (f != nullptr) add_contact(in, *d, iterate.laws, iterate.heat ? std::optional<ContactHeat>(iterate.heat->rows()) : std::nullopt, *f);
    const double weight = weight_of_displacements(of_displacements);
    if (weight == 0.0) throw std::invalid_argument("contact: W without df/dx has no rows for multipliers; take it of the application's own model");
    W->assemble(bulk_, weight, iterate);
  }

  void add_contact(const ThyraInArgs& in, const Vector& d, const ContactLaws& laws, const std::optional<ContactHeat>& heat, ProductVector& f) const {
    const RCP<Vector> of_d = TpetraOfThyra::getTpetraVector(f.getNonconstVectorBlock(0)),
                      of_z = TpetraOfThyra::getTpetraVector(f.getNonconstVectorBlock(1));
    const Vector of_model(*of_d, Teuchos::Copy);
    laws.add_force(*of_d);
    if (heat) heat->add_to(*of_d);
    memory().prescribe(in, d, of_model, *of_d);
    Vector C(of_z->getMap());
    laws.complementarity(C);
    of_z->elementWiseMultiply(1.0, *memory().contact.weights(), C, 0.0);
  }

  RCP<const Vector> displacements_of(const ThyraVector& x) const override { return tpetra(*block(x, 0)); }
  RCP<const Vector> multipliers_of(const ThyraVector& x) const override { return tpetra(*block(x, 1)); }
  void begin() override {}

  std::shared_ptr<StepMemory> shared_memory_;
  RCP<const ThyraSolverFactory> solver_;
  RCP<::Thyra::LinearOpBase<Scalar>> of_model_;
  RCP<Matrix> bulk_;
  RCP<const ::Thyra::DefaultProductVectorSpace<Scalar>> space_;
};

}  // namespace

RCP<ModelWithContact> product_model(const RCP<ThyraModel>& model, const std::shared_ptr<StepMemory>& memory,
                                    const RCP<const ThyraSolverFactory>& solver) {
  return rcp(new ProductModel(model, memory, solver));
}

}  // namespace mortise::detail
