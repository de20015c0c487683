#include "mortise/simulation/model/model.hpp"

#include <fmt/format.h>

#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_CrsGraph.hpp>
#include <Tpetra_Map.hpp>

#include "model/connectors/connector_contributions.hpp"
#include "model/connectors/stabilisation.hpp"
#include "model/contributions.hpp"
#include "model/edge_contact.hpp"
#include "model/heat/contact_heat_book.hpp"
#include "model/heat/heat_of_scene.hpp"
#include "model/stages/contact_model.hpp"
#include "mortise/contact/enforcement.hpp"
#include "mortise/core/names.hpp"
#include "mortise/material/materials.hpp"
#include "mortise/mesh/digest.hpp"
#include "mortise/nonlinear/linear_solver_factory.hpp"

namespace mortise {
namespace {

Effects effects_of(const Scene& scene, const Bodies& bodies, const HeatOfModel& heat) {
  std::vector<std::string> finite, small, f_bar, plastic, pairs, rubbing, loads, conditions;
  std::vector<std::string> rigid, points, ties, moving;
  for (const auto& point : scene.reference_points) points.push_back(point.name);
  for (const auto& tie : scene.ties) ties.push_back(tie.name);
  const auto add = [](std::vector<std::string>& names, const std::string& name) {  // a body may have several blocks
    if (names.empty() || names.back() != name) names.push_back(name);
  };
  for (const auto& block : bodies.properties()) {
    if (block.is_rigid()) {
      add(rigid, block.name);
      continue;
    }
    const bool small_strain = std::visit([](const auto& law) { return law.small_strain; }, block.material->law());
    add(small_strain ? small : finite, block.name);
    if (formulation(block.element) == ElementFormulation::f_bar) add(f_bar, block.name);
    if (std::visit([](const auto& law) { return has_history<std::decay_t<decltype(law)>>; }, block.material->law())) add(plastic, block.name);
  }
  if (scene.inertia.acts())
    for (const auto& body : scene.bodies)
      if (!body.value.rigid.value || body.value.density || body.value.mass) moving.push_back(body.name);
  for (const auto& pair : scene.contact) {
    pairs.push_back(pair.name);
    if (pair.value.contact.friction.options->acts()) rubbing.push_back(pair.name);
  }
  for (const auto& load : scene.loads) loads.push_back(load.name);
  for (const auto& condition : scene.boundary_conditions) conditions.push_back(condition.name);
  Effects effects{{"finite strain", finite}, {"small strain", small}, {"F-bar", f_bar},
                  {"plasticity", plastic},   {"ties", ties},          {"contact", pairs},
                  {"friction", rubbing},     {"rigid bodies", rigid}, {"reference points", points},
                  {"inertia", moving},       {"loads", loads},        {"boundary conditions", conditions}};
  const auto add_named = [&](const char* effect, const auto& members) {
    if (!members.empty()) effects.emplace_back(effect, names_of(members));
  };
  if (scene.heat.acts()) {
    std::vector<std::string> conducting;
    for (std::size_t block = 0; block < bodies.properties().size(); ++block)
      if (heat.bodies->bodies()[block].properties) add(conducting, bodies.properties()[block].name);
    effects.emplace_back(scene.heat.is_transient() ? "transient heat" : "steady heat", conducting);
    add_named("thermal loads", scene.heat.loads);
    add_named("prescribed temperatures", scene.heat.temperatures);
  }
  add_named("springs", scene.springs);
  add_named("dashpots", scene.dashpots);
  add_named("point masses", scene.point_masses);
  return effects;
}

LinearSystemTraits traits_of(const Scene& scene, const Map& dofs) {
  LinearSystemTraits traits;
  traits.unknowns = static_cast<GlobalOrdinal>(dofs.getGlobalNumElements());
  traits.dimension = dimension(scene.kinematics);
  for (const auto& tie : scene.reference_points)
    if (tie.value.follows != TieOptions::Follows::all)
      traits.not_iterative = fmt::format(
          "the iterative solver needs all components of a node as unknowns, but nodes follow \"{}\" in one component; take \"mumps\"", tie.name);
  for (const auto& pair : scene.contact)
    if (pair.value.contact.formulation.options->enforcement()->keeps_multipliers())
      traits.not_iterative =
          fmt::format("the iterative solver does not know the saddle point system of \"{}\"; take \"mumps\"", pair.value.contact.formulation.type);
  return traits;
}

}  // namespace

Model::Model(const RCP<const Communicator>& comm, const Scene& scene, const Timers& timers) {
  MeshedScene meshed = mesh_scene(comm, scene, timers);
  Collector collect;
  SolidModel solid = make_solid(meshed, scene, timers, collect);
  std::vector<ContactPair> pairs = make_pairs(meshed, *solid.bodies, scene, collect);
  collect([&] { solid.parts.linear_solver = make_linear_solver(scene.linear_solver, comm, timers, traits_of(scene, *solid.parts.dofs)); });
  collect.throw_found(*comm);
  add_supports(meshed, scene, timers, solid);
  const std::vector<ThermalPair> conducting = thermal_pairs(meshed, scene, solid.heat);
  refuse_undetermined(meshed, scene, solid.heat, bodies_that_conduct(*meshed.mesh, scene, conducting));
  ContactModel contact = make_contact(meshed, solid, scene, std::move(pairs), timers);
  if (!conducting.empty()) {
    solid.heat.contact = std::make_shared<ContactHeatBook>(meshed, scene, solid.heat, *contact.system, conducting, timers);
    solid.parts.contact_contributions.push_back(solid.heat.contact);
  }
  if (solid.heat.bodies)
    solid.parts.fields = {{meshed.space->field(0), meshed.size.length},
                          {meshed.space->field(solid.heat.bodies->temperature()), size_of_temperatures(scene, meshed, solid.heat)}};

  mesh_ = meshed.mesh;
  space_ = meshed.space;
  size_ = meshed.size;
  mesh_remarks_ = std::move(meshed.remarks);
  mesh_digest_ = std::move(meshed.digest);
  ties_at_start_ = std::move(meshed.ties.at_start);
  bodies_ = solid.bodies;
  supports_ = std::move(solid.supports);
  inertia_ = std::move(solid.inertia);
  heat_ = std::move(solid.heat);
  effects_ = effects_of(scene, *bodies_, heat_);
  parts_ = std::move(solid.parts);
  surfaces_at_start_ = std::move(contact.at_start);
  connectors_ = std::move(solid.connectors);
  held_by_contact_only_.assign(static_cast<std::size_t>(mesh_->owned_count()), 0);
  if (scene.stabilisation.acts() && !scene.inertia.acts())
    stabilise(scene, contact.held_by_contact_only, timers);
  else
    for (LocalOrdinal node = 0; node < mesh_->owned_count(); ++node)
      held_by_contact_only_[node] = contact.held_by_contact_only[mesh_->body_of_node[node]];
  bodies_of_pairs_ = std::move(contact.bodies_of_pairs);
  parts_.contact = std::move(contact.system);
  if (!contact.edges) return;
  edges_ = contact.edges;
  parts_.contributions.push_back(edges_);
  parts_.bulk_graph = [edges = edges_, inner = parts_.bulk_graph] { return edges->graph(inner()); };
  parts_.bulk_version = [edges = edges_] { return edges->graph_version(); };
}

Model::~Model() = default;

void Model::stabilise(const Scene& scene, const std::vector<char>& loose, const Timers& timers) {
  std::vector<std::string> names;
  for (std::size_t body = 0; body < loose.size(); ++body)
    if (loose[body]) names.push_back(mesh_->bodies[body].name);
  effects_.emplace_back("stabilisation", names);
  if (names.empty()) return;
  connectors_.stabilisation = std::make_shared<Stabilisation>(bodies_, loose, scene.stabilisation, scene.stepping.end_time, size_.length, timers);
  parts_.contributions.push_back(connectors_.stabilisation);
}

std::string Model::mesh_digest() const { return mesh_digest_.empty() ? mortise::mesh_digest(*mesh_) : mesh_digest_; }

GlobalOrdinal Model::dofs() const { return static_cast<GlobalOrdinal>(parts_.dofs->getGlobalNumElements()); }

GlobalOrdinal Model::slave_nodes() const {
  return parts_.contact ? static_cast<GlobalOrdinal>(parts_.contact->multiplier_map()->getGlobalNumElements()) / mesh_->dimension : 0;
}

std::map<std::string, long> Model::calls() const {
  std::map<std::string, long> calls;
  for (const auto& contribution : parts_.contributions) calls[contribution->name()] += static_cast<const CountedContribution&>(*contribution).calls();
  if (heat_.contact) calls[heat_.contact->name()] = heat_.contact->calls();
  return calls;
}

std::vector<BodyHistory> Model::histories() const {
  const std::size_t count = mesh_->bodies.size();
  std::vector<double> mine(2 * count, 0.0), all(2 * count);
  for (std::size_t block = 0; block < mesh_->blocks.size(); ++block) {
    const auto body = static_cast<std::size_t>(mesh_->blocks[block].body);
    mine[2 * body] += static_cast<double>(bodies_->history_bytes(static_cast<LocalOrdinal>(block)));
    mine[2 * body + 1] += static_cast<double>(bodies_->history_evaluations(static_cast<LocalOrdinal>(block)));
  }
  Teuchos::reduceAll(*mesh_->comm, Teuchos::REDUCE_SUM, static_cast<int>(2 * count), mine.data(), all.data());
  std::vector<BodyHistory> histories;
  for (std::size_t body = 0; body < count; ++body)
    histories.push_back({mesh_->bodies[body].name, static_cast<long>(all[2 * body]), static_cast<long>(all[2 * body + 1])});
  return histories;
}

}  // namespace mortise
