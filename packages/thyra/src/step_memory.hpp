#pragma once
// The memory of a model with contact: what was accepted last, and the start of the step that is under way.

#include <functional>
#include <optional>
#include <vector>

#include "heat_of_model.hpp"
#include "mortise/thyra/model_with_contact.hpp"

namespace mortise::detail {

/// Contact at an iterate.
struct ContactIterate {
  RCP<const Vector> d;              ///< a copy
  RCP<const MultiVector> of_nodes;  ///< displacements of components without unknown; null: none
  DifferentiatedContact at;
  ContactLaws laws;
  std::optional<HeatOfIterate> heat;  ///< none: the model has no heat
  const Vector& z() const { return laws.multipliers(); }
};

struct StepMemory {
  StepMemory(HostDisplacements displacements, const RCP<const Map>& dofs, std::vector<ContactPair> pairs, const WithContactOptions& options,
             const ThyraInArgs& nominal, const Vector& d);

  HostDisplacements displacements;
  RCP<const Map> dofs;
  ContactSystem contact;
  std::optional<HeatOfModel> heat;       ///< none: the model has no heat
  std::vector<LocalOrdinal> prescribed;  ///< rows of unknowns that are marked as prescribed: those of the next two
  std::vector<LocalOrdinal> replaced;    ///< of them, that HostDisplacements::prescribed replaces
  std::vector<LocalOrdinal> kept;        ///< of them, that are the model's boundary conditions
  double stiffness = 0.0;                ///< E h^(dim - 2), of the rows that are replaced
  RCP<const MultiVector> of_nodes;       ///< of the last evaluation; null: none
  HeatConditions of_heat;                ///< of the last evaluation

  ContactHistory accepted;
  RCP<const Vector> accepted_multipliers;
  std::optional<ContactLaws> accepted_laws;
  std::optional<ContactHeat> accepted_heat;
  ContactHistory history;              ///< that holds within the step
  RCP<const Vector> multipliers;       ///< at its start, or at the last update of multipliers
  double time = 0.0;                   ///< of clearances
  int updates = 0;                     ///< of multipliers in the step
  std::optional<StepFailure> failure;  ///< of the last evaluation

  /// The displacement of an evaluation.
  NodalDisplacement displacement(const Vector& d, const RCP<const MultiVector>& at_nodes) const;
  /// Displacements of components without unknown; null if there are none.
  RCP<const MultiVector> eliminated(const ThyraInArgs& at) const;
  /// Gives prescribed rows of f what they are: the model's, or s (x - prescribed).
  void prescribe(const ThyraInArgs& at, const Vector& x, const Vector& of_model, Vector& f) const;
  /// Laws of an evaluation, with a bound of friction at all nodes.
  ContactLaws laws(const ContactEvaluation& at, const Vector& z) const;
  /// Contact at an iterate, with heat at the conditions of the last evaluation.
  ContactIterate iterate(const RCP<const Vector>& d, const DifferentiatedContact& at, const Vector& z) const;
};

/// Weight of df/dx in W: beta, and 1 of a model without time derivatives, for which solvers do not set it.
double weight_of_displacements(const ThyraInArgs& at);

/// Calls the model with what of `out` is its own, f and W_op apart.
/// @throws StepFailure on every rank, where its f is no number: so Thyra's models say that they failed
void evaluate_host(const ThyraModel& model, const ThyraInArgs& in, const ThyraOutArgs& out, const RCP<ThyraVector>& f,
                   const RCP<::Thyra::LinearOpBase<Scalar>>& W);

/// What a model with contact gives: what the application's gives, with W made of W_op and the factory by the base class.
::Thyra::ModelEvaluatorBase::OutArgsSetup<Scalar> out_args_with_contact(const ThyraModel& model);

/// Evaluates, on all ranks. A failure is kept, and is NaN in f; without an f it is thrown.
/// @throws StepFailure on every rank
void evaluate_or_fail(StepMemory& memory, const ThyraOutArgs& out, const std::function<void()>& evaluate);

/// The matrix in a W_op.
/// @throws std::invalid_argument for anything but a Tpetra::CrsMatrix on a complete graph
RCP<Matrix> matrix_of(const RCP<::Thyra::LinearOpBase<Scalar>>& W);

}  // namespace mortise::detail
