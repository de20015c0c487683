#include "mortise/simulation/model/model.hpp"

#include <fmt/format.h>

#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_CrsGraph.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_MultiVector.hpp>
#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <cmath>

#include "model/connectors/connector_contributions.hpp"
#include "model/connectors/connectors_of_scene.hpp"
#include "model/connectors/stabilisation.hpp"
#include "model/contributions.hpp"
#include "model/current_places.hpp"
#include "model/edge_contact.hpp"
#include "model/inclined_supports.hpp"
#include "model/motion/inertia.hpp"
#include "model/pairs/adjusted_slaves.hpp"
#include "model/pairs/search_reach.hpp"
#include "model/pairs/surface_ties.hpp"
#include "model/precision.hpp"
#include "mortise/core/names.hpp"
#include "mortise/material/materials.hpp"
#include "mortise/mesh/digest.hpp"
#include "mortise/nonlinear/linear_solver_factory.hpp"
#include "mortise/simulation/model/hold_check.hpp"
#include "mortise/simulation/model/mesh_limits.hpp"
#include "mortise/simulation/scene/scene_bodies.hpp"
#include "surfaces/body_surfaces.hpp"
#include "surfaces/rounded_facets.hpp"

namespace mortise {
namespace {

/// Runs the parts of the construction one after the other and keeps what each of them finds wrong.
class Collector {
 public:
  template <class Function>
  void operator()(const Function& function) {
    try {
      function();
    } catch (const InputError& error) {
      diagnostics_.insert(diagnostics_.end(), error.diagnostics().begin(), error.diagnostics().end());
    }
  }
  /// Collective.
  void throw_found(const Communicator& comm) const { throw_if_any(comm, diagnostics_); }

 private:
  std::vector<Diagnostic> diagnostics_;
};

/// Points of the rigid bodies, then those of the scene.
std::vector<ReferencePointDescription> reference_points(const Scene& scene) {
  const bool axisymmetric = scene.kinematics == Kinematics::axisymmetric;
  const auto position = [](const std::vector<double>& given) {
    return given.empty() ? std::nullopt : std::optional<std::array<double, 3>>({given[0], given[1], given.size() > 2 ? given[2] : 0.0});
  };
  std::vector<ReferencePointDescription> points;
  for (const auto& body : scene.bodies)
    if (body.value.rigid.value) {
      auto at = position(body.value.reference_point);
      if (at)  // given for the first of a pattern
        if (const auto moved = placement(Mirror::none, body.value.pattern)) at = (*moved)(*at);
      points.push_back({body.name + "/reference", body.place, !axisymmetric, at});
    }
  for (const auto& tie : scene.reference_points)
    points.push_back({tie.name, tie.place, tie.value.rotates && !axisymmetric, position(tie.value.position)});
  return points;
}

void tie(Mesh& mesh, const Scene& scene) {
  std::size_t point = 0;
  Collector collect;
  for (const auto& body : scene.bodies)
    if (body.value.rigid.value) {
      collect([&] { add_followers(mesh, point, {body.name, body.place}, {true, true, true}); });
      ++point;
    }
  for (const auto& tie : scene.reference_points) {
    using Follows = TieOptions::Follows;
    const Follows follows = tie.value.follows;
    // The nodes of a ring cannot share a radial displacement and stay a rigid ring.
    const bool all = follows == Follows::all, x = follows == Follows::x || (all && scene.kinematics != Kinematics::axisymmetric);
    collect([&] { add_followers(mesh, point, tie.value.set, {x, all || follows == Follows::y, all || follows == Follows::z}); });
    ++point;
  }
  collect.throw_found(*mesh.comm);
}

RCP<Mesh> make_mesh(const RCP<const Communicator>& comm, const Scene& scene, MeshRemarks& remarks) {
  const std::vector<BodyDescription> bodies = body_descriptions(*comm, scene);
  for (const BodyDescription& body : bodies) {
    if (!body.listed) continue;
    for (const std::string& note : body.listed->notes) remarks.notes.push_back(body.name + ": " + note);
    for (const std::string& warning : body.listed->warnings) remarks.warnings.push_back(body.name + ": " + warning);
  }
  refuse_too_large(*comm, bodies);
  const auto mesh = build_mesh(comm, bodies, contact_sides(scene), reference_points(scene));
  add_sets(*mesh, scene.sets);
  tie(*mesh, scene);
  return mesh;
}

/// From `origin` on.
RCP<MultiVector> reference_positions(const Mesh& mesh, const std::array<double, 3>& origin) {
  const auto positions = rcp(new MultiVector(mesh.owned_nodes, static_cast<std::size_t>(mesh.dimension)));
  const auto view = positions->getLocalViewHost(Tpetra::Access::OverwriteAll);
  for (LocalOrdinal node = 0; node < mesh.owned_count(); ++node)
    for (int i = 0; i < mesh.dimension; ++i) view(node, i) = mesh.coordinates[node][i] - origin[i];
  return positions;
}

/// `mark` in the components of owned nodes that are `dofs`, 0 elsewhere.
RCP<MultiVector> marked_components(const Mesh& mesh, const std::vector<LocalOrdinal>& dofs, double mark) {
  const auto marks = rcp(new MultiVector(mesh.owned_nodes, static_cast<std::size_t>(mesh.dimension)));
  const auto view = marks->getLocalViewHost(Tpetra::Access::ReadWrite);
  for (const LocalOrdinal dof : dofs) view(dof / mesh.dimension, dof % mesh.dimension) = mark;
  return marks;
}

/// Crosspoints get their mark in components that have none.
void mark_crosspoints(const std::vector<char>& is_crosspoint, MultiVector& marks) {
  const auto view = marks.getLocalViewHost(Tpetra::Access::ReadWrite);
  for (std::size_t node = 0; node < is_crosspoint.size(); ++node)
    for (std::size_t i = 0; is_crosspoint[node] != 0 && i < view.extent(1); ++i)
      if (view(node, i) == 0.0) view(node, i) = crosspoint_mark;
}

/// Young's modulus of the softest deformable body with a facet in `facets`, over all ranks; the largest number if all are rigid.
double softest(const Mesh& mesh, const Bodies& bodies, const SurfaceFacets& facets) {
  double mine = std::numeric_limits<double>::max(), least = mine;
  std::vector<double> of_body(mesh.bodies.size(), mine);
  for (std::size_t block = 0; block < mesh.blocks.size(); ++block)
    if (const BodyProperties& of_block = bodies.properties()[block]; !of_block.is_rigid())
      of_body[mesh.blocks[block].body] = std::min(of_body[mesh.blocks[block].body], of_block.material->youngs_modulus);
  for (const auto& facet : facets) {
    mine = std::min(mine, of_body[mesh.body_of_node[mesh.local_nodes->getLocalElement(facet[0])]]);
  }
  Teuchos::reduceAll(*mesh.comm, Teuchos::REDUCE_MIN, mine, Teuchos::outArg(least));
  return least;
}

/// Collective.
ContactPair make_pair(const Mesh& mesh, const Bodies& bodies, const Named<ContactPairOptions>& options, const Located<std::string>& slave,
                      const Located<std::string>& master) {
  ContactPair pair;
  pair.name = options.name;
  pair.place = options.place;
  pair.options = options.value.contact;
  Collector collect;
  collect([&] { pair.slave = facets_at_owned_nodes(mesh, require_side_set(mesh, slave)); });
  collect([&] { pair.master = facets_of_owned_elements(mesh, require_side_set(mesh, master)); });
  collect.throw_found(*mesh.comm);
  pair.youngs_modulus = std::min(softest(mesh, bodies, pair.slave), softest(mesh, bodies, pair.master));
  return pair;
}

/// The least and the largest of values, over all ranks; 0 of none. Collective.
std::array<double, 2> range_over_ranks(const Communicator& comm, const std::vector<double>& values) {
  double mine[2] = {0.0, 0.0}, all[2];
  for (const double value : values) mine[0] = std::max(mine[0], -value), mine[1] = std::max(mine[1], value);
  Teuchos::reduceAll(comm, Teuchos::REDUCE_MAX, 2, mine, all);
  return {-all[0], all[1]};
}

/// mesh.bodies indices of the bodies of each pair. Collective.
std::vector<std::vector<int>> bodies_of(const Mesh& mesh, const std::vector<ContactPair>& pairs) {
  const std::size_t count = mesh.bodies.size();
  std::vector<int> mine(pairs.size() * count, 0), all(mine.size());
  for (std::size_t p = 0; p < pairs.size(); ++p)
    for (const auto* facets : {&pairs[p].slave, &pairs[p].master})
      for (const auto& facet : *facets) mine[count * p + mesh.body_of_node[mesh.local_nodes->getLocalElement(facet[0])]] = 1;
  Teuchos::reduceAll(*mesh.comm, Teuchos::REDUCE_MAX, static_cast<int>(mine.size()), mine.data(), all.data());
  std::vector<std::vector<int>> bodies(pairs.size());
  for (std::size_t p = 0; p < pairs.size(); ++p)
    for (std::size_t body = 0; body < count; ++body)
      if (all[count * p + body]) bodies[p].push_back(static_cast<int>(body));
  return bodies;
}

/// A function of t and positions, as one of positions from `origin` on.
ScalarFunction seen_from(const ScalarFunction& function, const std::array<double, 3>& origin) {
  if (function.is_constant()) return function;
  return ScalarFunction(
      [function, origin](const std::vector<double>& arguments) {
        std::vector<double> moved = arguments;
        for (std::size_t i = 0; i < 3 && i + 1 < moved.size(); ++i) moved[i + 1] += origin[i];
        return function.at(moved);
      },
      function.source(), function.place());
}

/// Null where no pair has sharp edges on both sides. Collective.
/// @param reaches  [pairs of the scene]
std::shared_ptr<EdgeContact> make_edge_contact(const std::shared_ptr<const Bodies>& bodies, const Scene& scene, const std::vector<double>& reaches,
                                               double length, const Timers& timers) {
  std::vector<double> compliances;
  for (const BodyProperties& block : bodies->properties())
    compliances.push_back(block.is_rigid() ? 0.0 : (1.0 - std::pow(block.material->poissons_ratio, 2)) / block.material->youngs_modulus);
  EdgeSearch search(*bodies->mesh(), scene, compliances, reaches);
  if (!search.any()) return nullptr;
  std::vector<std::string> names;
  for (const auto& pair : scene.contact) names.push_back(pair.name);
  const auto displaced = [bodies, length](const Vector& displacement) {
    const PlaceOfNode at = current_places(*bodies, displacement);
    return PlacedBodies{*bodies->mesh(), at, body_boxes(*bodies->mesh(), at), length, touching_depth * length};
  };
  return std::make_shared<EdgeContact>(bodies, std::move(search), std::move(names), displaced, timers);
}

Effects effects_of(const Scene& scene, const Bodies& bodies) {
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
      if (!body.value.rigid.value) moving.push_back(body.name);
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

// Rings have no radius beyond the axis. Collective.
void refuse_beyond_axis(const Mesh& mesh, double length, const std::vector<Place>& places) {
  std::vector<double> mine(places.size(), 0.0), least(mine);
  for (LocalOrdinal node = 0; node < mesh.owned_body_count(); ++node) {
    const auto body = mesh.body_of_node[node];
    const bool is_rigid = mesh.bodies[body].is_surface;
    if (!is_rigid) mine[body] = std::min(mine[body], mesh.coordinates[node][0]);
  }
  Teuchos::reduceAll(*mesh.comm, Teuchos::REDUCE_MIN, static_cast<int>(mine.size()), mine.data(), least.data());
  std::vector<Diagnostic> diagnostics;
  for (std::size_t body = 0; body < places.size(); ++body)
    if (least[body] < -1e-9 * length)
      diagnostics.push_back({places[body], fmt::format("body '{}' reaches x = {:.6g}, beyond the axis of an axisymmetric scene; allowed: x >= 0",
                                                       mesh.bodies[body].name, least[body])});
  if (!diagnostics.empty()) throw InputError(diagnostics);
}

}  // namespace

Model::Model(const RCP<const Communicator>& comm, const Scene& scene, const Timers& timers) {
  const bool axisymmetric = scene.kinematics == Kinematics::axisymmetric;
  const InterfaceMeasure measure{axisymmetric, scene.thickness};
  std::vector<Adjustment> adjustments;
  {
    const auto timer = timers.scope("mesh");
    const RCP<Mesh> mesh = make_mesh(comm, scene, mesh_remarks_);
    // Ties move nodes by what is summed up over ranks, so that digits differ with their number.
    if (!scene.ties.empty()) mesh_digest_ = mortise::mesh_digest(*mesh);
    adjustments = adjust_slaves(*mesh, scene);
    if (!scene.ties.empty()) {
      SurfaceTies ties = tie_scene(*mesh, scene, held_nodes(*mesh, scene), measure, contact_origin(*mesh, mesh_size(*mesh).length, axisymmetric));
      supports_.ties = ties.tied;
      ties_at_start_ = std::move(ties.at_start);
    }
    mesh_ = mesh;
    size_ = mesh_size(*mesh_);
  }
  std::vector<Place> places;
  for (const auto& body : scene.bodies) places.push_back(body.place);
  if (axisymmetric) refuse_beyond_axis(*mesh_, size_.length, places);
  const auto bodies = std::make_shared<Bodies>(mesh_, scene.kinematics, scene.thickness, block_properties(scene, *mesh_));
  bodies_ = bodies;
  effects_ = effects_of(scene, *bodies_);

  parts_.dofs = bodies_->dofs();
  parts_.local_dofs = bodies_->local_dofs();
  parts_.bulk_graph = [bodies] { return bodies->graph(); };
  parts_.length = size_.length;
  parts_.near_null_space = [bodies = bodies_, apart = 1e6 * size_.length, joined = joined_bodies(*mesh_, scene)](const Vector& displacement) {
    const RCP<MultiVector> coordinates = current_coordinates(*bodies, displacement);
    const auto x = coordinates->getLocalViewHost(Tpetra::Access::ReadWrite);
    for (std::size_t node = 0; node < x.extent(0); ++node) x(node, 0) += apart * joined[bodies->mesh()->body_of_node[node]];
    return NearNullSpace{rigid_body_modes(*bodies, displacement), coordinates, apart};
  };
  parts_.contributions.push_back(std::make_shared<BulkContribution>(bodies, timers));

  Collector collect;
  for (const auto& load : scene.loads)
    collect([&] { parts_.contributions.push_back(std::make_shared<LoadContribution>(load.name, load.value.load.options->make(bodies_), timers)); });
  collect([&] { connectors_ = add_connectors(scene, bodies_, timers, parts_); });
  std::shared_ptr<const PrescribedMotion> motion;
  collect([&] {
    motion = std::make_shared<const PrescribedMotion>(*bodies_, scene.boundary_conditions);
    parts_.prescribed = std::make_shared<PrescribedBoundary>(motion);
  });
  std::vector<ContactPair> pairs;
  for (const auto& pair : scene.contact) {
    collect([&] { pairs.push_back(make_pair(*mesh_, *bodies_, pair, pair.value.slave, pair.value.master)); });
    if (pair.value.start.facets == FacetShape::round)
      collect([&] {
        const bool dual = pair.value.contact.formulation.options->coupling()->has_dual_gap(pair.value.contact.mortar.gap_weighting);
        pairs.back().facet_gaps = std::make_shared<const std::vector<double>>(gaps_of_round_surfaces(
            *mesh_, require_side_set(*mesh_, pair.value.slave), require_side_set(*mesh_, pair.value.master), reference_places(*mesh_), dual));
      });
  }
  for (std::size_t first = 0; first < scene.contact.size(); ++first) {  // second passes behind all pairs of the scene
    const auto& pair = scene.contact[first];
    if (!pair.value.contact.formulation.options->two_pass()) continue;
    collect([&] {
      pairs.push_back(make_pair(*mesh_, *bodies_, pair, pair.value.master, pair.value.slave));
      pairs.back().second_pass_of = first;
    });
  }
  collect([&] { parts_.linear_solver = make_linear_solver(scene.linear_solver, comm, timers, traits_of(scene, *parts_.dofs)); });
  collect.throw_found(*comm);
  if (!mesh_->reference_points.empty()) parts_.dependent = std::make_shared<TiedNodes>(*bodies_, parts_.prescribed->dofs());

  parts_.tied = with_inclined_supports(parts_.dofs, mesh_->dimension, supports_.ties, motion);
  supports_.prescribed = motion->dofs();
  supports_.fixed = marked_components(*mesh_, motion->dofs(), 1.0);
  supports_.inclined = motion->inclined();
  const std::vector<LocalOrdinal> inclined = held_dofs(supports_.inclined, mesh_->dimension);
  std::merge(motion->dofs().begin(), motion->dofs().end(), inclined.begin(), inclined.end(), std::back_inserter(supports_.dofs));

  // None of the dofs that follow or are tied is prescribed. A node that tied nodes follow carries no multiplier of contact: momentum there has forces
  // of ties, or of inclined supports.
  const auto kept = rcp(new MultiVector(*supports_.fixed, Teuchos::Copy));
  if (parts_.dependent) kept->update(1.0, *marked_components(*mesh_, parts_.dependent->dofs(), 2.0), 1.0);
  if (parts_.tied) {
    kept->update(1.0, *marked_components(*mesh_, parts_.tied->dofs, 2.0), 1.0);
    mark_crosspoints(followed_by_ties(*mesh_, *parts_.tied), *kept);
  }
  inertia_ = add_inertia(scene, bodies_, motion->dofs(), timers, parts_);
  if (const std::vector<double> weighing = weighing_masses_of(scene, *bodies_, inertia_); !weighing.empty()) bodies->set_point_masses(weighing);
  if (connectors_.springs) supports_.connectors.push_back(connectors_.springs);
  if (connectors_.dashpots && !scene.inertia.acts()) supports_.connectors.push_back(connectors_.dashpots);
  surfaces_at_start_ = examine_surfaces(*mesh_, scene, size_.length);
  for (std::size_t p = 0; p < scene.contact.size(); ++p)
    if (pairs[p].facet_gaps) surfaces_at_start_.pairs[p].facet_gaps = range_over_ranks(*comm, *pairs[p].facet_gaps);
  reach_for_clearances(*mesh_, scene, surfaces_at_start_);
  for (std::size_t p = 0; p < adjustments.size(); ++p) {
    surfaces_at_start_.pairs[p].adjusted = {adjustments[p].nodes, adjustments[p].largest};
    surfaces_at_start_.pairs[p].overlap_as_meshed = adjustments[p].overlap;
  }
  for (std::size_t p = 0; p < pairs.size(); ++p) take_up(surfaces_at_start_.pairs[pairs[p].second_pass_of.value_or(p)], pairs[p]);
  std::vector<HoldingPair> holding;
  for (const auto& pair : pairs)
    holding.push_back({&pair.slave, &pair.master, pair.options.mortar.search_reach.value_or(0.0), pair.options.friction.options->acts()});
  held_by_contact_only_.assign(mesh_->owned_count(), false);
  if (!scene.inertia.acts()) {  // mass balances what nothing holds
    const bool is_stabilised = scene.stabilisation.acts();
    const auto only_contact = check_held(*mesh_, axisymmetric, supports_, holding, places, is_stabilised);
    if (is_stabilised) stabilise(scene, only_contact, timers);
    for (LocalOrdinal node = 0; node < mesh_->owned_count() && !is_stabilised; ++node)
      held_by_contact_only_[node] = only_contact[mesh_->body_of_node[node]];
  }

  if (pairs.empty()) return;
  bodies_of_pairs_ = bodies_of(*mesh_, pairs);
  std::vector<double> reaches;
  for (std::size_t p = 0; p < scene.contact.size(); ++p)
    reaches.push_back(pairs[p].options.mortar.search_reach.value_or(surfaces_at_start_.pairs[p].longest));
  if (const auto edges = make_edge_contact(bodies_, scene, reaches, size_.length, timers)) {
    edges_ = edges;
    parts_.contributions.push_back(edges);
    parts_.bulk_graph = [edges, inner = parts_.bulk_graph] { return edges->graph(inner()); };
    parts_.bulk_version = [edges] { return edges->graph_version(); };
  }
  const std::array<double, 3> origin = contact_origin(*mesh_, size_.length, axisymmetric);
  for (ContactPair& pair : pairs)
    if (pair.options.clearance) pair.options.clearance = seen_from(*pair.options.clearance, origin);
  parts_.contact = std::make_shared<ContactSystem>(mesh_->owned_nodes, bodies_->dofs(), reference_positions(*mesh_, origin), kept, measure,
                                                   std::move(pairs), timers);
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
