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
#include "quantities/work.hpp"

namespace mortise {
namespace {

/// Energies and works since the start. Works are sums of 1/2 (f_old + f) . (d - d_old) over the steps, the trapezoidal rule. So
///   external work = internal work + friction - (work of contact pressures on both sides)
/// holds to the tolerance of momentum, whatever the step. [work]
struct Energy : Quantity {
  using Of = EnergyOf;
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
    return work(of, context, is_viscous ? WorkRule::at_end : varies ? WorkRule::central : WorkRule::trapezoidal);
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
  void add_work(Energy::Of of, const QuantityContext& context) { spent_.push_back(work(of, context)); }
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
  if (context.bodies.know_temperature())
    throw InputError(
        Place{},
        "the energy error does not know the work of thermal expansion; please take the \"heat balance\", or bodies without \"thermomechanics\"");
  using Of = Energy::Of;
  std::vector<Of> viscous;
  if (context.connectors.dashpots != nullptr && context.mass == nullptr) viscous.push_back(Of::dashpots);
  if (context.connectors.are_stabilised) viscous.push_back(Of::stabilisation);
  const auto with_viscous = [&](const std::vector<Of>& spent) {
    auto result = std::make_unique<EnergyErrorEvaluator>(work(Of::external_work, context), spent, context);
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
