#include "condensed_model.hpp"

#include <Thyra_DefaultLinearOpSource.hpp>
#include <Thyra_TpetraLinearOp.hpp>
#include <Thyra_VectorStdOps.hpp>
#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_Vector.hpp>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "condensed_matrix.hpp"
#include "contact_solve.hpp"
#include "newton_lines.hpp"
#include "tpetra_of_thyra.hpp"

namespace mortise::detail {
namespace {

using Base = ::Thyra::ModelEvaluatorBase;
using TpetraOp = ::Thyra::TpetraLinearOp<Scalar, LocalOrdinal, GlobalOrdinal, NodeType>;

/// The last evaluation of f.
struct Residual {
  RCP<const Vector> d;
  RCP<const Vector> right;        ///< -r, without contact
  RCP<const Vector> condensed;    ///< f
  RCP<const Vector> multipliers;  ///< z that momentum gives at d, as f sees it
};

/// What a model and its W_op share.
struct Progress {
  NewtonLines lines;
  std::optional<Residual> last;
};

/// A W_op. Its matrix is another object where the graph is another one, so whoever holds the operator need not ask for it again.
class CondensedOperator : public TpetraOp, public SolvedByCondensing {
 public:
  CondensedOperator(std::shared_ptr<StepMemory> memory, std::shared_ptr<Progress> progress)
      : memory_(std::move(memory)), progress_(std::move(progress)) {}

  /// W = weight A, with A of the iterate.
  void assemble(const Matrix& K, double weight, const ContactIterate& iterate, std::size_t lines) {
    const StepMemory& memory = *memory_;
    // Without displacements, as in a mass matrix, there is no contact.
    const bool has_contact = weight != 0.0;
    const double share = has_contact ? 1.0 / weight : 1.0;
    if (matrix_.open(memory.contact, iterate.at, K)) {
      ++graph_number_;
      initialize(space_of(memory.dofs), space_of(memory.dofs), matrix_.matrix());
    }
    Matrix& A = *matrix_.matrix();
    matrix_.add(K, share);
    elimination_.reset();
    if (has_contact) {
      const ContactLinearisation linearised = iterate.at.linearise(iterate.laws);
      // Geometric stiffness has to wait for states to settle, as in Mortise's own Newton method.
      const ContactNorms norms = iterate.laws.norms(progress_->lines.states_before(lines));
      if (4 * norms.changed <= norms.active) linearised.add_stiffness(A);
      Vector none(memory.dofs);
      elimination_ = linearised.condense(A, none);
      if (iterate.heat) {
        iterate.heat->add_slopes(A);
        iterate.heat->add_substituted(*elimination_, A);
      }
      matrix_.replace_rows(memory.replaced, K, share, memory.stiffness);
      matrix_.replace_rows(memory.kept, K, share, 0.0);
    }
    if (has_contact && weight != 1.0) A.scale(weight);
    A.fillComplete(memory.dofs, memory.dofs);
    weight_ = weight;
    lines_ = lines;
    d_ = iterate.d;
    z_ = rcp(new Vector(iterate.z(), Teuchos::Copy));
    states_ = iterate.laws.states();
    G_ = iterate.heat ? iterate.heat->of_multipliers() : Teuchos::null;
  }

  RCP<const ::Thyra::LinearOpBase<Scalar>> condensed() const override {
    return Teuchos::rcpFromRef(static_cast<const ::Thyra::LinearOpBase<Scalar>&>(*this));
  }
  long graph_number() const override { return graph_number_; }

  void solve(const ::Thyra::VectorBase<Scalar>& b, const NodeElimination::Solve& inner, ::Thyra::VectorBase<Scalar>& x) const override {
    const RCP<const Vector> right = tpetra(b);
    const RCP<Vector> solution = tpetra(x);
    if (!elimination_) {
      inner(*right, *solution);
      return;
    }
    const auto of_increments = [&](const Vector& rhs, Vector& dd) {
      inner(rhs, dd);
      if (weight_ != 1.0) dd.scale(weight_);
    };
    const auto dd = rcp(new Vector(memory_->dofs)), dz = rcp(new Vector(memory_->contact.multiplier_map()));
    const double share = share_of_residual(*right);
    if (share != 0.0) {
      Vector rhs(*progress_->last->right, Teuchos::Copy);
      const NodeElimination elimination = elimination_->apply(rhs);
      rhs.update(-1.0, *progress_->last->condensed, 0.0);
      elimination.solve(rhs, of_increments, *dd, *dz, G_.get());
      solution->update(-share / weight_, *dd, 0.0);
      progress_->lines.add(lines_, {d_, z_, dd, dz, states_});
    } else {
      Vector none(memory_->dofs);
      elimination_->apply(none, Vector(memory_->contact.multiplier_map())).solve(*right, of_increments, *dd, *dz, G_.get());
      solution->update(1.0 / weight_, *dd, 0.0);
    }
  }

 protected:
  // Scaled rows would hide from solve() whether a right-hand side is f.
  bool supportsScaleLeftImpl() const override { return false; }
  bool supportsScaleRightImpl() const override { return false; }
  bool rowStatIsSupportedImpl(const ::Thyra::RowStatLinearOpBaseUtils::ERowStat) const override { return false; }

 private:
  // s where b = s f at the iterate of W; 0: it is another right-hand side.
  double share_of_residual(const Vector& b) const {
    if (!progress_->last || !are_equal(*progress_->last->d, *d_)) return 0.0;
    const Vector& f = *progress_->last->condensed;
    const double size = f.norm2();
    if (!(size > 0.0)) return 0.0;
    const double share = b.dot(f) / size / size;
    Vector rest(b, Teuchos::Copy);
    rest.update(-share, f, 1.0);
    return rest.norm2() <= 1e-12 * std::abs(share) * size ? share : 0.0;
  }

  std::shared_ptr<StepMemory> memory_;
  std::shared_ptr<Progress> progress_;
  CondensedMatrix matrix_;
  long graph_number_ = 0;
  std::optional<NodeElimination> elimination_;  ///< none: W has no contact
  double weight_ = 1.0;
  std::size_t lines_ = 0;
  RCP<const Vector> d_, z_;
  ContactStates states_;
  RCP<const Matrix> G_;  ///< HeatOfIterate::of_multipliers(); null: none
};

class CondensedModel : public ModelWithContact {
 public:
  CondensedModel(const RCP<ThyraModel>& model, const std::shared_ptr<StepMemory>& memory, const RCP<const ThyraSolverFactory>& solver)
      : ModelWithContact(model, memory),
        shared_memory_(memory),
        solver_(contact_solver_factory(solver)),
        of_model_(model->create_W_op()),
        bulk_(matrix_of(of_model_)),
        last_in_(model->getNominalValues()) {
    if (memory->contact.keeps_multipliers())
      throw std::invalid_argument(
          "contact: a formulation keeps its multipliers as unknowns; take ContactUnknowns::displacements_and_multipliers, or another formulation");
  }

  RCP<::Thyra::LinearOpBase<Scalar>> create_W_op() const override {
    const auto W = rcp(new CondensedOperator(shared_memory_, progress_));
    W->initialize(space_of(memory().dofs), space_of(memory().dofs), bulk_);  // until it is evaluated
    return W;
  }
  RCP<::Thyra::LinearOpWithSolveBase<Scalar>> create_W() const override { return ::Thyra::ModelEvaluatorDefaultBase<Scalar>::create_W(); }
  RCP<::Thyra::PreconditionerBase<Scalar>> create_W_prec() const override { return Teuchos::null; }
  RCP<const ThyraSolverFactory> get_W_factory() const override { return solver_; }

 private:
  ThyraOutArgs createOutArgsImpl() const override {
    const ThyraOutArgs of_model = getUnderlyingModel()->createOutArgs();
    Base::OutArgsSetup<Scalar> result = out_args_with_contact(*getUnderlyingModel());
    for (int l = 0; l < of_model.Np(); ++l) {  // condensed column by column
      const bool has_columns = !memory().displacements.prescribed && of_model.supports(Base::OUT_ARG_DfDp, l).supports(Base::DERIV_MV_JACOBIAN_FORM);
      result.setSupports(Base::OUT_ARG_DfDp, l, has_columns ? Base::DerivativeSupport(Base::DERIV_MV_JACOBIAN_FORM) : Base::DerivativeSupport());
    }
    return result;
  }

  void evalModelImpl(const ThyraInArgs& in, const ThyraOutArgs& out) const override {
    evaluate_or_fail(memory(), out, [&] { evaluate(in, out); });
  }

  void evaluate(const ThyraInArgs& in, const ThyraOutArgs& out) const {
    const RCP<ThyraVector> f = out.get_f();
    const auto W = Teuchos::rcp_dynamic_cast<CondensedOperator>(out.get_W_op());
    if (W.is_null() && !out.get_W_op().is_null())
      throw std::invalid_argument("contact: W_op was not made by create_W_op() of the model with contact");
    evaluate_host(*getUnderlyingModel(), in, out, f, W.is_null() ? Teuchos::null : of_model_);
    std::vector<RCP<::Thyra::MultiVectorBase<Scalar>>> sensitivities;
    for (int l = 0; l < out.Np(); ++l)
      if (!out.supports(Base::OUT_ARG_DfDp, l).none())
        if (const auto columns = out.get_DfDp(l).getMultiVector(); !columns.is_null()) sensitivities.push_back(columns);
    if (f.is_null() && W.is_null() && sensitivities.empty()) return;
    last_in_ = in;
    const PlaceOnLines place = evaluate_contact(in);
    if (!f.is_null() || !sensitivities.empty()) {
      scratch_.open(memory().contact, iterate_->at, *bulk_);
      const auto right = rcp(new Vector(memory().dofs));
      if (!f.is_null()) right->update(-1.0, *tpetra(*f), 0.0);
      Vector condensed(*right, Teuchos::Copy);
      const NodeElimination elimination = iterate_->at.linearise(iterate_->laws).condense(*scratch_.matrix(), condensed);
      if (iterate_->heat) iterate_->heat->condense(elimination, condensed);
      if (!f.is_null()) take_residual(in, *tpetra(*f), right, condensed, elimination);
      for (const auto& columns : sensitivities) condense_columns(elimination, *columns);
    }
    if (!W.is_null()) W->assemble(*bulk_, weight_of_displacements(in), *iterate_, place.lines);
  }

  void take_residual(const ThyraInArgs& in, Vector& f, const RCP<const Vector>& right, const Vector& condensed,
                     const NodeElimination& elimination) const {
    const Vector of_model(f, Teuchos::Copy);
    f.update(-1.0, condensed, 0.0);
    memory().prescribe(in, *iterate_->d, of_model, f);
    const auto z = rcp(new Vector(memory().contact.multiplier_map()));
    elimination.recover(Vector(memory().dofs), *z);
    progress_->last = Residual{iterate_->d, right, rcp(new Vector(f, Teuchos::Copy)), z};
  }

  void condense_columns(const NodeElimination& elimination, ::Thyra::MultiVectorBase<Scalar>& columns) const {
    const Vector none(memory().contact.multiplier_map());
    for (int j = 0; j < columns.domain()->dim(); ++j) {
      const RCP<Vector> column = tpetra(*columns.col(j));
      Vector condensed(memory().dofs);
      condensed.update(-1.0, *column, 0.0);
      const NodeElimination of_column = elimination.apply(condensed, none);
      if (iterate_->heat) iterate_->heat->take_constant(of_column, condensed);
      {
        const auto from = condensed.getLocalViewHost(Tpetra::Access::ReadWrite);
        const auto before = column->getLocalViewHost(Tpetra::Access::ReadOnly);
        for (const LocalOrdinal row : memory().prescribed) from(row, 0) = -before(row, 0);
      }
      column->update(-1.0, condensed, 0.0);
    }
  }

  // Contact at x: kept for a second evaluation there.
  PlaceOnLines evaluate_contact(const ThyraInArgs& in) const {
    const Vector& d = *tpetra(*in.get_x());
    memory().of_nodes = memory().eliminated(in);
    if (memory().heat) memory().of_heat = memory().heat->conditions(in);
    PlaceOnLines place = progress_->lines.place(d);
    const bool is_kept = iterate_ && history_ == &*memory().history && are_equal(d, *iterate_->d) && are_equal(*place.z, *on_line_) &&
                         (memory().of_nodes.is_null() || are_equal(*memory().of_nodes, *iterate_->of_nodes)) &&
                         (!iterate_->heat || are_equal(memory().of_heat, iterate_->heat->conditions()));
    if (!is_kept) {
      iterate_.reset();  // its memory
      const auto copy = rcp(new Vector(d, Teuchos::Copy));
      const DifferentiatedContact at = memory().contact.differentiate(memory().displacement(*copy, memory().of_nodes), memory().history);
      Vector z(*place.z, Teuchos::Copy);
      if (!place.starts_line) at.follow_cover(progress_->lines.states_before(place.lines), z);
      iterate_.emplace(memory().iterate(copy, at, z));
      on_line_ = place.z;
      history_ = &*memory().history;
    }
    return place;
  }

  RCP<const Vector> displacements_of(const ThyraVector& x) const override { return tpetra(x); }

  // At a solution those that momentum gives, of the last evaluation of f there.
  RCP<const Vector> multipliers_of(const ThyraVector& x) const override {
    if (!progress_->last || !are_equal(*progress_->last->d, *tpetra(x))) {
      const RCP<ThyraVector> f = ::Thyra::createMember(*get_f_space());
      ThyraInArgs in = last_in_;
      in.set_x(Teuchos::rcpFromRef(x));
      ThyraOutArgs out = createOutArgs();
      out.set_f(f);
      evalModel(in, out);
      last_in_.set_x(Teuchos::null);
      if (memory().failure) throw *memory().failure;
    }
    return progress_->last->multipliers;
  }

  void begin() override {
    progress_->lines.start(memory().multipliers, memory().history->states);
    progress_->last.reset();
    iterate_.reset();
  }

  std::shared_ptr<StepMemory> shared_memory_;
  std::shared_ptr<Progress> progress_ = std::make_shared<Progress>();
  RCP<const ThyraSolverFactory> solver_;
  RCP<::Thyra::LinearOpBase<Scalar>> of_model_;  ///< W_op of the application
  RCP<Matrix> bulk_;                             ///< in it
  mutable ThyraInArgs last_in_;
  mutable CondensedMatrix scratch_;  ///< zeros: what condenses right-hand sides does not depend on the bodies
  mutable std::optional<ContactIterate> iterate_;
  mutable RCP<const Vector> on_line_;                 ///< its multipliers before they followed what is covered
  mutable const AcceptedContact* history_ = nullptr;  ///< of the iterate
};

}  // namespace

RCP<ModelWithContact> condensed_model(const RCP<ThyraModel>& model, const std::shared_ptr<StepMemory>& memory,
                                      const RCP<const ThyraSolverFactory>& solver) {
  return rcp(new CondensedModel(model, memory, solver));
}

}  // namespace mortise::detail
