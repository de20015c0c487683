#include "mortise/simulation/run/output/quantity_evaluators.hpp"

#include "model/heat/heat_of_step.hpp"

namespace mortise {

QuantityContext quantity_context(const Scene& scene, const Model& model) {
  QuantityContext context{*model.bodies()};
  context.contact = model.contact().get();
  for (const auto& pair : scene.contact) context.pairs.push_back({pair.name, pair.value.slave.value, pair.value.master.value});
  context.prescribed = &model.supports().dofs;
  if (model.parts().rigid) context.following = &model.parts().rigid->dofs();
  context.symbols = &scene.symbols;
  context.mass = model.inertia().mass.get();
  context.heat = heat_of_step(scene, model);
  context.connectors.springs = model.connectors().springs.get();
  context.connectors.dashpots = model.connectors().dashpots.get();
  context.connectors.are_stabilised = scene.stabilisation.acts();
  return context;
}

QuantityEvaluators make_evaluators(const Scene& scene, const Model& model) {
  std::vector<Diagnostic> diagnostics;
  QuantityEvaluators evaluators;
  QuantityContext at = quantity_context(scene, model);
  for (const auto& quantity : scene.quantities) {
    try {
      evaluators.push_back(quantity.value.quantity.options->make_evaluator(at));
    } catch (const InputError& error) {
      for (Diagnostic one : error.diagnostics()) {
        if (one.place.path.empty()) one.place = quantity.place;
        diagnostics.push_back(std::move(one));
      }
    }
    at.earlier.push_back(quantity.name);
  }
  throw_if_any(*model.mesh()->comm, diagnostics);
  return evaluators;
}

}  // namespace mortise
