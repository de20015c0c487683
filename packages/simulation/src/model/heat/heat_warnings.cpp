#include "model/heat/heat_warnings.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "mortise/core/over_ranks.hpp"
#include "mortise/mesh/sets.hpp"

namespace mortise {
namespace {

/// Whether all nodes of both surfaces have a temperature, and whether any has one. Collective.
std::pair<bool, bool> all_and_any(const Mesh& mesh, const FieldRows& rows, const SurfaceTieOptions& tie) {
  std::vector<int> mine{0, 0};  // without, with
  for (const auto* set : {&tie.slave, &tie.master})
    for (const LocalOrdinal node : require_node_set(mesh, *set))
      if (node < mesh.owned_count()) mine[rows.lives(node) ? 1 : 0] = 1;
  const std::vector<int> any = most_over_ranks(*mesh.comm, mine);
  return {any[0] == 0, any[1] != 0};
}

void warn_of_pairs(const Scene& scene, const Model& model, std::vector<std::string>& warnings) {
  for (const auto& pair : scene.contact) {
    const ContactHeatOptions& heat = pair.value.heat;
    const bool rubs = pair.value.contact.friction.options->acts();
    if (heat.slave_share && !rubs)
      warnings.push_back(fmt::format("pair \"{}\" has a \"slave share\" of the heat of friction, but no friction", pair.name));
    if (rubs && heat.friction_heats && !scene.heat.is_transient() && heat.slave_share)
      warnings.push_back(
          fmt::format("friction of pair \"{}\" heats nothing: the analysis is \"steady\", in which no work is done over time", pair.name));
  }
  std::vector<std::string> insulated;
  for (std::size_t p = 0; p < scene.contact.size(); ++p)
    if (!scene.contact[p].value.heat.conducts()) insulated.push_back(scene.contact[p].name);
  if (!insulated.empty() && model.heat().bodies->mesh()->bodies.size() > 1)
    warnings.push_back(fmt::format("pairs that conduct no heat where they touch: {}; if that is not meant, please give them a \"conductance\"",
                                   fmt::join(insulated, ", ")));
}

}  // namespace

std::vector<std::string> heat_warnings(const Scene& scene, const Model& model) {
  std::vector<std::string> warnings;
  if (!scene.heat.acts()) {
    std::vector<std::string> idle;
    for (const auto& material : scene.materials)
      if (material.value.heat.conductivity.is_given() || material.value.law.options->thermal.given()) idle.push_back(material.name);
    if (!idle.empty())
      warnings.push_back(
          fmt::format("the scene has no temperature, so that what its materials say of heat has no effect: {}; please give the list "
                      "\"heat\" an \"analysis\", or remove their lists \"heat\" and \"thermomechanics\"",
                      fmt::join(idle, ", ")));
    return warnings;
  }
  const Mesh& mesh = *model.mesh();
  const FieldRows& rows = model.space().rows(model.heat().bodies->temperature());
  for (const auto& tie : scene.ties)
    if (const auto [all, any] = all_and_any(mesh, rows, tie.value); any && !all)
      warnings.push_back(fmt::format("tie \"{}\" conducts no heat, as nodes of it have no temperature", tie.name));
  warn_of_pairs(scene, model, warnings);
  const bool is_trapezoidal = scene.heat.integration == HeatOptions::Integration::trapezoidal;
  if (is_trapezoidal && (!scene.heat.is_transient() || scene.inertia.acts()))
    warnings.emplace_back(scene.inertia.acts() ? "\"integration\" of heat has no effect with inertia, whose scheme integrates heat too"
                                               : "\"integration\" of heat has no effect in a steady analysis");
  return warnings;
}

}  // namespace mortise
