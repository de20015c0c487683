#include "model/stages/meshed_scene.hpp"

#include <fmt/format.h>

#include <Teuchos_CommHelpers.hpp>
#include <algorithm>

#include "model/heat/heat_of_scene.hpp"
#include "model/precision.hpp"
#include "model/stages/collector.hpp"
#include "mortise/mesh/build_mesh.hpp"
#include "mortise/mesh/digest.hpp"
#include "mortise/simulation/model/mesh_limits.hpp"
#include "mortise/simulation/scene/scene_bodies.hpp"
#include "mortise/solid/bodies.hpp"

namespace mortise {
namespace {

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
  remarks.warnings.insert(remarks.warnings.end(), mesh->warnings.begin(), mesh->warnings.end());
  add_sets(*mesh, scene.sets);
  tie(*mesh, scene);
  return mesh;
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

InterfaceMeasure measure_of(const Scene& scene) { return {scene.kinematics == Kinematics::axisymmetric, scene.thickness}; }

MeshedScene mesh_scene(const RCP<const Communicator>& comm, const Scene& scene, const Timers& timers) {
  const bool axisymmetric = scene.kinematics == Kinematics::axisymmetric;
  MeshedScene meshed;
  {
    const auto timer = timers.scope("mesh");
    const RCP<Mesh> mesh = make_mesh(comm, scene, meshed.remarks);
    meshed.space = space_of_scene(mesh, scene);
    // Ties move nodes by what is summed up over ranks, so that digits differ with their number.
    if (!scene.ties.empty()) meshed.digest = mesh_digest(*mesh);
    meshed.adjustments = adjust_slaves(*mesh, scene);
    if (!scene.ties.empty())
      meshed.ties = tie_scene(*mesh, *meshed.space, scene, held_nodes(*mesh, scene), measure_of(scene),
                              contact_origin(*mesh, mesh_size(*mesh).length, axisymmetric));
    meshed.mesh = mesh;
    meshed.size = mesh_size(*mesh);
  }
  for (const auto& body : scene.bodies) meshed.places.push_back(body.place);
  if (axisymmetric) refuse_beyond_axis(*meshed.mesh, meshed.size.length, meshed.places);
  return meshed;
}

}  // namespace mortise
