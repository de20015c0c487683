#include "model/heat/heat_of_step.hpp"

#include "model/heat/booked_heat.hpp"
#include "model/heat/contact_heat_book.hpp"

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

HeatOfStep heat_of_step(const Scene& scene, const Model& model, const Vector& reaction, double time_step) {
  HeatOfStep result = heat_of_step(scene, model);
  result.reaction = &reaction;
  result.time_step = time_step;
  return result;
}

}  // namespace mortise
