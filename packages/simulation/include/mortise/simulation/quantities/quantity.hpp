#pragma once
// Numbers that a scene wants of its run.

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "mortise/contact/contact_system.hpp"
#include "mortise/core/parameters.hpp"
#include "mortise/core/state_archive.hpp"
#include "mortise/input/expression.hpp"
#include "mortise/solid/bodies.hpp"
#include "mortise/solid/connectors.hpp"
#include "mortise/solid/nodal_mass.hpp"
#include "mortise/thermal/thermal_bodies.hpp"
#include "mortise/thermal_contact/contact_heat.hpp"

namespace mortise {

/// Side sets of a contact pair.
struct PairSurfaces {
  std::string name;
  std::string slave, master;
};

/// Motion at the end of a step, on owned dofs.
struct MotionOfStep {
  const Vector& velocity;
  const Vector& acceleration;         ///< that balances forces
  const Vector& rate_force;           ///< inertia and damping as they are in balance over the step
  const Vector& damping_force;        ///< the latter alone
  const Vector& displacement_before;  ///< at the start of the step
  const Vector& velocity_before;      ///< likewise
  double dt;                          ///< length of the step
  bool is_over_step;                  ///< forces are constant over the step: works are f . (d - d_old), else those of the trapezoidal rule
  double alpha_f;                     ///< over the step: forces are those at its end less this share of it
  const Vector* external_force_before = nullptr;  ///< f_ext at the start of the first step that quantities see; null in others
  const Vector* damping_force_before = nullptr;   ///< likewise, dashpots included
};

/// Springs, dashpots and stabilisation of a scene; null where it has none.
struct ConnectorsOfStep {
  const Connectors* springs = nullptr;
  const Vector* spring_force = nullptr;  ///< on owned dofs, as it is in balance; null while evaluators are made, and without springs
  const Connectors* dashpots = nullptr;
  const Vector* dashpot_velocity = nullptr;     ///< on owned dofs and ghosts, as it is in balance; null while evaluators are made
  const Vector* stabilisation_force = nullptr;  ///< on owned dofs, as the residual has it; null while evaluators are made
  bool are_stabilised = false;                  ///< the scene has a stabilisation
};

/// Heat of a step. Powers are means over the step, energies sums since the start.
struct HeatOfStep {
  /// What flows into bodies.
  struct Flow {
    std::string name;
    std::vector<double> power, energy;  ///< [mesh bodies]
  };
  /// What flows across a pair.
  struct PairFlow {
    std::string pair;
    HeatFlow power, energy;
    const std::vector<NodeHeat>* nodes = nullptr;  ///< owned slave nodes where anything flows
  };
  const ThermalBodies* bodies = nullptr;  ///< null: the scene has no temperature
  std::vector<Flow> sources{};            ///< of volumes and of loads
  std::optional<Flow> stored{};           ///< what bodies store; none: a steady analysis
  std::optional<Flow> dissipated{};       ///< heat of plastic flow and of elastic strain; none: there is none
  std::vector<PairFlow> pairs{};          ///< of pairs that conduct or that friction heats
  const Vector* reaction = nullptr;       ///< on owned dofs: at prescribed temperatures the power into the bodies; null while evaluators are made
  const std::vector<LocalOrdinal>* prescribed = nullptr;  ///< rows of prescribed temperatures
  double time_step = 0.0;                 ///< length of the step
  double round_off = 0.0;                 ///< what round-off of temperatures may leave of a sum of powers, over all ranks
};

/// What a quantity may look at. The vectors are null while evaluators are made.
struct QuantityContext {
  const Bodies& bodies;
  const ContactSystem* contact = nullptr;  ///< null: the scene has no contact
  std::vector<PairSurfaces> pairs{};       ///< in the order of `contact`
  double time = 0.0;
  const Vector* displacement = nullptr;        ///< owned dofs
  const Vector* local_displacement = nullptr;  ///< owned dofs, then ghosts
  const ContactLaws* laws = nullptr;           ///< of contact at `displacement`; null without contact
  /// Force of edges that cross, on the slave side of a pair, at `local_displacement`. Collective; empty: no edges may cross.
  std::function<std::array<double, 3>(std::size_t pair)> edge_force{};
  /// f_int - f_ext + f_c on owned dofs: on prescribed ones the force of the support on the body, on followers that of their reference point
  const Vector* reaction = nullptr;
  const Vector* external_force = nullptr;  ///< f_ext on owned dofs, as it is in balance
  const NodalMass* mass = nullptr;         ///< null: the scene has no inertia
  HeatOfStep heat{};
  ConnectorsOfStep connectors{};
  const MotionOfStep* motion = nullptr;                   ///< null at the first state, and without inertia
  double force_round_off = 0.0;                           ///< what round-off of positions and stresses may leave of a sum of |forces|, over all ranks
  const std::vector<LocalOrdinal>* prescribed = nullptr;  ///< prescribed owned dofs
  const std::vector<LocalOrdinal>* following = nullptr;   ///< owned dofs that follow reference points; null: none does
  const Symbols* symbols = nullptr;                       ///< variables and tables of the scene
  std::vector<std::string> earlier{};                     ///< while evaluators are made: quantities that the scene names before this one
  std::vector<double> earlier_values{};                   ///< afterwards: theirs at this time

  const Mesh& mesh() const { return *bodies.mesh(); }
  const FieldSpace& space() const { return bodies.space(); }
};

/// The values of one quantity in one run. Its memory from step to step is its own.
class QuantityEvaluator {
 public:
  virtual ~QuantityEvaluator() = default;

  /// The value, the same on every rank. Collective, after each accepted step. NaN: it has no value at this time (a ratio to nothing).
  virtual double evaluate(const QuantityContext& context) = 0;

  /// Stores or restores what it remembers of the steps. Collective.
  /// @param name  of the quantity
  virtual void serialize(StateArchive&, const std::string& /*name*/) {}
};

/// One number, by its name in the scene: its options. Kinds are found in quantity_registry().
struct Quantity : Described {
  /// Resolves names of sets, bodies and pairs, for one run. Collective, before anything is solved. Throws InputError on all ranks.
  virtual std::unique_ptr<QuantityEvaluator> make_evaluator(const QuantityContext& context) const = 0;
};

/// All kinds by name.
const Registry<Quantity>& quantity_registry();

}  // namespace mortise
