#include "model/stages/contact_model.hpp"

#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_MultiVector.hpp>
#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <cmath>
#include <limits>

#include "model/current_places.hpp"
#include "model/edge_contact.hpp"
#include "model/pairs/search_reach.hpp"
#include "model/pairs/surface_ties.hpp"
#include "model/precision.hpp"
#include "mortise/material/materials.hpp"
#include "mortise/mesh/sets.hpp"
#include "mortise/simulation/model/hold_check.hpp"
#include "surfaces/body_surfaces.hpp"
#include "surfaces/rounded_facets.hpp"

namespace mortise {
namespace {

/// From `origin` on.
RCP<MultiVector> reference_positions(const Mesh& mesh, const std::array<double, 3>& origin) {
  const auto positions = rcp(new MultiVector(mesh.owned_nodes, static_cast<std::size_t>(mesh.dimension)));
  const auto view = positions->getLocalViewHost(Tpetra::Access::OverwriteAll);
  for (LocalOrdinal node = 0; node < mesh.owned_count(); ++node)
    for (int i = 0; i < mesh.dimension; ++i) view(node, i) = mesh.coordinates[node][i] - origin[i];
  return positions;
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

/// Where pairs may not have a multiplier, or not all of it. None of the dofs that follow or are tied is prescribed. What tied nodes follow carries no
/// multiplier of contact: momentum there has forces of ties, or of inclined supports.
RCP<const MultiVector> kept_components(const FieldSpace& space, const SolidModel& solid) {
  const auto kept = rcp(new MultiVector(*solid.supports.fixed, Teuchos::Copy));
  if (solid.parts.rigid) kept->update(1.0, *marked_components(space, solid.parts.rigid->dofs(), 2.0), 1.0);
  if (const AffineConstraints& constraints = *solid.parts.constraints; !constraints.T().is_null()) {
    kept->update(1.0, *marked_components(space, constraints.dependent(), 2.0), 1.0);
    mark_crosspoints(followed_by_dependents(space, constraints), *kept);
  }
  return kept;
}

/// Collective. Gives pairs what they need at the start.
SurfacesAtStart surfaces_of(const MeshedScene& meshed, const Scene& scene, std::vector<ContactPair>& pairs) {
  const Mesh& mesh = *meshed.mesh;
  SurfacesAtStart at_start = examine_surfaces(mesh, scene, meshed.size.length);
  for (std::size_t p = 0; p < scene.contact.size(); ++p)
    if (pairs[p].facet_gaps) at_start.pairs[p].facet_gaps = range_over_ranks(*mesh.comm, *pairs[p].facet_gaps);
  reach_for_clearances(mesh, scene, at_start);
  for (std::size_t p = 0; p < meshed.adjustments.size(); ++p) {
    at_start.pairs[p].adjusted = {meshed.adjustments[p].nodes, meshed.adjustments[p].largest};
    at_start.pairs[p].overlap_as_meshed = meshed.adjustments[p].overlap;
  }
  for (std::size_t p = 0; p < pairs.size(); ++p) take_up(at_start.pairs[pairs[p].second_pass_of.value_or(p)], pairs[p]);
  return at_start;
}

/// [mesh.bodies] Whether nothing but contact holds them. Throws InputError for bodies that nothing holds and nothing stabilises. Collective.
std::vector<char> held_by_contact_only(const MeshedScene& meshed, const Scene& scene, const Supports& supports,
                                       const std::vector<ContactPair>& pairs) {
  if (scene.inertia.acts()) return std::vector<char>(meshed.mesh->bodies.size(), 0);  // mass balances what nothing holds
  std::vector<HoldingPair> holding;
  for (const auto& pair : pairs)
    holding.push_back({&pair.slave, &pair.master, pair.options.mortar.search_reach.value_or(0.0), pair.options.friction.options->acts()});
  return check_held(*meshed.space, scene.kinematics == Kinematics::axisymmetric, supports, holding, meshed.places, scene.stabilisation.acts());
}

}  // namespace

std::vector<ContactPair> make_pairs(const MeshedScene& meshed, const Bodies& bodies, const Scene& scene, Collector& collect) {
  const Mesh& mesh = *meshed.mesh;
  std::vector<ContactPair> pairs;
  for (const auto& pair : scene.contact) {
    collect([&] { pairs.push_back(make_pair(mesh, bodies, pair, pair.value.slave, pair.value.master)); });
    if (pair.value.start.facets == FacetShape::round)
      collect([&] {
        const bool dual = pair.value.contact.formulation.options->coupling()->has_dual_gap(pair.value.contact.mortar.gap_weighting);
        pairs.back().facet_gaps = std::make_shared<const std::vector<double>>(gaps_of_round_surfaces(
            mesh, require_side_set(mesh, pair.value.slave), require_side_set(mesh, pair.value.master), reference_places(mesh), dual));
      });
  }
  for (std::size_t first = 0; first < scene.contact.size(); ++first) {
    const auto& pair = scene.contact[first];
    if (!pair.value.contact.formulation.options->two_pass()) continue;
    collect([&] {
      pairs.push_back(make_pair(mesh, bodies, pair, pair.value.master, pair.value.slave));
      pairs.back().second_pass_of = first;
    });
  }
  return pairs;
}

ContactModel make_contact(const MeshedScene& meshed, const SolidModel& solid, const Scene& scene, std::vector<ContactPair> pairs,
                          const Timers& timers) {
  const Mesh& mesh = *meshed.mesh;
  ContactModel contact;
  const RCP<const MultiVector> kept = kept_components(*meshed.space, solid);
  contact.at_start = surfaces_of(meshed, scene, pairs);
  contact.held_by_contact_only = held_by_contact_only(meshed, scene, solid.supports, pairs);
  if (pairs.empty()) return contact;
  contact.bodies_of_pairs = bodies_of(mesh, pairs);
  std::vector<double> reaches;
  for (std::size_t p = 0; p < scene.contact.size(); ++p)
    reaches.push_back(pairs[p].options.mortar.search_reach.value_or(contact.at_start.pairs[p].longest));
  contact.edges = make_edge_contact(solid.bodies, scene, reaches, meshed.size.length, timers);
  const std::array<double, 3> origin = contact_origin(mesh, meshed.size.length, scene.kinematics == Kinematics::axisymmetric);
  for (ContactPair& pair : pairs) {
    pair.has_conditions_on_rate = scene.inertia.contact_condition == InertiaOptions::ContactCondition::gap_rate;
    if (pair.options.clearance) pair.options.clearance = seen_from(*pair.options.clearance, origin);
  }
  std::vector<NodalField> further;
  for (std::size_t field = 1; field < meshed.space->field_count(); ++field) further.push_back(meshed.space->field(field));
  contact.system = std::make_shared<ContactSystem>(meshed.space->field(0), meshed.space->dofs(), reference_positions(mesh, origin), kept,
                                                   measure_of(scene), std::move(pairs), timers, std::move(further));
  return contact;
}

}  // namespace mortise
