// Heat that flows, is stored, and comes from friction and flow; the balance of all.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Tpetra_Map.hpp>
#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

#include "mortise/core/names.hpp"
#include "mortise/mesh/sets.hpp"
#include "mortise/simulation/quantities/heat_balance.hpp"
#include "mortise/simulation/quantities/quantity_support.hpp"

namespace mortise {
namespace {

/// Of a flow.
enum class HeatMeasure {
  power,  ///< mean over the last step
  energy  ///< since the start
};

void describe_measure_of_heat(Parameters& parameters, HeatMeasure& measure) {
  parameters.add("measure", measure, {{"power", HeatMeasure::power}, {"energy", HeatMeasure::energy}},
                 "power: mean over the last step; energy: sum since the start, in a transient analysis");
}

double total(const std::vector<double>& of_bodies, const std::optional<LocalOrdinal>& body) {
  return body ? of_bodies[static_cast<std::size_t>(*body)] : std::accumulate(of_bodies.begin(), of_bodies.end(), 0.0);
}

double of(const HeatOfStep::Flow& flow, HeatMeasure measure, const std::optional<LocalOrdinal>& body) {
  return total(measure == HeatMeasure::power ? flow.power : flow.energy, body);
}

/// Index of a pair of HeatOfStep::pairs. Throws InputError at the name's place.
std::size_t find_heated_pair(const QuantityContext& context, const Located<std::string>& name) {
  std::vector<std::string> names;
  for (const HeatOfStep::PairFlow& pair : context.heat.pairs) names.push_back(pair.pair);
  if (name.value.empty() && names.size() == 1) return 0;
  const auto found = std::find(names.begin(), names.end(), name.value);
  if (found == names.end()) {
    if (names.empty()) throw InputError(name.place, "no pair of the scene conducts heat, and none is heated by friction");
    throw InputError(name.place, unknown_name("pair across which heat flows", name.value, names));
  }
  return static_cast<std::size_t>(found - names.begin());
}

/// Power of supports of a set, summed up over the steps.
class SupportHeat final : public QuantityEvaluator {
 public:
  SupportHeat(Located<std::string> set, HeatMeasure measure) : set_(std::move(set)), measure_(measure) {}

  double evaluate(const QuantityContext& context) override {
    const Mesh& mesh = context.mesh();
    const FieldRows& rows = context.space().rows(context.heat.bodies->temperature());
    const auto reaction = context.heat.reaction->getLocalViewHost(Tpetra::Access::ReadOnly);
    double power = 0.0;
    for (const LocalOrdinal node : require_node_set(mesh, set_))
      if (node < mesh.owned_count() && rows.lives(node) &&
          std::binary_search(context.heat.prescribed->begin(), context.heat.prescribed->end(), rows(node, 0)))
        power += reaction(rows(node, 0), 0);
    power = sum_over_ranks(mesh, power);
    energy_ += context.heat.time_step * power;
    return measure_ == HeatMeasure::power ? power : energy_;
  }
  void serialize(StateArchive& archive, const std::string& name) override { mortise::serialize(archive, name + ".energy", energy_); }

 private:
  Located<std::string> set_;
  HeatMeasure measure_;
  double energy_ = 0.0;
};

/// Heat through the nodes of a set with a prescribed temperature, a load, or across a pair. [power] or [energy]
struct HeatFlowQuantity : Quantity {
  Located<std::string> set, load, pair;  ///< one of them is named
  HeatMeasure measure = HeatMeasure::power;

  void describe(Parameters& parameters) override {
    parameters.add("set", set, "nodes with a prescribed temperature: heat into the bodies through them");
    parameters.add("load", load, "a thermal load, or \"heat source\" for the sources of the materials: heat into the bodies");
    parameters.add("pair", pair, "a contact pair: heat that it conducts from slave to master");
    describe_measure_of_heat(parameters, measure);
    if ((set.value.empty() ? 0 : 1) + (load.value.empty() ? 0 : 1) + (pair.value.empty() ? 0 : 1) != 1)
      parameters.error("set", "heat flows through one of three: please name a \"set\", a \"load\" or a \"pair\"");
  }

  std::unique_ptr<QuantityEvaluator> make_evaluator(const QuantityContext& context) const override {
    require_temperature(context);
    if (!set.value.empty()) {
      const FieldRows& rows = context.space().rows(context.heat.bodies->temperature());
      double count = 0.0;
      for (const LocalOrdinal node : require_node_set(context.mesh(), set))
        if (node < context.mesh().owned_count() && rows.lives(node) &&
            std::binary_search(context.heat.prescribed->begin(), context.heat.prescribed->end(), rows(node, 0)))
          count += 1.0;
      if (sum_over_ranks(context.mesh(), count) == 0.0)
        throw InputError(set.place, fmt::format("no node of \"{}\" has a prescribed temperature, so that no heat enters there; please name a thermal "
                                                "\"load\", or a set of \"heat/temperatures\"",
                                                set.value));
      return std::make_unique<SupportHeat>(set, measure);
    }
    if (!load.value.empty()) {
      std::vector<std::string> names;
      for (const HeatOfStep::Flow& source : context.heat.sources) names.push_back(source.name);
      const auto found = std::find(names.begin(), names.end(), load.value);
      if (found == names.end()) throw InputError(load.place, unknown_name("thermal load", load.value, names));
      return evaluator_of([measure = measure, n = static_cast<std::size_t>(found - names.begin())](const QuantityContext& at) {
        return of(at.heat.sources[n], measure, std::nullopt);
      });
    }
    return evaluator_of([measure = measure, n = find_heated_pair(context, pair)](const QuantityContext& at) {
      const HeatOfStep::PairFlow& flow = at.heat.pairs[n];
      return (measure == HeatMeasure::power ? flow.power : flow.energy).conducted;
    });
  }
};

/// Heat that bodies store. [power] or [energy]
struct StoredHeatQuantity : Quantity {
  Located<std::string> body;  ///< empty: all
  HeatMeasure measure = HeatMeasure::energy;

  void describe(Parameters& parameters) override {
    parameters.add("body", body, "body that stores it; empty: all bodies");
    describe_measure_of_heat(parameters, measure);
  }
  std::unique_ptr<QuantityEvaluator> make_evaluator(const QuantityContext& context) const override {
    require_temperature(context);
    if (!context.heat.stored) throw InputError(body.place, "no body stores heat: the analysis is \"steady\", or no material has a \"specific heat\"");
    return evaluator_of(
        [measure = measure, body = find_optional_body(context, body)](const QuantityContext& at) { return of(*at.heat.stored, measure, body); });
  }
};

/// Heat of plastic flow and of elastic strain. [power] or [energy]
struct DissipatedHeatQuantity : Quantity {
  Located<std::string> body;  ///< empty: all
  HeatMeasure measure = HeatMeasure::energy;

  void describe(Parameters& parameters) override {
    parameters.add("body", body, "body that is heated; empty: all bodies");
    describe_measure_of_heat(parameters, measure);
  }
  std::unique_ptr<QuantityEvaluator> make_evaluator(const QuantityContext& context) const override {
    require_temperature(context);
    return evaluator_of([measure = measure, body = find_optional_body(context, body)](const QuantityContext& at) {
      return at.heat.dissipated ? of(*at.heat.dissipated, measure, body) : 0.0;
    });
  }
};

/// Heat of friction, and what of the heat of a pair flows into rigid bodies. [power] or [energy]
struct FrictionHeatQuantity : Quantity {
  enum class Part { all, to_rigid_bodies };
  Located<std::string> pair;  ///< empty: the only one
  Part part = Part::all;
  HeatMeasure measure = HeatMeasure::energy;

  void describe(Parameters& parameters) override {
    parameters.add("pair", pair, "the contact pair; empty: the only one across which heat flows");
    parameters.add("part", part, {{"all", Part::all}, {"to rigid bodies", Part::to_rigid_bodies}},
                   "all: the heat of friction; to rigid bodies: heat of friction and conduction that leaves the model through them");
    describe_measure_of_heat(parameters, measure);
  }
  std::unique_ptr<QuantityEvaluator> make_evaluator(const QuantityContext& context) const override {
    require_temperature(context);
    return evaluator_of([measure = measure, part = part, n = find_heated_pair(context, pair)](const QuantityContext& at) {
      const HeatOfStep::PairFlow& flow = at.heat.pairs[n];
      const HeatFlow& heat = measure == HeatMeasure::power ? flow.power : flow.energy;
      return part == Part::all ? heat.friction : heat.to_slave_without_rows + heat.to_master_without_rows;
    });
  }
};

class BalanceEvaluator final : public QuantityEvaluator {
 public:
  double evaluate(const QuantityContext& context) override { return balance_.imbalance(context.mesh(), context.heat); }
  void serialize(StateArchive& archive, const std::string& name) override { balance_.serialize(archive, name); }

 private:
  HeatBalance balance_;
};

/// Missing part of the balance of heat of the last step, over the largest power so far. [-]
struct HeatBalanceQuantity : Quantity {
  void describe(Parameters&) override {}
  std::unique_ptr<QuantityEvaluator> make_evaluator(const QuantityContext& context) const override {
    require_temperature(context);
    return std::make_unique<BalanceEvaluator>();
  }
};

}  // namespace

// Rows of all nodes sum up to 0 but for prescribed temperatures, where they are what supports give.
double HeatBalance::imbalance(const Mesh& mesh, const HeatOfStep& heat) {
  constexpr double far_above_round_off = 1e8;
  double sum = 0.0, largest = far_above_round_off * heat.round_off;
  const auto add = [&](double into) {
    sum += into;
    largest = std::max(largest, std::abs(into));
  };
  for (const HeatOfStep::Flow& source : heat.sources)
    for (const double power : source.power) add(power);
  if (heat.dissipated)
    for (const double power : heat.dissipated->power) add(power);
  if (heat.stored)
    for (const double power : heat.stored->power) add(-power);
  for (const HeatOfStep::PairFlow& pair : heat.pairs) {
    add(pair.power.friction);
    add(-pair.power.to_slave_without_rows);
    add(-pair.power.to_master_without_rows);
    largest = std::max(largest, std::abs(pair.power.conducted));
  }
  const auto reaction = heat.reaction->getLocalViewHost(Tpetra::Access::ReadOnly);
  double into = 0.0, both = 0.0;
  for (const LocalOrdinal row : *heat.prescribed) into += reaction(row, 0), both += std::abs(reaction(row, 0));
  add(sum_over_ranks(mesh, into));
  largest_ = std::max({largest_, largest, sum_over_ranks(mesh, both)});
  return largest_ > 0.0 ? std::abs(sum) / largest_ : 0.0;
}

void add_heat_flow(Registry<Quantity>& kinds) {
  kinds.add<HeatFlowQuantity>("heat flow", "heat through a set of nodes, a thermal load or a contact pair");
}
void add_stored_heat(Registry<Quantity>& kinds) { kinds.add<StoredHeatQuantity>("stored heat", "heat that bodies have taken up"); }
void add_friction_heat(Registry<Quantity>& kinds) { kinds.add<FrictionHeatQuantity>("friction heat", "heat of friction of a contact pair"); }
void add_dissipated_heat(Registry<Quantity>& kinds) {
  kinds.add<DissipatedHeatQuantity>("deformation heat", "heat of plastic flow and of elastic strain");
}
void add_heat_balance(Registry<Quantity>& kinds) {
  kinds.add<HeatBalanceQuantity>("heat balance", "what is missing in the balance of heat of the last step, over the largest power so far");
}

}  // namespace mortise
