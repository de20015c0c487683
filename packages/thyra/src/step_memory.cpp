#include "step_memory.hpp"

#include <Thyra_VectorStdOps.hpp>
#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_MultiVector.hpp>
#include <Tpetra_Vector.hpp>
#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>

#include "mortise/core/over_ranks.hpp"
#include "tpetra_of_thyra.hpp"

namespace mortise::detail {

bool are_equal(const MultiVector& one, const MultiVector& other) {
  const auto a = one.getLocalViewHost(Tpetra::Access::ReadOnly), b = other.getLocalViewHost(Tpetra::Access::ReadOnly);
  int equal = a.extent(0) == b.extent(0) && a.extent(1) == b.extent(1) ? 1 : 0;
  for (std::size_t j = 0; j < a.extent(1) && equal == 1; ++j)
    for (std::size_t i = 0; i < a.extent(0) && equal == 1; ++i)
      if (std::memcmp(&a(i, j), &b(i, j), sizeof(Scalar)) != 0) equal = 0;
  return least_over_ranks(*one.getMap()->getComm(), equal) == 1;
}

StepMemory::StepMemory(HostDisplacements of_host, const RCP<const Map>& rows, std::vector<ContactPair> pairs, const WithContactOptions& options,
                       const ThyraInArgs& nominal, const Vector& d)
    : displacements(std::move(of_host)),
      dofs(rows),
      contact(displacements.field, dofs, displacements.reference, displacements.fixed, options.measure, pairs, options.timers,
              options.heat ? std::vector<NodalField>{options.heat->temperature} : std::vector<NodalField>{}),
      of_nodes(eliminated(nominal)),
      accepted(contact.initial_history(displacement(d, of_nodes))),
      accepted_multipliers(rcp(new Vector(contact.multiplier_map()))),
      history(accepted),
      multipliers(accepted_multipliers) {
  const auto marks = displacements.fixed->getLocalViewHost(Tpetra::Access::ReadOnly);
  const auto dimension = displacements.field.components();
  for (LocalOrdinal node = 0; node < static_cast<LocalOrdinal>(marks.extent(0)); ++node)
    for (int i = 0; i < dimension; ++i)
      if (const GlobalOrdinal id = displacements.field.id(node, i); id != NodalField::none && marks(node, i) != 0.0)
        (displacements.prescribed ? replaced : kept).push_back(dofs->getLocalElement(id));
  if (options.heat) {
    heat.emplace(*options.heat, displacements.field, contact, dofs);
    of_heat = heat->conditions(nominal);
    kept.insert(kept.end(), heat->prescribed().begin(), heat->prescribed().end());
  }
  prescribed = replaced;
  prescribed.insert(prescribed.end(), kept.begin(), kept.end());
  double modulus = 0.0;
  for (const ContactPair& pair : pairs) modulus = std::max(modulus, pair.youngs_modulus);
  const double area = contact.weights()->meanValue();
  stiffness = dimension == 2 ? modulus : modulus * std::sqrt(area);
}

NodalDisplacement StepMemory::displacement(const Vector& d, const RCP<const MultiVector>& at_nodes) const {
  return at_nodes.is_null() ? NodalDisplacement(d) : NodalDisplacement(d, *at_nodes);
}

RCP<const MultiVector> StepMemory::eliminated(const ThyraInArgs& at) const {
  if (!displacements.eliminated) return Teuchos::null;
  const auto values = rcp(new MultiVector(displacements.reference->getMap(), displacements.reference->getNumVectors()));
  displacements.eliminated(at, *values);
  return values;
}

void StepMemory::prescribe(const ThyraInArgs& at, const Vector& x, const Vector& of_model, Vector& f) const {
  const auto rows = f.getLocalViewHost(Tpetra::Access::ReadWrite);
  {
    const auto before = of_model.getLocalViewHost(Tpetra::Access::ReadOnly);
    for (const LocalOrdinal row : kept) rows(row, 0) = before(row, 0);
  }
  if (!displacements.prescribed) return;
  Vector values(dofs);
  displacements.prescribed(at, values);
  const auto d = x.getLocalViewHost(Tpetra::Access::ReadOnly), to = values.getLocalViewHost(Tpetra::Access::ReadOnly);
  for (const LocalOrdinal row : replaced) rows(row, 0) = stiffness * (d(row, 0) - to(row, 0));
}

ContactLaws StepMemory::laws(const ContactEvaluation& at, const Vector& z) const {
  ContactLaws result = at.laws(z);
  throw_if_any(*dofs->getComm(), result.friction_failure());
  return result;
}

ContactIterate StepMemory::iterate(const RCP<const Vector>& d, const DifferentiatedContact& at, const Vector& z) const {
  ContactIterate result{d, of_nodes, at, laws(at, z), {}};
  if (heat) result.heat = heat->differentiate(at.linearise(result.laws), *d, of_heat);
  return result;
}

double weight_of_displacements(const ThyraInArgs& at) {
  using Base = ::Thyra::ModelEvaluatorBase;
  if (!at.supports(Base::IN_ARG_beta)) return 1.0;
  const bool has_rates = at.supports(Base::IN_ARG_x_dot) && !at.get_x_dot().is_null(),
             has_accelerations = at.supports(Base::IN_ARG_x_dot_dot) && !at.get_x_dot_dot().is_null();
  return has_rates || has_accelerations ? at.get_beta() : 1.0;
}

void evaluate_host(const ThyraModel& model, const ThyraInArgs& in, const ThyraOutArgs& out, const RCP<ThyraVector>& f,
                   const RCP<::Thyra::LinearOpBase<Scalar>>& W) {
  ThyraOutArgs of_model = model.createOutArgs();
  of_model.setArgs(out, true);
  if (of_model.supports(::Thyra::ModelEvaluatorBase::OUT_ARG_f)) of_model.set_f(f);
  if (of_model.supports(::Thyra::ModelEvaluatorBase::OUT_ARG_W_op)) of_model.set_W_op(W);
  model.evalModel(in, of_model);
  if (!f.is_null() && !std::isfinite(::Thyra::norm_2(*f))) throw StepFailure(FailureKind::not_finite, "f of the application's model is not a number");
}

::Thyra::ModelEvaluatorBase::OutArgsSetup<Scalar> out_args_with_contact(const ThyraModel& model) {
  using Base = ::Thyra::ModelEvaluatorBase;
  Base::OutArgsSetup<Scalar> result = model.createOutArgs();
  result.setModelEvalDescription("contact in " + model.description());
  result.setSupports(Base::OUT_ARG_W, false);
  result.setSupports(Base::OUT_ARG_W_prec, false);
  return result;
}

void evaluate_or_fail(StepMemory& memory, const ThyraOutArgs& out, const std::function<void()>& evaluate) {
  try {
    evaluate();
    memory.failure.reset();
  } catch (const StepFailure& failure) {  // on every rank
    memory.failure = failure;
    if (out.get_f().is_null()) throw;
    ::Thyra::assign(out.get_f().ptr(), std::numeric_limits<Scalar>::quiet_NaN());
  }
}

RCP<Matrix> matrix_of(const RCP<::Thyra::LinearOpBase<Scalar>>& W) {
  const auto held = Teuchos::rcp_dynamic_cast<::Thyra::TpetraLinearOp<Scalar, LocalOrdinal, GlobalOrdinal, NodeType>>(W);
  const RCP<Matrix> matrix = held.is_null() ? Teuchos::null : Teuchos::rcp_dynamic_cast<Matrix>(held->getTpetraOperator());
  if (matrix.is_null())
    throw std::invalid_argument("contact: W_op of the model is no Tpetra::CrsMatrix; contact changes the entries of W, so give a matrix");
  if (!matrix->getCrsGraph()->isFillComplete())
    throw std::invalid_argument(
        "contact: the graph of the model's W_op is not complete; let create_W_op() give a matrix on a graph after fillComplete()");
  return matrix;
}

}  // namespace mortise::detail
