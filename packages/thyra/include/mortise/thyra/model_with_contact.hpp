#pragma once
// Contact for an application whose equations are a Thyra::ModelEvaluator: a decorator of its model.

#include <Thyra_LinearOpWithSolveFactoryBase.hpp>
#include <Thyra_ModelEvaluatorDelegatorBase.hpp>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "mortise/contact/contact_system.hpp"
#include "mortise/core/nodal_field.hpp"
#include "mortise/thermal_contact/thermal_contact.hpp"

namespace mortise {

namespace detail {
struct StepMemory;
}  // namespace detail

using ThyraModel = ::Thyra::ModelEvaluator<Scalar>;
using ThyraVector = ::Thyra::VectorBase<Scalar>;
using ThyraInArgs = ::Thyra::ModelEvaluatorBase::InArgs<Scalar>;
using ThyraOutArgs = ::Thyra::ModelEvaluatorBase::OutArgs<Scalar>;
using ThyraSolverFactory = ::Thyra::LinearOpWithSolveFactoryBase<Scalar>;

/// Displacements of an application: where they stand among its unknowns x, and what of them is prescribed.
struct HostDisplacements {
  NodalField field;                  ///< which entry of x each component at an owned node is; NodalField::none: no unknown
  RCP<const MultiVector> reference;  ///< [owned nodes x dim] reference positions
  RCP<const MultiVector> fixed;      ///< [owned nodes x dim] 1 where prescribed, else 0
  /// Values of prescribed displacements, on the map of x; the other entries are not read. With it the model has no boundary conditions in f and W:
  /// rows of marked dofs are replaced. Null: these rows of the model's f and W are its boundary conditions, and stay as they are.
  std::function<void(const ThyraInArgs& at, Vector& values)> prescribed;
  /// [owned nodes x dim] displacements of components that are no unknowns. Null: they do not move.
  std::function<void(const ThyraInArgs& at, MultiVector& of_nodes)> eliminated;
};

/// Temperatures of an application, and what flows between them across contact. Rows of heat of the model are conduction + storage - sources.
struct HostHeat {
  NodalField temperature;          ///< which entry of x the temperature at an owned node is; NodalField::none: no row of heat
  std::vector<ThermalPair> pairs;  ///< by their places in the list of pairs that with_contact() gets
  /// Time that the step takes, above 0. Needed where friction gives heat. Null: laws of conductance see no slip rate.
  std::function<double(const ThyraInArgs& at)> time_step = {};
  /// [owned nodes x 1] 1 where the temperature is prescribed, else 0; null: nowhere. The rows of the model's f and W that it marks are its boundary
  /// conditions, and stay as they are: no heat of contact is added to them. Rows that are not marked get it.
  RCP<const MultiVector> fixed = {};
  /// [owned nodes] temperatures of nodes without a row of heat; NaN, which it begins with: the node has none. Null: no such node has one.
  std::function<void(const ThyraInArgs& at, Vector& of_nodes)> eliminated = {};
};

/// Unknowns of a model with contact.
enum class ContactUnknowns {
  displacements,                 ///< x of the application; multipliers are condensed, and follow Newton's steps
  displacements_and_multipliers  ///< the product (x, z)
};

/// The rest of what with_contact() may be told.
struct WithContactOptions {
  ContactUnknowns unknowns = ContactUnknowns::displacements;  ///< of the decorated model
  InterfaceMeasure measure;                                   ///< of interfaces in 2D
  Timers timers;                                              ///< of contact
  RCP<const ThyraSolverFactory> linear_solver;                ///< of condensed systems; null: get_W_factory() of the model
  std::optional<HostHeat> heat = {};                          ///< heat across contact; none: f and W have contact alone
};

/// A model with contact. Its f and W have the forces and conditions of contact. All else is the application's and passes through: parameters,
/// responses, time, time derivatives and their weights.
///
/// f and W are functions of x, of the last accepted step, and of the start of this one. With condensed multipliers, z is a function of x too. It is
/// z_k + a dz at x_k + a dx, where (dx, dz) is what a solve with W at x_k gave for the right-hand side f(x_k). Elsewhere it is that of the nearest
/// such point. So line searches are followed, whatever is evaluated in which order. Methods that leave the directions of Newton's method, as trust
/// regions do, take the product space.
///
/// A step is undone by going back to its x. Nothing is remembered but by accept_step() and update_multipliers(). Collective in all members but the
/// accessors.
class ModelWithContact : public ::Thyra::ModelEvaluatorDelegatorBase<Scalar> {
 public:
  ~ModelWithContact() override;

  /// Starts a step at x, whose displacement need not be the accepted one: sets multipliers of nodes that touch. accept_step() does so at its own x.
  /// So this is called where a step starts elsewhere, or where clearances depend on time.
  /// @param time  at the end of the step, for clearances; none: as before, at first 0
  /// @throws StepFailure on every rank, as ContactSystem::evaluate()
  void start_step(const ThyraVector& x, std::optional<double> time = std::nullopt);
  /// Updates multipliers of augmented Lagrange at a solution x. True: solve again, beginning at x, before the step is accepted.
  /// @throws StepFailure on every rank, where more updates are needed than the pair allows
  bool update_multipliers(const ThyraVector& x);
  /// Accepts the step that ends at x, a solution. The next step starts there.
  /// @throws StepFailure on every rank, as ContactSystem::evaluate()
  void accept_step(const ThyraVector& x);

  /// Contact itself, with its maps and pairs.
  const ContactSystem& contact() const;
  /// Multipliers that go with x, on contact().multiplier_map().
  RCP<const Vector> multipliers(const ThyraVector& x) const;
  /// Laws at the end of the last accepted step, for reports on it; none before the first one.
  const std::optional<ContactLaws>& accepted_laws() const;
  /// Heat across contact at x within the step that is under way. Temperatures without rows and the time of the step are those of the last evaluation.
  /// @throws std::logic_error without WithContactOptions::heat; what ThermalContact::evaluate() throws
  ContactHeat heat(const ThyraVector& x) const;
  /// Heat at the end of the last accepted step; none before the first one, and without WithContactOptions::heat.
  const std::optional<ContactHeat>& accepted_heat() const;
  /// Reason why the last evaluation failed: its f is NaN. None where it did not. W without f throws the reason, a StepFailure, on every rank.
  const std::optional<StepFailure>& failure() const;

  /// Memory of the last accepted step, which resume() takes: also that of another model of the same surfaces, as where a support is released.
  const ContactHistory& history() const;
  const Vector& accepted_multipliers() const;  ///< z of the last accepted step
  /// Goes on from an accepted step, at x.
  void resume(const ContactHistory& history, const Vector& multipliers, const ThyraVector& x);
  void store(StateArchive& archive) const;                    ///< stores what was accepted last
  void restore(StateArchive& archive, const ThyraVector& x);  ///< goes on from what was stored; x: the accepted one

 protected:
  /// Used by with_contact().
  ModelWithContact(const RCP<ThyraModel>& model, std::shared_ptr<detail::StepMemory> memory);
  detail::StepMemory& memory() const { return *memory_; }  ///< shared by all evaluations

 private:
  friend RCP<ModelWithContact> with_contact(const RCP<ThyraModel>& model, const HostDisplacements& displacements, std::vector<ContactPair> pairs,
                                            const WithContactOptions& options);
  virtual RCP<const Vector> displacements_of(const ThyraVector& x) const = 0;
  virtual RCP<const Vector> multipliers_of(const ThyraVector& x) const = 0;
  virtual void begin() = 0;  ///< a step, or a round of updates, at the multipliers of the memory
  ContactLaws laws_at(const ThyraVector& x) const;
  ContactHeat heat_at(const ContactLaws& laws, const ThyraVector& x) const;
  void start(const Vector& d, std::optional<double> time);

  std::shared_ptr<detail::StepMemory> memory_;
};

/// The model with contact: the one line that an application changes.
/// @param model  with Tpetra vectors and a W_op that is a Tpetra::CrsMatrix, on a graph that is complete
/// @throws std::invalid_argument for a model that is not so, that has no solver for W, or with condensed multipliers whose formulation keeps them
/// @throws std::invalid_argument for heat whose marks are on other nodes, whose ids are those of displacements, or of friction without a time step
/// @throws what ContactSystem and ThermalContact refuse
RCP<ModelWithContact> with_contact(const RCP<ThyraModel>& model, const HostDisplacements& displacements, std::vector<ContactPair> pairs,
                                   const WithContactOptions& options = {});

}  // namespace mortise
