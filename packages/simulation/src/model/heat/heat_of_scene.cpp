#include "model/heat/heat_of_scene.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Tpetra_Map.hpp>
#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <cmath>

#include "model/stages/collector.hpp"
#include "mortise/core/guarded_value.hpp"
#include "mortise/core/names.hpp"
#include "mortise/core/over_ranks.hpp"
#include "mortise/material/material_options.hpp"
#include "mortise/mesh/sets.hpp"
#include "mortise/simulation/scene/scene_bodies.hpp"
#include "mortise/thermal/heat_contributions.hpp"
#include "surfaces/body_surfaces.hpp"

namespace mortise {
namespace {

/// What a block is made of, for heat.
ThermalBody thermal_body(const Scene& scene, const Mesh& mesh, const Block& block) {
  ThermalBody body;
  if (mesh.body_of(block).is_surface) return body;
  const std::string name = material_name(scene.bodies[static_cast<std::size_t>(block.body)].value, block.part);
  for (const auto& material : scene.materials) {
    if (material.name != name || !material.value.heat.conductivity.is_given()) continue;
    body.place = material.place;
    auto properties = std::make_shared<ThermalProperties>(material.value.heat);
    if (!scene.heat.is_transient()) properties->specific_heat = {};
    body.properties = properties;
    body.density = material.value.law.options->density;
  }
  return body;
}

}  // namespace

FlowsAtStart flows_at_start(const Scene& scene) {
  if (scene.inertia.acts()) {
    const TimeScheme scheme = scene.inertia.time_scheme();
    return {scheme.blends_forces() ? scheme.alpha_f : 0.0, true};
  }
  const bool is_trapezoidal = scene.heat.is_transient() && scene.heat.integration == HeatOptions::Integration::trapezoidal;
  return is_trapezoidal ? FlowsAtStart{0.5, false} : FlowsAtStart{};
}

std::shared_ptr<const FieldSpace> space_of_scene(const RCP<const Mesh>& mesh, const Scene& scene) {
  if (!scene.heat.acts()) return displacement_space(mesh);
  std::vector<char> lives(static_cast<std::size_t>(mesh->owned_count()), 0);
  bool any = false;
  for (const Block& block : mesh->blocks) {
    if (!thermal_body(scene, *mesh, block).properties) continue;
    any = true;
    for (LocalOrdinal element = 0; element < block.size(); ++element)
      for (int a = 0; a < block.nodes_per_element; ++a)
        if (const LocalOrdinal node = block.nodes(element)[a]; node < mesh->owned_count()) lives[static_cast<std::size_t>(node)] = 1;
  }
  if (!any)
    throw InputError(scene.heat.place,
                     "the scene has an analysis of heat, but no body a temperature; please give a material a list \"heat\" with a \"conductivity\"");
  return std::make_shared<FieldSpace>(mesh, std::vector<FieldDeclaration>{{"displacement", mesh->dimension}, {"temperature", 1, std::move(lives)}});
}

namespace {

/// Laws that need a temperature which their bodies have not.
void refuse_without_temperature(const Scene& scene) {
  std::vector<Diagnostic> diagnostics;
  for (const auto& material : scene.materials)
    if (material.value.law.options->thermal.given() && !material.value.heat.conductivity.is_given())
      diagnostics.push_back(
          {material.place, fmt::format("material \"{}\" has a list \"thermomechanics\", but no temperature; please give it a list \"heat\" "
                                       "with a \"conductivity\"",
                                       material.name)});
  if (!diagnostics.empty()) throw InputError(diagnostics);
}

}  // namespace

/// Constant temperatures that cannot be absolute ones, which radiation needs. Those that vary are judged where they act.
void refuse_below_zero(const Scene& scene) {
  const auto& loads = scene.heat.loads;
  const bool is_absolute = std::any_of(
      loads.begin(), loads.end(), [](const auto& load) { return load.value.load.options && load.value.load.options->needs_absolute_temperatures(); });
  if (!is_absolute) return;
  const auto refuse = [](const ScalarFunction& function, const std::string& what, bool may_be_zero) {
    if (!function.is_constant()) return;
    const double value = function.at({0.0, 0.0, 0.0, 0.0});
    if (value > 0.0 || (value == 0.0 && may_be_zero)) return;
    throw InputError(function.place(), fmt::format("{} is {:g} in a scene with a load that needs absolute temperatures; allowed: {}. Please give all "
                                                   "temperatures in kelvin",
                                                   what, value, may_be_zero ? ">= 0" : "> 0"));
  };
  for (const auto& load : loads)
    if (const ScalarFunction* surroundings = load.value.load.options ? load.value.load.options->surroundings_temperature() : nullptr)
      refuse(*surroundings, fmt::format("the temperature of surroundings of \"{}\"", load.name), true);
  for (const auto& prescribed : scene.heat.temperatures)
    refuse(prescribed.value.temperature, fmt::format("the prescribed temperature \"{}\"", prescribed.name), false);
  refuse(*scene.heat.initial_temperature, "the \"initial temperature\"", false);
}

HeatOfModel add_heat(const MeshedScene& meshed, const Scene& scene, const Timers& timers, SystemParts& parts) {
  HeatOfModel heat;
  if (!scene.heat.acts()) return heat;
  refuse_without_temperature(scene);
  refuse_below_zero(scene);
  std::vector<ThermalBody> blocks;
  for (const Block& block : meshed.mesh->blocks) blocks.push_back(thermal_body(scene, *meshed.mesh, block));
  heat.bodies = std::make_shared<const ThermalBodies>(meshed.space, scene.kinematics, scene.thickness, std::move(blocks));
  const FlowsAtStart at_start = flows_at_start(scene);
  const auto book = [&](const std::string& name, std::shared_ptr<Contribution> flow) {
    const auto booked = std::make_shared<BookedHeat>(name, std::move(flow), heat.bodies, at_start, timers);
    parts.contributions.push_back(booked);
    return booked;
  };
  if (heat.bodies->has_capacity()) {
    heat.stored = std::make_shared<StoredHeat>(heat.bodies, timers);
    parts.contributions.push_back(heat.stored);
  }
  heat.conduction = book("heat conduction", std::make_shared<HeatConduction>(heat.bodies));
  if (heat.bodies->has_source()) heat.sources.push_back(book("heat source", std::make_shared<HeatSource>(heat.bodies)));
  Collector collect;
  for (const auto& load : scene.heat.loads)
    collect([&] {
      if (load.value.load.options) heat.sources.push_back(book(load.name, load.value.load.options->make(heat.bodies)));
    });
  collect([&] { heat.prescribed = std::make_shared<const PrescribedTemperatures>(*heat.bodies, scene.heat.temperatures); });
  collect.throw_found(*meshed.mesh->comm);
  return heat;
}

namespace {

double value_at(const ScalarFunction& function, const std::array<double, 3>& X) {
  const double value = value_or_nan(function, {X[0], X[1], X[2]});
  if (!std::isfinite(value))
    throw InputError(function.place(), fmt::format("\"{}\" is {} at x = {:g}, y = {:g}, z = {:g}; a temperature has to be a finite number",
                                                   function.source(), value, X[0], X[1], X[2]));
  return value;
}

}  // namespace

void put_initial_temperatures(const Scene& scene, const FieldSpace& space, Vector& unknowns) {
  if (!scene.heat.acts()) return;
  const Mesh& mesh = *space.mesh();
  std::vector<Diagnostic> diagnostics;
  const ScalarFunction* of_all = scene.heat.initial_temperature ? &*scene.heat.initial_temperature : nullptr;
  std::vector<const ScalarFunction*> of_bodies(mesh.bodies.size(), of_all);
  std::vector<std::string> names;
  for (const MeshBody& body : mesh.bodies) names.push_back(body.name);
  for (const auto& initial : scene.heat.initial_temperatures) {
    const auto found = std::find(names.begin(), names.end(), initial.value.body.value);
    if (found == names.end())
      diagnostics.push_back({initial.value.body.place, unknown_name("body", initial.value.body.value, names)});
    else if (const ScalarFunction*& of_body = of_bodies[static_cast<std::size_t>(found - names.begin())]; of_body != nullptr && of_body != of_all)
      diagnostics.push_back({initial.place, fmt::format("body \"{}\" has two initial temperatures; please remove one", initial.value.body.value)});
    else
      of_body = &initial.value.temperature;
  }
  const FieldRows& rows = space.rows(1);
  const auto theta = unknowns.getLocalViewHost(Tpetra::Access::ReadWrite);
  try {
    for (LocalOrdinal node = 0; node < mesh.owned_count(); ++node)
      if (rows.lives(node)) {
        const auto n = static_cast<std::size_t>(node);
        theta(rows(node, 0), 0) = value_at(*of_bodies[static_cast<std::size_t>(mesh.body_of_node[n])], mesh.coordinates[n]);
      }
  } catch (const InputError& error) {
    diagnostics.insert(diagnostics.end(), error.diagnostics().begin(), error.diagnostics().end());
  }
  throw_if_any(*mesh.comm, diagnostics);
}

double size_of_temperatures(const Scene& scene, const MeshedScene& meshed, const HeatOfModel& heat) {
  Vector start(meshed.space->dofs());
  put_initial_temperatures(scene, *meshed.space, start);
  double size = std::max(1.0, start.normInf());
  std::optional<StepFailure> failure;  // said when the step is tried
  for (const double time : {0.0, scene.stepping.end_time})
    for (const double value : heat.prescribed->values(time, failure))
      if (std::isfinite(value)) size = std::max(size, std::abs(value));
  return most_over_ranks(*meshed.mesh->comm, size);
}

std::vector<const ScalarFunction*> temperatures_around(const Scene& scene) {
  std::vector<const ScalarFunction*> around;
  for (const auto& load : scene.heat.loads)
    if (const ScalarFunction* surroundings = load.value.load.options ? load.value.load.options->surroundings_temperature() : nullptr)
      around.push_back(surroundings);
  for (const auto& body : scene.bodies)
    if (body.value.temperature) around.push_back(&*body.value.temperature);
  return around;
}

FurtherConstraints temperature_constraints(const MeshedScene& meshed, const Scene& scene, const HeatOfModel& heat) {
  FurtherConstraints result;
  if (!heat.bodies) return result;
  const FieldSpace& space = *meshed.space;
  result.lines = heat.prescribed->lines();
  result.values = [prescribed = heat.prescribed](double time, std::optional<StepFailure>& failure) { return prescribed->values(time, failure); };
  if (scene.ties.empty()) return result;
  const Mesh& mesh = *meshed.mesh;
  const FieldRows& rows = space.rows(heat.bodies->temperature());
  std::vector<char> held(static_cast<std::size_t>(mesh.owned_count()), 0);
  for (LocalOrdinal node = 0; node < mesh.owned_count(); ++node) held[static_cast<std::size_t>(node)] = rows.lives(node) ? 0 : 1;
  for (const LocalOrdinal row : heat.prescribed->rows()) held[static_cast<std::size_t>(space.place(row).node)] = 1;
  const std::shared_ptr<const TieRows> ties = tie_temperatures(meshed, scene, rows, held);
  if (!ties) return result;
  const Map& columns = *ties->T->getColMap();
  const auto local = ties->T->getLocalMatrixHost();
  for (const LocalOrdinal dof : ties->dofs) {
    const FieldPlace at = space.place(dof);
    if (at.component != 0) continue;
    AffineConstraints::Line line{rows(at.node, 0), {}, {}};
    for (LocalOrdinal k = 0; k < local.rowConst(dof).length; ++k)
      line.terms.emplace_back(space.id(heat.bodies->temperature(), space.node_of(columns.getGlobalElement(local.rowConst(dof).colidx(k))), 0),
                              local.rowConst(dof).value(k));
    result.lines.push_back(std::move(line));
  }
  return result;
}

std::vector<int> undetermined_bodies(const Scene& scene, const FieldSpace& space, const HeatOfModel& heat, const std::vector<int>& joined) {
  const Mesh& mesh = *space.mesh();
  std::vector<int> determined(mesh.bodies.size(), 0);
  for (const LocalOrdinal row : heat.prescribed->rows())
    determined[static_cast<std::size_t>(mesh.body_of_node[static_cast<std::size_t>(space.place(row).node)])] = 1;
  for (const auto& load : scene.heat.loads) {
    if (!load.value.load.options || !load.value.load.options->determines_temperature()) continue;
    for (const SidesOfBody& sides : sides_by_body(mesh, require_side_set(mesh, load.value.load.options->set))) determined[sides.body] = 1;
  }
  std::vector<char> needs(mesh.bodies.size(), 0);
  for (std::size_t block = 0; block < mesh.blocks.size(); ++block) {
    const auto& properties = heat.bodies->bodies()[block].properties;
    const auto body = static_cast<std::size_t>(mesh.blocks[block].body);
    if (properties && properties->specific_heat.is_given())
      determined[body] = 1;
    else if (properties)
      needs[body] = 1;
  }
  for (const auto& body : scene.bodies)
    for (std::size_t b = 0; b < mesh.bodies.size(); ++b)
      if (body.value.temperature && mesh.bodies[b].name == body.name) determined[b] = 1;  // a rigid one
  determined = most_over_ranks(*mesh.comm, determined);
  std::vector<int> result;
  for (std::size_t body = 0; body < mesh.bodies.size(); ++body) {
    bool is_determined = false;
    for (std::size_t other = 0; other < mesh.bodies.size(); ++other) is_determined |= joined[other] == joined[body] && determined[other] != 0;
    if (needs[body] && !is_determined) result.push_back(static_cast<int>(body));
  }
  return result;
}

void refuse_undetermined(const MeshedScene& meshed, const Scene& scene, const HeatOfModel& heat, const std::vector<int>& joined) {
  if (!heat.bodies) return;
  const Mesh& mesh = *meshed.mesh;
  std::vector<Diagnostic> diagnostics;
  for (std::size_t block = 0; block < mesh.blocks.size(); ++block)
    if (const auto& properties = heat.bodies->bodies()[block].properties;
        properties && !properties->specific_heat.is_given() && properties->conductivity.is_constant() && properties->conductivity.at(0.0) == 0.0)
      diagnostics.push_back({heat.bodies->bodies()[block].place,
                             fmt::format("body \"{}\" conducts no heat and stores none: its conductivity is 0; allowed: > 0 without a specific heat",
                                         mesh.body_of(mesh.blocks[block]).name)});
  for (const int body : undetermined_bodies(scene, *meshed.space, heat, joined))
    diagnostics.push_back(
        {meshed.places[static_cast<std::size_t>(body)],
         fmt::format("nothing determines the temperature of body \"{}\", which stores no heat: please prescribe a temperature on a part of "
                     "it, or give it convection, radiation, or a pair or tie that conducts to a body with one",
                     mesh.bodies[static_cast<std::size_t>(body)].name)});
  throw_if_any(*mesh.comm, diagnostics);
}

}  // namespace mortise
