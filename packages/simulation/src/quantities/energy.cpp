// Energies and works.

#include <Tpetra_Import.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>
#include <vector>

#include "mortise/simulation/quantities/quantity_support.hpp"

namespace mortise {
namespace {

/// Energies and works since the start. Works are sums of 1/2 (f_old + f) . (d - d_old) over the steps, the trapezoidal rule. So
///   external work = internal work + friction - (work of contact pressures on both sides)
/// holds to the tolerance of momentum, whatever the step. [work]
struct Energy : Quantity {
  enum class Of {
    stored,                 ///< int W dV0
    plastic_work,           ///< int int_0^alpha sigma_y dalpha dV0
    friction,               ///< of the shear tractions of all pairs with friction
    external_work,          ///< of loads and supports
    internal_work,          ///< of the internal forces
    kinetic,                ///< 1/2 v . M v
    contact_work,           ///< of all contact forces on the bodies, friction included: what contact takes is negative
    damping,                ///< taken by damping
    numerical_dissipation,  ///< external + contact work - change of stored and kinetic energy - plastic work - damping: what time integration takes
    springs,                ///< stored in springs
    dashpots,               ///< taken by dashpots; with inertia part of damping
    stabilisation           ///< taken by viscous stabilisation
  };
  Of of = Of::stored;
  Located<std::string> body;  ///< stored energy and plastic work only; empty: all

  void describe(Parameters& parameters) override {
    parameters.add(
        "of", of,
        {{"stored", Of::stored},
         {"plastic work", Of::plastic_work},
         {"friction", Of::friction},
         {"external work", Of::external_work},
         {"internal work", Of::internal_work},
         {"kinetic", Of::kinetic},
         {"contact work", Of::contact_work},
         {"damping", Of::damping},
         {"numerical dissipation", Of::numerical_dissipation},
         {"springs", Of::springs},
         {"dashpots", Of::dashpots},
         {"stabilisation", Of::stabilisation}},
        "stored in the bodies, spent on plastic flow, dissipated by friction of all pairs (of first order in the step where slip begins or "
        "turns round), or the work since the start of loads and supports, "
        "or of the internal forces; with inertia kinetic energy, the work of all contact forces on the bodies (negative where contact takes energy), "
        "what damping takes (dashpots included), or what time integration takes besides; stored in springs; taken by dashpots, or by stabilisation");
    parameters.add("body", body, "body whose stored or kinetic energy or plastic work is meant; empty: all");
    if (of != Of::stored && of != Of::plastic_work && of != Of::kinetic && !body.value.empty())
      parameters.error("body", "only stored energy, kinetic energy and plastic work are those of a body; please remove \"body\"");
  }

  std::unique_ptr<QuantityEvaluator> make_evaluator(const QuantityContext& context) const override;
};

std::unique_ptr<QuantityEvaluator> numerical_dissipation(const QuantityContext& context);

/// Adds the forces of dashpots, as the residual has them.
void add_dashpots(const QuantityContext& context, Vector& force) {
  const ConnectorsOfStep& connectors = context.connectors;
  if (connectors.dashpots == nullptr) return;
  std::optional<StepFailure> failure;  // a converged state has none
  connectors.dashpots->add_forces(*context.local_displacement, connectors.dashpot_velocity, force, failure);
}

void add_stabilisation(const QuantityContext& context, Vector& force) {
  if (context.connectors.stabilisation_force != nullptr) force.update(1.0, *context.connectors.stabilisation_force, 1.0);
}

/// What counts at reference points themselves. Followers bear what is left of loads and supports after springs, dashpots and inertia at the point, so
/// that external work lacks these there.
RCP<const Vector> forces_at_points(Energy::Of of, const QuantityContext& context) {
  const auto result = rcp(new Vector(context.space().dofs()));
  if (context.connectors.spring_force != nullptr) result->assign(*context.connectors.spring_force);
  if (of == Energy::Of::internal_work) return result;
  if (context.motion != nullptr)
    result->update(1.0, context.motion->rate_force, 1.0);
  else
    add_dashpots(context, *result);
  return result;
}

// What a work is done by, on all owned dofs. From outside act loads, and supports on prescribed dofs. Reference points act on their followers, and
// there their work is counted. A point that is carried round by an angle a with a moment M would do M a. Its followers do M sin a along the chords of
// their ways, as do all other nodes of the body. With r = f_int - f_ext + f_c the internal forces are r + f_ext - f_c, and what supports and points
// do is r. Friction takes what its forces on both sides do not give back: f_c of the shear tractions alone.
RCP<Vector> working_force(Energy::Of of, const QuantityContext& context) {
  const auto result = rcp(new Vector(context.space().dofs()));
  const auto add_contact_force = [&](const Vector& multipliers) { context.laws->evaluation().add_force(multipliers, *result); };
  if (of == Energy::Of::friction) {
    add_contact_force(*context.laws->evaluation().shear_tractions(context.laws->multipliers()));
    return result;
  }
  if (of == Energy::Of::damping) {
    if (context.motion != nullptr) result->assign(context.motion->damping_force);
    return result;
  }
  if (of == Energy::Of::dashpots) {
    add_dashpots(context, *result);
    return result;
  }
  if (of == Energy::Of::stabilisation) {
    add_stabilisation(context, *result);
    return result;
  }
  if (of == Energy::Of::contact_work) {
    add_contact_force(context.laws->multipliers());
    result->scale(-1.0);
    return result;
  }
  if (of == Energy::Of::internal_work) {
    if (context.contact != nullptr) add_contact_force(context.laws->multipliers());
    if (context.motion == nullptr) {  // viscous forces of statics are no internal ones
      add_dashpots(context, *result);
      add_stabilisation(context, *result);
    }
    result->update(1.0, *context.reaction, 1.0, *context.external_force, -1.0);
    if (context.motion != nullptr) result->update(-1.0, context.motion->rate_force, 1.0);
  } else {
    result->assign(*context.external_force);
    const auto reaction = context.reaction->getLocalViewHost(Tpetra::Access::ReadOnly);
    const auto values = result->getLocalViewHost(Tpetra::Access::ReadWrite);
    for (const auto* dofs : {context.prescribed, context.following})
      for (std::size_t n = 0; dofs != nullptr && n < dofs->size(); ++n) values((*dofs)[n], 0) += reaction((*dofs)[n], 0);
  }
  const Mesh& mesh = context.mesh();
  if (mesh.reference_points.empty()) return result;
  const RCP<const Vector> own = forces_at_points(of, context);
  const auto at_points = own->getLocalViewHost(Tpetra::Access::ReadOnly);
  const auto values = result->getLocalViewHost(Tpetra::Access::ReadWrite);
  for (const ReferencePoint& point : mesh.reference_points)
    for (const LocalOrdinal node : {point.node, point.rotation_node})
      for (int i = 0; i < mesh.dimension && node >= 0 && node < mesh.owned_count(); ++i) {
        const LocalOrdinal row = context.space().row(node, i);
        values(row, 0) = at_points(row, 0);
      }
  return result;
}

/// A work, summed up over the steps.
class WorkEvaluator final : public QuantityEvaluator {
 public:
  /// Which force does the work of a step.
  ///   - trapezoidal: the mean of those at its ends. Over the step, with inertia: the one that is in balance, f_n at t_(n+1) - alpha_f h.
  ///   - central: with inertia over the step, f_n + (1/2 - alpha_f)(f_(n-1) - f_n), the force in its middle: of second order. Else trapezoidal.
  ///   - at_end: in statics that at its end, which viscous forces have throughout it (velocity dd / dt).
  enum class Rule { trapezoidal, central, at_end };
  WorkEvaluator(Energy::Of of, const QuantityContext& context, Rule rule = Rule::trapezoidal)
      : of_(of), rule_(rule), force_(rcp(new Vector(context.space().dofs()))), displacement_(rcp(new Vector(context.space().dofs()))) {}

  double evaluate(const QuantityContext& context) override {
    if ((of_ == Energy::Of::friction || of_ == Energy::Of::contact_work) && context.contact == nullptr) return 0.0;
    const RCP<Vector> now = working_force(of_, context);
    if (!has_begun_ && context.motion != nullptr) {
      displacement_->assign(context.motion->displacement_before);
      if (const Vector* start = force_at_start(*context.motion)) force_->assign(*start);
    }
    has_begun_ = true;
    Vector change(*context.displacement, Teuchos::Copy);
    change.update(-1.0, *displacement_, 1.0);
    force_->update(1.0 - share_before(context), *now, share_before(context));
    work_ += force_->dot(change);
    has_force_ = true;
    force_ = now;
    displacement_->assign(*context.displacement);
    return work_;
  }

  void serialize(StateArchive& archive, const std::string& name) override {
    int has_begun = has_begun_ ? 1 : 0;
    mortise::serialize(archive, name + ".has_begun", has_begun);
    has_begun_ = has_begun != 0;
    has_force_ = has_begun_;
    mortise::serialize(archive, name + ".work", work_);
    mortise::serialize(archive, name + ".force", "dofs", *force_);
    mortise::serialize(archive, name + ".displacement", "dofs", *displacement_);
  }

 private:
  /// Of the force before in the work of a step.
  double share_before(const QuantityContext& context) const {
    if (context.motion == nullptr) return rule_ == Rule::at_end ? 0.0 : 0.5;
    if (!context.motion->is_over_step) return 0.5;
    return rule_ == Rule::central && has_force_ ? 0.5 - context.motion->alpha_f : 0.0;
  }

  /// Null: 0, or not known. Contact and supports have none.
  const Vector* force_at_start(const MotionOfStep& motion) const {
    if (of_ == Energy::Of::external_work) return motion.external_force_before;
    return of_ == Energy::Of::damping || of_ == Energy::Of::dashpots ? motion.damping_force_before : nullptr;
  }

  Energy::Of of_;
  Rule rule_;
  double work_ = 0.0;
  bool has_begun_ = false;
  bool has_force_ = false;            ///< `force_` is that of a step before
  RCP<Vector> force_, displacement_;  ///< at the last step
};

std::unique_ptr<QuantityEvaluator> energy(Energy::Of of, const QuantityContext& context) {
  Energy energy;
  energy.of = of;
  return energy.make_evaluator(context);
}

double energy_of_springs(const QuantityContext& context, const Vector& local_displacement) {
  return context.connectors.springs == nullptr ? 0.0 : context.connectors.springs->energy(local_displacement);
}

/// Energy of springs in statics since the start, where nothing has moved.
class SpringEnergyChange final : public QuantityEvaluator {
 public:
  double evaluate(const QuantityContext& context) override {
    if (context.connectors.springs == nullptr) return 0.0;
    return energy_of_springs(context, *context.local_displacement) - energy_of_springs(context, Vector(context.space().local_dofs()));
  }
};

/// Stored energy, that of springs included, and kinetic energy since the start.
class MechanicalEnergyChange final : public QuantityEvaluator {
 public:
  double evaluate(const QuantityContext& context) override {
    if (context.motion == nullptr) return 0.0;
    if (!has_begun_) {
      Vector local(context.space().local_dofs());
      local.doImport(context.motion->displacement_before, *context.space().ghost_import(), Tpetra::INSERT);
      at_start_ = mechanical_energy(context, local, context.motion->velocity_before);
      has_begun_ = true;
    }
    return mechanical_energy(context, *context.local_displacement, context.motion->velocity) - at_start_;
  }

  double at_start() const { return at_start_; }

  void serialize(StateArchive& archive, const std::string& name) override {
    int has_begun = has_begun_ ? 1 : 0;
    mortise::serialize(archive, name + ".has_begun", has_begun);
    has_begun_ = has_begun != 0;
    mortise::serialize(archive, name + ".at_start", at_start_);
  }

 private:
  static double mechanical_energy(const QuantityContext& context, const Vector& local_displacement, const Vector& velocity) {
    const std::vector<double> stored = context.bodies.stored_energies(local_displacement);
    return energy_of_springs(context, local_displacement) +
           std::accumulate(stored.begin(), stored.end(), 0.5 * sum_over_body(context, std::nullopt, *context.mass->times(velocity), velocity));
  }

  bool has_begun_ = false;
  double at_start_ = 0.0;
};

/// A sum of energies with signs.
class EnergySum final : public QuantityEvaluator {
 public:
  void add(double sign, std::unique_ptr<QuantityEvaluator> energy) { terms_.push_back({sign, std::move(energy)}); }
  double evaluate(const QuantityContext& context) override {
    double sum = 0.0;
    for (const Term& term : terms_) sum += term.sign * term.energy->evaluate(context);
    return sum;
  }
  void serialize(StateArchive& archive, const std::string& name) override {
    for (std::size_t n = 0; n < terms_.size(); ++n) terms_[n].energy->serialize(archive, name + ".term." + std::to_string(n));
  }

 private:
  struct Term {
    double sign;
    std::unique_ptr<QuantityEvaluator> energy;
  };
  std::vector<Term> terms_;
};

std::unique_ptr<QuantityEvaluator> numerical_dissipation(const QuantityContext& context) {
  auto sum = std::make_unique<EnergySum>();
  sum->add(1.0, energy(Energy::Of::external_work, context));
  sum->add(1.0, energy(Energy::Of::contact_work, context));
  sum->add(-1.0, std::make_unique<MechanicalEnergyChange>());
  sum->add(-1.0, energy(Energy::Of::plastic_work, context));
  sum->add(-1.0, energy(Energy::Of::damping, context));
  return sum;
}

std::unique_ptr<QuantityEvaluator> Energy::make_evaluator(const QuantityContext& context) const {
  const std::optional<LocalOrdinal> of_body = find_optional_body(context, body);
  if (of == Of::kinetic || of == Of::damping || of == Of::numerical_dissipation) require_inertia(context);
  if (of == Of::numerical_dissipation) return numerical_dissipation(context);
  if (of == Of::kinetic)
    return evaluator_of([of_body](const QuantityContext& at) {
      if (at.motion == nullptr) return std::numeric_limits<double>::quiet_NaN();
      return 0.5 * sum_over_body(at, of_body, *at.mass->times(at.motion->velocity), at.motion->velocity);
    });
  if (of == Of::springs) {
    if (context.connectors.springs == nullptr) throw InputError(Place{}, "there are no springs; please give the list \"springs\"");
    return evaluator_of([](const QuantityContext& at) { return energy_of_springs(at, *at.local_displacement); });
  }
  if (of == Of::dashpots && context.connectors.dashpots == nullptr)
    throw InputError(Place{}, "there are no dashpots; please give the list \"dashpots\"");
  if (of == Of::stabilisation && !context.connectors.are_stabilised)
    throw InputError(Place{}, "there is no stabilisation; please give the list \"stabilisation\" a \"type\"");
  if (of != Of::stored && of != Of::plastic_work) {
    const bool is_viscous = context.mass == nullptr && (of == Of::dashpots || of == Of::stabilisation);
    const bool varies = of == Of::external_work || of == Of::damping || of == Of::dashpots;
    return std::make_unique<WorkEvaluator>(of, context,
                                           is_viscous ? WorkEvaluator::Rule::at_end
                                           : varies   ? WorkEvaluator::Rule::central
                                                      : WorkEvaluator::Rule::trapezoidal);
  }
  return evaluator_of([of = of, of_body](const QuantityContext& at) {
    const auto energies = of == Of::stored ? at.bodies.stored_energies(*at.local_displacement) : at.bodies.plastic_works(*at.local_displacement);
    return of_body ? energies[*of_body] : std::accumulate(energies.begin(), energies.end(), 0.0);
  });
}

/// Gap in the balance of works, over the largest of them:
///   - internal_work: external work - internal work - friction - what dashpots and stabilisation take. It is what contact pressures have done, which
///   is nothing where surfaces touch all
///     over.
///   - stored_and_plastic: external work - stored (in bodies and springs) - plastic work - friction - what dashpots and stabilisation take. It counts
///   besides what F-bar, without a potential, and the steps of the
///     flow rule make of internal work.
///   - mechanical: with inertia, external work - change of stored and kinetic energy - plastic work - friction - damping, over the largest of these
///     and of the energy at the start: what impacts and time integration take. Below 0 energy was gained.
/// NaN while nothing has been done.
struct EnergyError : Quantity {
  enum class Against { internal_work, stored_and_plastic, mechanical };
  Against against = Against::internal_work;

  void describe(Parameters& parameters) override {
    parameters.add(
        "against", against,
        {{"internal work", Against::internal_work}, {"stored and plastic", Against::stored_and_plastic}, {"mechanical", Against::mechanical}},
        "what external work less friction is compared with: work of the internal forces, stored energy and plastic work, or with inertia "
        "stored and kinetic energy, plastic work and damping: a result below 0 is a gain of energy; springs, dashpots and stabilisation count");
  }

  std::unique_ptr<QuantityEvaluator> make_evaluator(const QuantityContext& context) const override;
};

class EnergyErrorEvaluator final : public QuantityEvaluator {
 public:
  /// @param spent  what external work is spent on
  /// @param external  the work that is spent
  EnergyErrorEvaluator(std::unique_ptr<QuantityEvaluator> external, const std::vector<Energy::Of>& spent, const QuantityContext& context)
      : external_(std::move(external)) {
    for (const Energy::Of of : spent) spent_.push_back(energy(of, context));
  }
  /// Works by the same rule as the external work, with which they are in balance.
  void add_work(Energy::Of of, const QuantityContext& context) { spent_.push_back(std::make_unique<WorkEvaluator>(of, context)); }
  void add(std::unique_ptr<QuantityEvaluator> energy) { spent_.push_back(std::move(energy)); }
  void add_mechanical_energy() { mechanical_ = std::make_unique<MechanicalEnergyChange>(); }

  double evaluate(const QuantityContext& context) override {
    const double external = external_->evaluate(context);
    double difference = external, largest = std::abs(external);
    const auto spend = [&](double value) {
      difference -= value;
      largest = std::max(largest, std::abs(value));
    };
    for (const auto& energy : spent_) spend(energy->evaluate(context));
    if (mechanical_) {
      spend(mechanical_->evaluate(context));
      largest = std::max(largest, mechanical_->at_start());
    }
    return largest > 0.0 ? difference / largest : std::numeric_limits<double>::quiet_NaN();
  }

  void serialize(StateArchive& archive, const std::string& name) override {
    external_->serialize(archive, name + ".external");
    for (std::size_t n = 0; n < spent_.size(); ++n) spent_[n]->serialize(archive, name + ".spent." + std::to_string(n));
    if (mechanical_) mechanical_->serialize(archive, name + ".mechanical");
  }

 private:
  std::unique_ptr<QuantityEvaluator> external_;
  std::vector<std::unique_ptr<QuantityEvaluator>> spent_;
  std::unique_ptr<MechanicalEnergyChange> mechanical_;  ///< null: not spent on
};

std::unique_ptr<QuantityEvaluator> EnergyError::make_evaluator(const QuantityContext& context) const {
  using Of = Energy::Of;
  std::vector<Of> viscous;
  if (context.connectors.dashpots != nullptr && context.mass == nullptr) viscous.push_back(Of::dashpots);
  if (context.connectors.are_stabilised) viscous.push_back(Of::stabilisation);
  const auto with_viscous = [&](const std::vector<Of>& spent) {
    auto result = std::make_unique<EnergyErrorEvaluator>(std::make_unique<WorkEvaluator>(Of::external_work, context), spent, context);
    for (const Of of : viscous) result->add_work(of, context);
    return result;
  };
  if (against == Against::internal_work) return with_viscous({Of::friction, Of::internal_work});
  if (against == Against::stored_and_plastic) {
    auto result = with_viscous({Of::friction, Of::stored, Of::plastic_work});
    if (context.connectors.springs != nullptr) result->add(std::make_unique<SpringEnergyChange>());
    return result;
  }
  require_inertia(context);
  auto result = std::make_unique<EnergyErrorEvaluator>(energy(Of::external_work, context),
                                                       std::vector<Of>{Of::friction, Of::plastic_work, Of::damping}, context);
  result->add_mechanical_energy();
  return result;
}

}  // namespace

void add_energy(Registry<Quantity>& kinds) {
  kinds.add<Energy>("energy", "stored energy, plastic work, friction, or the work of external or internal forces");
}

void add_energy_error(Registry<Quantity>& kinds) {
  kinds.add<EnergyError>("energy error", "relative difference of external work and the sum of internal work and friction");
}

}  // namespace mortise
