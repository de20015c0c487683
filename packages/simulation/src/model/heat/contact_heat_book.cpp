#include "model/heat/contact_heat_book.hpp"

#include <fmt/format.h>

#include <Tpetra_Map.hpp>
#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <cmath>
#include <limits>

#include "model/pairs/surface_ties.hpp"
#include "mortise/core/guarded_value.hpp"
#include "mortise/core/over_ranks.hpp"
#include "mortise/mesh/sets.hpp"
#include "scene/roles.hpp"
#include "surfaces/body_surfaces.hpp"

namespace mortise {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// What is known of one side of a pair, over all ranks.
struct SideHeat {
  bool has_rows = false;      ///< some node has a temperature among the unknowns
  bool lacks = false;         ///< some node has no temperature at all
  double effusivity = none;   ///< mean of its bodies, at the first temperature; NaN: of none
  double conductivity = 0.0;  ///< largest of its bodies there; 0: of none
};

const BodyOptions& body_of(const Scene& scene, const Mesh& mesh, std::size_t body) {
  const auto found = std::find_if(scene.bodies.begin(), scene.bodies.end(), [&](const auto& one) { return one.name == mesh.bodies[body].name; });
  return found->value;
}

/// Numbers of a body's first block with a temperature, at the temperature at the start in the origin. NaN where it has none.
struct BodyHeat {
  double conductivity = none;
  double effusivity = none;  ///< sqrt(k rho c); NaN where it stores no heat
};

BodyHeat heat_of(const HeatOfModel& heat, const Scene& scene, const Mesh& mesh, std::size_t body) {
  const double start = value_or_nan(*scene.heat.initial_temperature, {0.0, 0.0, 0.0});
  for (std::size_t block = 0; block < mesh.blocks.size(); ++block) {
    const ThermalBody& of_block = heat.bodies->bodies()[block];
    if (static_cast<std::size_t>(mesh.blocks[block].body) != body || !of_block.properties) continue;
    BodyHeat result{of_block.properties->conductivity.at(start), none};
    if (of_block.properties->specific_heat.is_given())
      result.effusivity = std::sqrt(result.conductivity * of_block.density * of_block.properties->specific_heat.at(start));
    return result;
  }
  return {};
}

SideHeat side_of(const MeshedScene& meshed, const Scene& scene, const HeatOfModel& heat, const Located<std::string>& set) {
  const Mesh& mesh = *meshed.mesh;
  const FieldRows& rows = meshed.space->rows(heat.bodies->temperature());
  SideHeat side;
  double sum = 0.0;
  int count = 0;
  for (const SidesOfBody& sides : sides_by_body(mesh, require_side_set(mesh, set))) {
    if (mesh.bodies[sides.body].is_surface) {
      if (!body_of(scene, mesh, sides.body).temperature) side.lacks = true;
      continue;
    }
    const BodyHeat of_body = heat_of(heat, scene, mesh, sides.body);
    if (std::isfinite(of_body.effusivity)) sum += of_body.effusivity, ++count;
    if (of_body.conductivity > side.conductivity) side.conductivity = of_body.conductivity;
  }
  int lives = 0, lacks = 0;
  for (const LocalOrdinal node : require_node_set(mesh, set)) {
    if (node >= mesh.owned_count()) continue;
    if (rows.lives(node))
      lives = 1;
    else if (!mesh.bodies[static_cast<std::size_t>(mesh.body_of_node[static_cast<std::size_t>(node)])].is_surface)
      lacks = 1;
  }
  const std::vector<int> all = most_over_ranks(*mesh.comm, std::vector<int>{lives, lacks, side.lacks ? 1 : 0});
  side.has_rows = all[0] != 0;
  side.lacks = all[1] != 0 || all[2] != 0;
  if (count > 0) side.effusivity = sum / count;
  return side;
}

/// Of the heat of friction: all heats the side with a temperature where only one has rows.
double share_of(const ContactHeatOptions& options, const SideHeat& slave, const SideHeat& master) {
  if (options.slave_share) return *options.slave_share;
  if (!master.has_rows) return 1.0;
  if (!slave.has_rows) return 0.0;
  if (!std::isfinite(slave.effusivity) || !std::isfinite(master.effusivity)) return 0.5;
  return share_of_slave(slave.effusivity, master.effusivity);
}

}  // namespace

std::vector<ThermalPair> thermal_pairs(const MeshedScene& meshed, const Scene& scene, const HeatOfModel& heat) {
  std::vector<ThermalPair> pairs;
  std::vector<Diagnostic> diagnostics;
  for (std::size_t p = 0; p < scene.contact.size(); ++p) {
    const auto& pair = scene.contact[p];
    const ContactHeatOptions& options = pair.value.heat;
    const auto refuse = [&](const std::string& words) { diagnostics.push_back({pair.place, words}); };
    const auto& friction = pair.value.contact.friction.options;
    const bool rubs = friction && friction->acts();
    if (!heat.bodies) {
      if (rubs && friction->reads_temperature())
        refuse(fmt::format(
            "the friction of pair \"{}\" depends on the temperature, but the scene has none; please give the list \"heat\" of the scene an "
            "\"analysis\"",
            pair.name));
      if (options.conducts() || options.crosses_gaps())
        refuse(fmt::format(
            "pair \"{}\" has a law of conductance, but the scene no temperature; please give the list \"heat\" of the scene an \"analysis\"",
            pair.name));
      continue;
    }
    const SideHeat slave = side_of(meshed, scene, heat, pair.value.slave), master = side_of(meshed, scene, heat, pair.value.master);
    ThermalPair thermal;
    thermal.pair = p;
    if (options.conducts()) thermal.conductance = options.conductance.law.options;
    if (dynamic_cast<const PerfectConductance*>(thermal.conductance.get()) != nullptr)
      thermal.conductance = std::make_shared<PerfectConductance>(
          PerfectConductance::of(std::max(slave.conductivity, master.conductivity), surface_traits(*meshed.mesh, scene, pair.value.slave).facet));
    if (options.crosses_gaps()) thermal.gap = options.gap.law.options;
    if ((thermal.conductance || thermal.gap) && (slave.lacks || master.lacks))
      refuse(fmt::format(
          "pair \"{}\" conducts heat, but {} has no temperature; please give its materials a list \"heat\" with a \"conductivity\", or, of a "
          "rigid body, a \"temperature\"",
          pair.name, slave.lacks ? "its slave" : "its master"));
    if (thermal.conductance)
      if (const auto fault = thermal.conductance->fault()) refuse(fmt::format("conductance of pair \"{}\": {}", pair.name, *fault));
    if (thermal.gap)
      if (const auto fault = thermal.gap->fault()) refuse(fmt::format("gap conductance of pair \"{}\": {}", pair.name, *fault));
    if (const auto* function = dynamic_cast<const ConductanceFunction*>(thermal.conductance.get());
        function != nullptr && function->conductance.depends_on(2) && !rubs)
      refuse(
          fmt::format("the conductance of pair \"{}\" depends on `slip_rate`, and a pair without friction has no slip; please give it a \"friction\"",
                      pair.name));
    if (thermal.gap && !(thermal.conductance && thermal.conductance->fault()) && !thermal.gap->fault()) {
      const double start = value_or_nan(*scene.heat.initial_temperature, {0.0, 0.0, 0.0});
      const double closed = thermal.conductance ? thermal.conductance->at({0.0, start, 0.0, 1.0}).value : 0.0, open = thermal.gap->at(0.0).value;
      if (std::abs(closed - open) > 0.01 * std::max(std::abs(closed), std::abs(open)))
        refuse(fmt::format(
            "the laws of pair \"{}\" do not meet: the conductance is {:g} without pressure, and {:g} without a gap; they may differ by 1 %",
            pair.name, closed, open));
    }
    if (rubs && options.friction_heats && scene.heat.is_transient() && (slave.has_rows || master.has_rows))
      thermal.slave_share = share_of(options, slave, master);
    const bool reads_temperature = rubs && friction->reads_temperature();
    if (reads_temperature && (slave.lacks || master.lacks))
      refuse(
          fmt::format("the friction of pair \"{}\" depends on the temperature, but {} has none; please give its materials a list \"heat\" with a "
                      "\"conductivity\", or, of a rigid body, a \"temperature\"",
                      pair.name, slave.lacks ? "its slave" : "its master"));
    if (thermal.conductance || thermal.gap || thermal.slave_share || reads_temperature) pairs.push_back(std::move(thermal));
  }
  throw_if_any(*meshed.mesh->comm, diagnostics);
  return pairs;
}

std::vector<int> bodies_that_conduct(const Mesh& mesh, const Scene& scene, const std::vector<ThermalPair>& pairs) {
  std::vector<int> number = joined_bodies(mesh, scene);
  for (const ThermalPair& pair : pairs) {
    if (!pair.conductance && !pair.gap) continue;
    std::vector<std::size_t> bodies;
    for (const auto* set : {&scene.contact[pair.pair].value.slave, &scene.contact[pair.pair].value.master})
      for (const SidesOfBody& sides : sides_by_body(mesh, require_side_set(mesh, *set))) bodies.push_back(sides.body);
    for (const std::size_t body : bodies) std::replace(number.begin(), number.end(), number[body], number[bodies.front()]);
  }
  return number;
}

ContactHeatBook::ContactHeatBook(const MeshedScene& meshed, const Scene& scene, const HeatOfModel& heat, const ContactSystem& contact,
                                 std::vector<ThermalPair> pairs, Timers timers)
    : mesh_(meshed.mesh),
      rigid_(mesh_->bodies.size()),
      pairs_(std::move(pairs)),
      heat_(contact, meshed.space->field(heat.bodies->temperature()), meshed.space->dofs(), pairs_),
      timers_(std::move(timers)),
      sums_(pairs_.size()),
      nodes_(pairs_.size()) {
  for (const ThermalPair& pair : pairs_) {
    pairs_of_scene_.push_back(pair.pair);
    const auto& friction = scene.contact[pair.pair].value.contact.friction.options;
    rubs_by_temperature_.push_back(friction && friction->acts() && friction->reads_temperature() ? 1 : 0);
  }
  for (std::size_t body = 0; body < mesh_->bodies.size(); ++body) {
    if (!mesh_->bodies[body].is_surface) continue;
    rigid_[body] = body_of(scene, *mesh_, body).temperature;
    any_rigid_ = any_rigid_ || rigid_[body];
  }
}

std::optional<std::size_t> ContactHeatBook::index(std::size_t pair_of_scene) const {
  const auto found = std::find(pairs_of_scene_.begin(), pairs_of_scene_.end(), pair_of_scene);
  if (found == pairs_of_scene_.end()) return std::nullopt;
  return static_cast<std::size_t>(found - pairs_of_scene_.begin());
}

RCP<const Vector> ContactHeatBook::of_rigid_bodies(double time, std::optional<StepFailure>& failure) const {
  if (!any_rigid_) return Teuchos::null;
  std::vector<double> of_body(rigid_.size(), none);
  for (std::size_t body = 0; body < rigid_.size(); ++body) {
    if (!rigid_[body]) continue;
    of_body[body] = value_or_nan(*rigid_[body], {time});
    if (!std::isfinite(of_body[body]) && !failure)
      failure.emplace(FailureKind::input, fmt::format("the temperature of the rigid body \"{}\", \"{}\", is {} at t = {:g}", mesh_->bodies[body].name,
                                                      rigid_[body]->source(), of_body[body], time));
  }
  const auto result = rcp(new Vector(mesh_->owned_nodes));
  const auto view = result->getLocalViewHost(Tpetra::Access::OverwriteAll);
  for (LocalOrdinal node = 0; node < mesh_->owned_count(); ++node)
    view(node, 0) = of_body[static_cast<std::size_t>(mesh_->body_of_node[static_cast<std::size_t>(node)])];
  return result;
}

template <class Function>
auto ContactHeatBook::at_temperatures(double time, const Vector& unknowns, std::optional<StepFailure>& failure, const Function& function) const {
  const RCP<const Vector> rigid = of_rigid_bodies(time, failure);
  throw_if_any(*mesh_->comm, failure);
  return function(rigid.is_null() ? NodalTemperature(unknowns) : NodalTemperature(unknowns, *rigid));
}

void ContactHeatBook::add_residual(const ContactLaws& laws, const Configuration& at, Vector& residual, std::optional<StepFailure>& failure) {
  const auto timer = timers_.scope("contact heat");
  ++calls_;
  at_temperatures(at.time, at.unknowns, failure, [&](const NodalTemperature& theta) { heat_.evaluate(laws, theta, time_step(at)).add_to(residual); });
}

ContactContribution::Derivatives ContactHeatBook::differentiate(const ContactLinearisation& linearised, const Configuration& at,
                                                                std::optional<StepFailure>& failure) {
  const auto timer = timers_.scope("contact heat");
  ++calls_;
  return at_temperatures(at.time, at.unknowns, failure, [&](const NodalTemperature& theta) {
    const DifferentiatedHeat heat = heat_.differentiate(linearised, theta, time_step(at));
    return Derivatives{heat.of_dofs(), heat.of_multipliers()};
  });
}

void ContactHeatBook::commit(const ContactLaws& laws, const Configuration& at) {
  std::optional<StepFailure> failure;  // a converged state has none
  at_temperatures(at.time, at.unknowns, failure, [&](const NodalTemperature& theta) {
    const ContactHeat heat = heat_.evaluate(laws, theta, time_step(at));
    const double dt = at.time - time_;
    surface_temperatures_.clear();
    is_restored_ = false;
    for (std::size_t pair = 0; pair < pairs_.size(); ++pair) {
      Sums& sums = sums_[pair];
      sums.power = heat.flow(pair);
      const auto add = [&](double HeatFlow::*member) { sums.energy.*member += dt * sums.power.*member; };
      for (const auto member : {&HeatFlow::conducted, &HeatFlow::friction, &HeatFlow::to_slave_without_rows, &HeatFlow::to_master_without_rows})
        add(member);
      nodes_[pair] = heat.nodes(pair);
      if (rubs_by_temperature_[pair] == 0) continue;
      for (auto& of_pass : heat_.surface_temperatures(laws, theta, pair)) surface_temperatures_.push_back(std::move(of_pass));
    }
  });
  if (at.time > time_) last_step_ = at.time - time_;
  time_ = at.time;
}

ContactHistory ContactHeatBook::with_temperatures(const ContactSystem& contact, ContactHistory history, double time, const Vector& unknowns) const {
  if (std::find(rubs_by_temperature_.begin(), rubs_by_temperature_.end(), 1) == rubs_by_temperature_.end() || is_restored_) return history;
  std::vector<ThermalContact::SurfaceTemperatures> temperatures = surface_temperatures_;
  if (temperatures.empty()) {
    std::optional<StepFailure> failure;
    at_temperatures(time, unknowns, failure, [&](const NodalTemperature& theta) {
      for (std::size_t pair = 0; pair < pairs_.size(); ++pair)
        if (rubs_by_temperature_[pair] != 0)
          for (auto& of_pass : heat_.slave_temperatures(theta, pair)) temperatures.push_back(std::move(of_pass));
    });
  }
  for (auto& of_pass : temperatures) history = contact.with_temperatures(history, of_pass.pair, std::move(of_pass.values));
  return history;
}

std::vector<ThermalPair> ContactHeatBook::conducting_now() const {
  std::vector<int> mine;
  for (const std::vector<NodeHeat>& nodes : nodes_)
    mine.push_back(std::any_of(nodes.begin(), nodes.end(), [](const NodeHeat& node) { return node.conductance > 0.0; }) ? 1 : 0);
  const std::vector<int> any = most_over_ranks(*mesh_->comm, mine);
  std::vector<ThermalPair> result;
  for (std::size_t pair = 0; pair < pairs_.size(); ++pair)
    if (any[pair] != 0) result.push_back(pairs_[pair]);
  return result;
}

void ContactHeatBook::serialize(StateArchive& archive) {
  is_restored_ = archive.restores();
  mortise::serialize(archive, "contact_heat.time", time_);
  mortise::serialize(archive, "contact_heat.last_step", last_step_);
  std::vector<double> numbers;
  for (const Sums& sums : sums_)
    for (const HeatFlow* flow : {&sums.power, &sums.energy})
      numbers.insert(numbers.end(), {flow->conducted, flow->friction, flow->to_slave_without_rows, flow->to_master_without_rows});
  const std::size_t count = numbers.size();
  mortise::serialize(archive, "contact_heat.sums", numbers);
  archive.refuse_if(numbers.size() == count
                        ? std::nullopt
                        : std::optional(fmt::format("\"contact_heat.sums\" has {} numbers; expected are {}", numbers.size(), count)));
  std::size_t n = 0;
  for (Sums& sums : sums_)
    for (HeatFlow* flow : {&sums.power, &sums.energy}) {
      *flow = {numbers[n], numbers[n + 1], numbers[n + 2], numbers[n + 3]};
      n += 4;
    }
}

}  // namespace mortise
