// Energies and works.

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
    stored,         ///< int W dV0
    plastic_work,   ///< int int_0^alpha sigma_y dalpha dV0
    friction,       ///< of the shear tractions of all pairs with friction
    external_work,  ///< of loads and supports
    internal_work   ///< of the internal forces
  };
  Of of = Of::stored;
  Located<std::string> body;  ///< stored energy and plastic work only; empty: all

  void describe(Parameters& parameters) override {
    parameters.add("of", of,
                   {{"stored", Of::stored},
                    {"plastic work", Of::plastic_work},
                    {"friction", Of::friction},
                    {"external work", Of::external_work},
                    {"internal work", Of::internal_work}},
                   "energy stored in the bodies, spent on plastic flow, or dissipated by friction of all pairs (of first order in the step where "
                   "slip begins or turns round). Or the work since the start of loads and supports, or of the internal forces");
    parameters.add("body", body, "body whose stored energy or plastic work is meant; empty: all");
    if (of != Of::stored && of != Of::plastic_work && !body.value.empty())
      parameters.error("body", "only stored energy and plastic work are those of a body; please remove \"body\"");
  }

  std::unique_ptr<QuantityEvaluator> make_evaluator(const QuantityContext& context) const override;
};

// Forces that do a work, on all owned dofs. From outside act loads, and supports on prescribed dofs. Reference points act on their followers, and
// there their work is counted. A point that is carried round by an angle a with a moment M would do M a. Its followers do M sin a along the chords of
// their ways, as do all other nodes of the body. With r = f_int - f_ext + f_c the internal forces are r + f_ext - f_c, and what supports and points
// do is r. Friction takes what its forces on both sides do not give back: f_c of the shear tractions alone.
RCP<Vector> working_force(Energy::Of of, const QuantityContext& context) {
  const auto result = rcp(new Vector(context.bodies.dofs()));
  const auto add_contact_force = [&](const Vector& multipliers) { context.laws->evaluation().add_force(multipliers, *result); };
  if (of == Energy::Of::friction) {
    add_contact_force(*context.laws->evaluation().shear_tractions(context.laws->multipliers()));
    return result;
  }
  if (of == Energy::Of::internal_work) {
    if (context.contact != nullptr) add_contact_force(context.laws->multipliers());
    result->update(1.0, *context.reaction, 1.0, *context.external_force, -1.0);
  } else {
    result->assign(*context.external_force);
    const auto reaction = context.reaction->getLocalViewHost(Tpetra::Access::ReadOnly);
    const auto values = result->getLocalViewHost(Tpetra::Access::ReadWrite);
    for (const auto* dofs : {context.prescribed, context.following})
      for (std::size_t n = 0; dofs != nullptr && n < dofs->size(); ++n) values((*dofs)[n], 0) += reaction((*dofs)[n], 0);
  }
  const Mesh& mesh = context.mesh();
  const auto values = result->getLocalViewHost(Tpetra::Access::ReadWrite);
  for (const ReferencePoint& point : mesh.reference_points)
    for (const LocalOrdinal node : {point.node, point.rotation_node})
      for (int i = 0; i < mesh.dimension && node >= 0 && node < mesh.owned_count(); ++i) values(mesh.dimension * node + i, 0) = 0.0;
  return result;
}

/// A work, summed up over the steps.
class WorkEvaluator final : public QuantityEvaluator {
 public:
  WorkEvaluator(Energy::Of of, const QuantityContext& context)
      : of_(of), force_(rcp(new Vector(context.bodies.dofs()))), displacement_(rcp(new Vector(context.bodies.dofs()))) {}

  double evaluate(const QuantityContext& context) override {
    if (of_ == Energy::Of::friction && context.contact == nullptr) return 0.0;
    const RCP<Vector> now = working_force(of_, context);
    Vector change(*context.displacement, Teuchos::Copy);
    change.update(-1.0, *displacement_, 1.0);
    force_->update(0.5, *now, 0.5);
    work_ += force_->dot(change);
    force_ = now;
    displacement_->assign(*context.displacement);
    return work_;
  }

  void serialize(StateArchive& archive, const std::string& name) override {
    mortise::serialize(archive, name + ".work", work_);
    mortise::serialize(archive, name + ".force", "dofs", *force_);
    mortise::serialize(archive, name + ".displacement", "dofs", *displacement_);
  }

 private:
  Energy::Of of_;
  double work_ = 0.0;
  RCP<Vector> force_, displacement_;  ///< at the last step
};

std::unique_ptr<QuantityEvaluator> Energy::make_evaluator(const QuantityContext& context) const {
  const std::optional<LocalOrdinal> of_body = find_optional_body(context, body);
  if (of != Of::stored && of != Of::plastic_work) return std::make_unique<WorkEvaluator>(of, context);
  return evaluator_of([of = of, of_body](const QuantityContext& at) {
    const auto energies = of == Of::stored ? at.bodies.stored_energies(*at.local_displacement) : at.bodies.plastic_works(*at.local_displacement);
    return of_body ? energies[*of_body] : std::accumulate(energies.begin(), energies.end(), 0.0);
  });
}

/// Gap in the balance of works, over the largest of them:
///   - internal_work: external work - internal work - friction. It is what contact pressures have done, which is nothing where surfaces touch all
///     over.
///   - stored_and_plastic: external work - stored - plastic work - friction. It counts besides what F-bar, without a potential, and the steps of the
///     flow rule make of internal work.
/// NaN while nothing has been done.
struct EnergyError : Quantity {
  enum class Against { internal_work, stored_and_plastic };
  Against against = Against::internal_work;

  void describe(Parameters& parameters) override {
    parameters.add("against", against, {{"internal work", Against::internal_work}, {"stored and plastic", Against::stored_and_plastic}},
                   "work that is compared with external work less friction: work of the internal forces, or stored energy and plastic work");
  }

  std::unique_ptr<QuantityEvaluator> make_evaluator(const QuantityContext& context) const override;
};

class EnergyErrorEvaluator final : public QuantityEvaluator {
 public:
  /// @param spent  what external work is spent on
  EnergyErrorEvaluator(const std::vector<Energy::Of>& spent, const QuantityContext& context)
      : external_(evaluator(Energy::Of::external_work, context)) {
    for (const Energy::Of of : spent) spent_.push_back(evaluator(of, context));
  }

  double evaluate(const QuantityContext& context) override {
    const double external = external_->evaluate(context);
    double difference = external, largest = std::abs(external);
    for (const auto& energy : spent_) {
      const double value = energy->evaluate(context);
      difference -= value;
      largest = std::max(largest, std::abs(value));
    }
    return largest > 0.0 ? difference / largest : std::numeric_limits<double>::quiet_NaN();
  }

  void serialize(StateArchive& archive, const std::string& name) override {
    external_->serialize(archive, name + ".external");
    for (std::size_t n = 0; n < spent_.size(); ++n) spent_[n]->serialize(archive, name + ".spent." + std::to_string(n));
  }

 private:
  static std::unique_ptr<QuantityEvaluator> evaluator(Energy::Of of, const QuantityContext& context) {
    Energy energy;
    energy.of = of;
    return energy.make_evaluator(context);
  }

  std::unique_ptr<QuantityEvaluator> external_;
  std::vector<std::unique_ptr<QuantityEvaluator>> spent_;
};

std::unique_ptr<QuantityEvaluator> EnergyError::make_evaluator(const QuantityContext& context) const {
  using Of = Energy::Of;
  const std::vector<Of> spent = against == Against::internal_work ? std::vector<Of>{Of::friction, Of::internal_work}
                                                                  : std::vector<Of>{Of::friction, Of::stored, Of::plastic_work};
  return std::make_unique<EnergyErrorEvaluator>(spent, context);
}

}  // namespace

void add_energy(Registry<Quantity>& kinds) {
  kinds.add<Energy>("energy", "stored energy, plastic work, friction, or the work of external or internal forces");
}

void add_energy_error(Registry<Quantity>& kinds) {
  kinds.add<EnergyError>("energy error", "relative difference of external work and the sum of internal work and friction");
}

}  // namespace mortise
