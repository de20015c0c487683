#include "model/heat/heat_of_step.hpp"

#include <Tpetra_Vector.hpp>
#include <cmath>
#include <limits>

#include "model/heat/booked_heat.hpp"
#include "model/heat/contact_heat_book.hpp"
#include "mortise/core/over_ranks.hpp"

namespace mortise {
namespace {

std::vector<double> negative(std::vector<double> values) {
  for (double& value : values) value = -value;
  return values;
}

/// Rows of sources hold what leaves a body.
HeatOfStep::Flow into_bodies(const BookedHeat& source) { return {source.name(), negative(source.power()), negative(source.energy())}; }

}  // namespace

HeatOfStep heat_of_step(const Scene& scene, const Model& model) {
  const HeatOfModel& heat = model.heat();
  HeatOfStep result;
  if (!heat.bodies) return result;
  result.bodies = heat.bodies.get();
  result.prescribed = &heat.prescribed->rows();
  for (const auto& source : heat.sources) result.sources.push_back(into_bodies(*source));
  if (heat.stored) result.stored = HeatOfStep::Flow{heat.stored->name(), heat.stored->power(), heat.stored->energy()};
  if (heat.bulk) result.dissipated = HeatOfStep::Flow{"deformation", heat.bulk->heat_power(), heat.bulk->heat_energy()};
  for (std::size_t pair = 0; heat.contact && pair < scene.contact.size(); ++pair)
    if (const auto index = heat.contact->index(pair))
      result.pairs.push_back(
          {scene.contact[pair].name, heat.contact->sums()[*index].power, heat.contact->sums()[*index].energy, &heat.contact->nodes(*index)});
  return result;
}

// A power is a conductance times a temperature, and that is known to eps.
HeatOfStep heat_of_step(const Scene& scene, const Model& model, const SemiSmoothSystem& system, const SystemEvaluation& at, const Vector& reaction,
                        double time_step) {
  HeatOfStep result = heat_of_step(scene, model);
  const FieldRows& rows = model.space().rows(model.heat().bodies->temperature());
  const RCP<const Vector> unknowns = system.unknowns(at.x());
  double mine = 0.0;
  {
    const auto theta = unknowns->getLocalViewHost(Tpetra::Access::ReadOnly);
    for (LocalOrdinal node = 0; node < model.mesh()->owned_count(); ++node)
      if (rows.lives(node)) mine += std::abs(theta(rows(node, 0), 0));
  }
  result.round_off = std::numeric_limits<double>::epsilon() * system.stiffness_scale(1) * sum_over_ranks(*model.mesh()->comm, mine);
  result.reaction = &reaction;
  result.time_step = time_step;
  return result;
}

}  // namespace mortise
