#include "run/restart/restart.hpp"

#include <fmt/format.h>

#include <Tpetra_Vector.hpp>
#include <algorithm>

#include "mortise/mesh/digest.hpp"
#include "run/restart/checkpoints.hpp"
#include "run/restart/scene_changes.hpp"

namespace mortise {
namespace {

constexpr double same_loads = 1e-9;  ///< relative: what another order of sums leaves

[[noreturn]] void refuse(const Restart& restart, const std::string& file, std::vector<std::string> reasons) {
  std::vector<Diagnostic> diagnostics;
  for (std::string& reason : reasons) diagnostics.push_back({{file, 0, ""}, std::move(reason)});
  diagnostics.push_back(
      {{file, 0, ""},
       fmt::format("cannot go on from {}, which was written for another scene; what may change is {}. Please undo the other changes, "
                   "or run the scene without --restart",
                   restart.path, what_may_change())});
  throw InputError(std::move(diagnostics));
}

}  // namespace

Restart restart_from(const RCP<const Communicator>& comm, const std::string& directory, std::optional<int> from_step) {
  FoundCheckpoint found = find_checkpoint(*comm, directory, from_step);
  Restart restart{found.step, found.path, std::move(found.damaged), std::make_shared<CheckpointReader>(comm, found.path)};
  int step = 0;
  serialize(*restart.file, "steps", step);
  if (step != restart.step)
    throw FileError(fmt::format("{} is the checkpoint of step {}; please give it its name, or move it away", restart.path, step));
  return restart;
}

void store_run(StateArchive& archive, const std::string& fingerprint, const Model& model, const SemiSmoothSystem& system,
               const StepEvaluation& evaluation, const SteppingState& state) {
  std::string scene = fingerprint, mesh = model.mesh_digest();
  archive.text("scene", scene);
  archive.text("mesh", mesh);
  store(archive, system, state);
  serialize(archive, "external_force", "dofs", *evaluation.external_force(*state.accepted.x, state.accepted.context.time));
}

SteppingState restore_run(const Restart& restart, const Scene& scene, const std::string& file, const Model& model, const SemiSmoothSystem& system,
                          const StepEvaluation& evaluation) {
  StateArchive& archive = *restart.file;
  std::string before, mesh;
  archive.text("scene", before);
  archive.text("mesh", mesh);
  if (std::vector<std::string> changes = refused_changes(before, scene_fingerprint(scene)); !changes.empty())
    refuse(restart, file, std::move(changes));
  if (mesh != model.mesh_digest()) refuse(restart, file, {"the mesh is another"});

  SteppingState state = restore_stepping(archive, system);
  const double time = state.accepted.context.time;
  if (time > scene.stepping.end_time)
    throw InputError({file, 0, "stepping"},
                     fmt::format("\"end time\" is {}, before that of the checkpoint {}, {}", scene.stepping.end_time, restart.path, time));
  if (const double deviation = system.prescribed_deviation(*state.accepted.x, time); deviation > scene.newton.increment_tolerance)
    refuse(restart, file,
           {fmt::format("prescribed displacements at time {}, that of the checkpoint, differ by {:.2g} of the model's size", time, deviation)});
  Vector force(*evaluation.external_force(*state.accepted.x, time), Teuchos::Copy), stored(force.getMap());
  serialize(archive, "external_force", "dofs", stored);
  const double largest = std::max(force.normInf(), stored.normInf());
  force.update(-1.0, stored, 1.0);
  if (force.normInf() > same_loads * largest)
    refuse(restart, file, {fmt::format("loads at time {}, that of the checkpoint, differ by up to {:.3g} at a node", time, force.normInf())});
  return state;
}

void report_restart(const Restart& restart, RunLog& log) {
  for (const std::string& damaged : restart.damaged) log.warning(fmt::format("not whole, and left out: {}", damaged));
  log.info(fmt::format("goes on from {}", restart.path));
}

}  // namespace mortise
