#include "model/report_model.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_CrsGraph.hpp>
#include <algorithm>

#include "model/heat/heat_warnings.hpp"
#include "mortise/core/memory.hpp"
#include "mortise/mesh/file_mesh.hpp"
#include "mortise/simulation/model/memory_estimate.hpp"
#include "mortise/simulation/model/mesh_limits.hpp"
#include "mortise/simulation/scene/scene_bodies.hpp"

namespace mortise {
namespace {

/// MiB over all ranks.
struct MemoryEstimate {
  double so_far = 0.0;          ///< largest size until now, with the program and its libraries
  double linear_systems = 0.0;  ///< memory of the linear systems at their largest, by the solver of the model: rough
};

/// Collective.
MemoryEstimate estimated_memory(const Model& model) {
  constexpr double mib = 1024.0 * 1024.0;
  const Communicator& comm = *model.mesh()->comm;
  MemoryEstimate estimate;
  Teuchos::reduceAll(comm, Teuchos::REDUCE_SUM, peak_memory_mib(), Teuchos::outArg(estimate.so_far));
  const int dimension = model.mesh()->dimension;
  const double entries = static_cast<double>(model.parts().bulk_graph()->getGlobalNumEntries());
  const SystemSize size{dimension, static_cast<double>(model.mesh()->owned_nodes->getGlobalNumElements()), entries / (dimension * dimension),
                        comm.getSize() > 1};
  const bool iterative = model.parts().linear_solver->tolerances().has_value();
  estimate.linear_systems = (iterative ? multigrid_bytes(size) : factorisation_bytes(size)) / mib;
  return estimate;
}

/// "floor, hole (nodes), surface": what a scene may name of a body from a file.
std::string sets_of(const Mesh& mesh, const std::string& body) {
  std::vector<std::string> names;
  for (const auto& [name, nodes] : mesh.node_sets) {
    if (name.rfind(body + "/", 0) != 0) continue;
    names.push_back(name.substr(body.size() + 1) + (mesh.side_sets.count(name) > 0 ? "" : " (nodes)"));
  }
  return fmt::format("{}", fmt::join(names, ", "));
}

/// Time integration, mass that contact nodes gave away, and choices that lose accuracy.
void report_inertia(const Scene& scene, const Model& model, RunLog& log) {
  const InertiaOptions& inertia = scene.inertia;
  if (!inertia.acts()) return;
  const InertiaOfModel& mass = model.inertia();
  const bool is_over_step = inertia.time_scheme().balance == TimeScheme::Balance::over_step;
  if (mass.without_mass > 0)
    log.info(fmt::format("  {} nodes of contact surfaces give their mass to interior nodes; centres of mass move by up to {:.3g}", mass.without_mass,
                         mass.centre_shift));
  if (mass.kept > 0)
    log.info(
        fmt::format("  {} nodes of contact surfaces keep their mass: they follow reference points, or have no interior node beside them", mass.kept));
  const bool keeps_energy = inertia.contact_condition == InertiaOptions::ContactCondition::gap_rate;  // for which it has to be 1
  if (!scene.contact.empty() && inertia.radius_at_infinity() > 0.95 && !keeps_energy)
    log.warning(
        fmt::format("time integration with a spectral radius of {:.3g} hardly damps high frequencies, so that contact forces ring; please take "
                    "\"generalised alpha\" with a \"spectral radius\" of 0.8, or at most 0.95",
                    inertia.radius_at_infinity()));
  for (const std::string& name : inertia.idle_parameters())
    log.warning(fmt::format("\"{}\" has no effect with this \"scheme\"; please remove it, or take its scheme", name));
  const auto& points = model.mesh()->reference_points;
  const auto& prescribed = model.supports().prescribed;
  int turning_here = 0, turning = 0;
  for (const ReferencePoint& point : points)
    if (point.rotation_node >= 0 && point.rotation_node < model.mesh()->owned_count() &&
        !std::binary_search(prescribed.begin(), prescribed.end(), model.space().row(point.rotation_node, 0)))
      turning_here = 1;
  Teuchos::reduceAll(*model.mesh()->comm, Teuchos::REDUCE_MAX, turning_here, Teuchos::outArg(turning));
  if (turning > 0 && is_over_step)
    log.warning(
        "bodies turn with reference points: \"balance\" \"over the step\" is of first order in the step for them; please take \"at the end\"");
}

}  // namespace

void report_model(const std::string& file, const Scene& scene, const Model& model, RunLog& log) {
  log.info(fmt::format("{}: {}, {}", file, scene.name, to_string(scene.kinematics)));
  for (const auto& [effect, members] : model.effects())
    if (!members.empty()) log.info(fmt::format("  {}: {}", effect, fmt::join(members, ", ")));
  const Mesh& mesh = *model.mesh();
  for (const std::string& note : model.mesh_remarks().notes) log.info("  mesh of " + note);
  for (const std::string& warning : model.mesh_remarks().warnings) log.warning("mesh of " + warning);
  for (std::size_t b = 0; b < mesh.blocks.size(); ++b) {
    const Block& block = mesh.blocks[b];
    const BodyOptions& body = scene.bodies[static_cast<std::size_t>(block.body)].value;
    const std::string name = mesh.body_of(block).name + (block.part.empty() ? "" : ", " + block.part);
    if (mesh.body_of(block).is_surface)
      log.info(fmt::format("  body {}: rigid, {} facets", name, model.size().elements_of_block[b]));
    else
      log.info(fmt::format("  body {}: {} elements {}, {}", name, model.size().elements_of_block[b], to_string(element_of(body, block.shape)),
                           material_name(body, block.part)));
  }
  for (const auto& body : scene.bodies)
    if (dynamic_cast<const FileMesh*>(body.value.mesh.options.get()) != nullptr)
      log.info(fmt::format("  sets of {}: {}", body.name, sets_of(mesh, body.name)));
  for (std::size_t t = 0; t < scene.ties.size(); ++t) {
    const TieAtStart& tie = model.ties_at_start()[t];
    const std::string open = tie.open > 0 ? fmt::format(", {} are free, as no master covers them within {:.3g}", tie.open, tie.tolerance) : "";
    const std::string moved = tie.moved > 0 ? fmt::format(", {} were moved, by up to {:.3g}", tie.moved, tie.furthest) : "";
    log.info(fmt::format("  tie {}: {} slave nodes follow the master{}{}", scene.ties[t].name, tie.tied, open, moved));
  }
  report_inertia(scene, model, log);
  for (const std::string& warning : heat_warnings(scene, model)) log.warning(warning);
  if (scene.stabilisation.acts() && !model.connectors().stabilisation)
    log.warning("supports, ties and springs hold all bodies, so that stabilisation has no effect; please remove the list \"stabilisation\"");
  log.info(fmt::format("  {} dofs, {} slave nodes, {} on {} rank(s)", model.dofs(), model.slave_nodes(), model.parts().linear_solver->name(),
                       model.mesh()->comm->getSize()));
}

void report_memory(const Model& model, RunLog& log) {
  const Communicator& comm = *model.mesh()->comm;
  const MemoryEstimate memory = estimated_memory(model);
  const double all = memory.so_far + memory.linear_systems;
  log.info(fmt::format("  about {:.0f} MiB: {:.0f} until here, {:.0f} for the linear systems", all, memory.so_far, memory.linear_systems));
  if (const double there = memory_of_machines(comm); there > 0.0 && all > there)
    log.warning(
        fmt::format("that is more than the {:.0f} MiB here{}; please make the meshes coarser, take another solver, or run it on more machines", there,
                    comm.getSize() > 1 ? ", of all machines together" : ""));
}

}  // namespace mortise
