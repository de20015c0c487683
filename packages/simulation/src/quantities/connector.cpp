// Force, elongation, energy and power of a spring or a dashpot.

#include <fmt/format.h>

#include <algorithm>

#include "mortise/core/names.hpp"
#include "mortise/simulation/quantities/quantity_support.hpp"

namespace mortise {
namespace {

struct Connector : Quantity {
  enum class Of { force, elongation, energy, power };
  enum class Part { x, y, z, line, rotation };
  Located<std::string> spring, dashpot;
  Of of = Of::force;
  Part part = Part::line;

  void describe(Parameters& parameters) override {
    parameters.add("spring", spring, "spring that is meant");
    parameters.add("dashpot", dashpot, "dashpot that is meant, in the place of a spring");
    parameters.add(
        "of", of, {{"force", Of::force}, {"elongation", Of::elongation}, {"energy", Of::energy}, {"power", Of::power}},
        "force: along the line above 0 in tension, in a component the force on its \"set\", of a rotation the moment; elongation: over the "
        "length without force (of a dashpot over that at the start), in a component the displacement of \"to\" relative to \"set\", against "
        "the ground that of \"set\", of a rotation the angle in radians; energy: stored in a spring; power: what a dashpot takes");
    parameters.add("component", part, {{"line", Part::line}, {"x", Part::x}, {"y", Part::y}, {"z", Part::z}, {"rotation", Part::rotation}},
                   "of the force or elongation: along the line between its ends, in a component, or of the rotation, in 3D its size");
    if (spring.value.empty() == dashpot.value.empty())
      parameters.error("spring",
                       fmt::format("{} given; please give one of \"spring\" and \"dashpot\"", spring.value.empty() ? "none is" : "both are"));
    if (of == Of::energy && spring.value.empty()) parameters.error("of", "a dashpot stores no energy; please take \"power\"");
    if (of == Of::power && dashpot.value.empty()) parameters.error("of", "a spring takes no power; please take \"energy\"");
  }

  std::unique_ptr<QuantityEvaluator> make_evaluator(const QuantityContext& context) const override;
};

double value_of(Connector::Of of, Connector::Part part, const ConnectorState& state) {
  if (of == Connector::Of::energy) return state.energy;
  if (of == Connector::Of::power) return state.power;
  const bool is_force = of == Connector::Of::force;
  if (part == Connector::Part::line) return is_force ? state.along : state.elongation_along;
  if (part == Connector::Part::rotation) return is_force ? state.moment : state.rotation;
  return (is_force ? state.force : state.elongation)[static_cast<std::size_t>(part)];
}

std::unique_ptr<QuantityEvaluator> Connector::make_evaluator(const QuantityContext& context) const {
  const bool is_spring = dashpot.value.empty();
  const char* kind = is_spring ? "spring" : "dashpot";
  const Located<std::string>& name = is_spring ? spring : dashpot;
  const Connectors* all = is_spring ? context.connectors.springs : context.connectors.dashpots;
  const std::vector<std::string> known = all == nullptr ? std::vector<std::string>{} : all->names();
  const auto found = std::find(known.begin(), known.end(), name.value);
  if (found == known.end()) throw InputError(name.place, unknown_name(kind, name.value, known));
  const auto n = static_cast<std::size_t>(found - known.begin());
  if (part == Part::z && context.mesh().dimension == 2) require_component(context, Component::z);
  if (of == Of::force || of == Of::elongation) {
    bool is_axial = false, turns = false;  // links of lines and rotations are on all ranks
    for (const ConnectorLink& link : all->links()) {
      if (link.connector != n) continue;
      turns = turns || link.is_rotation;
      is_axial = is_axial || link.law.is_axial;
    }
    const bool is_there = part == Part::line ? is_axial : part == Part::rotation ? turns : !is_axial;
    if (!is_there)
      throw InputError(name.place, fmt::format("the {} \"{}\" has no such part; please give the \"component\" in which it acts: {}", kind, name.value,
                                               is_axial ? "line" : "x, y, z or rotation"));
  }
  return evaluator_of([is_spring, n, of = of, part = part](const QuantityContext& at) {
    const Connectors& all = is_spring ? *at.connectors.springs : *at.connectors.dashpots;
    return value_of(of, part, all.state(n, *at.local_displacement, at.connectors.dashpot_velocity));
  });
}

}  // namespace

void add_connector(Registry<Quantity>& kinds) { kinds.add<Connector>("connector", "force, elongation, energy or power of a spring or a dashpot"); }

}  // namespace mortise
