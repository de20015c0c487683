#include <fmt/format.h>

#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <filesystem>

#include "model/contact_at_start.hpp"
#include "model/motion/initial_state.hpp"
#include "model/precision.hpp"
#include "model/report_model.hpp"
#include "mortise/input/parameter_tree.hpp"
#include "mortise/io/files.hpp"
#include "mortise/mesh/file_mesh.hpp"
#include "run/diagnosis/static_guards.hpp"
#include "run/path/transient_guards.hpp"
#include "run/restart/scene_changes.hpp"
#include "run/scene_run.hpp"
#include "run/watches/watches.hpp"

namespace mortise {
namespace {

OutputDirectory directory_of(const RCP<const Communicator>& comm, const RunOptions& options) {
  return OutputDirectory(comm, options.directory.empty() ? default_directory(options.scene) : options.directory,
                         {"run", options.scene, options.directory.empty()}, options.keep && !options.restart);
}

std::string effective_xml(const Scene& scene) {
  return to_scene_xml(collect_parameters(scene.name, scene, CollectParameters::What::values), symbol_lists(scene.symbols));
}

/// What a run of the same directory left makes room for the next: a mesh file among it would be gone.
void refuse_meshes_in(const Scene& scene, const std::string& directory) {
  namespace fs = std::filesystem;
  std::error_code error;
  const fs::path results = fs::weakly_canonical(directory, error);
  for (const auto& body : scene.bodies) {
    const auto* mesh = dynamic_cast<const FileMesh*>(body.value.mesh.options.get());
    if (mesh == nullptr) continue;
    const fs::path file = fs::weakly_canonical(mesh->file.value, error);
    if (std::mismatch(results.begin(), results.end(), file.begin(), file.end()).first == results.end())
      throw InputError(
          mesh->file.place,
          fmt::format("the mesh file {} lies in the directory of the results, {}, where a run replaces what it made; please move it, or give another "
                      "directory (-o)",
                      file.string(), directory));
  }
}

}  // namespace

Run::Run(const RCP<const Communicator>& comm, const Scene& scene, const RunOptions& options)
    : comm_(comm),
      scene_(scene),
      options_(options),
      log_(comm, options.verbosity),
      watchdog_(options.supervised ? std::optional<Watchdog>(std::in_place, *comm) : std::nullopt),
      directory_(directory_of(comm, options)),
      model_(comm, scene, timers_),
      system_(make_system()),
      evaluation_(scene, model_, system_),
      preparation_(model_, scene, system_) {
  record_.scene = options.scene;
  record_.version = options.version;
  record_.settings = options.settings;
  record_.quantity_order = evaluation_.names();
}

SemiSmoothSystem Run::make_system() {
  SystemParts parts = model_.parts();
  const auto say = [this](const std::string& line) { log_.info(line); };
  const auto warn = [this](const std::string& line) { log_.warning(line); };
  guards_ = watches(model_, scene_, warn);
  const StepGuards of_analysis =
      scene_.inertia.acts() ? transient_guards(model_, scene_, warn) : static_guards({model_, scene_, timers_, say, warn}, parts);
  guards_.insert(guards_.end(), of_analysis.begin(), of_analysis.end());
  return SemiSmoothSystem(std::move(parts), timers_);
}

void Run::restore() {
  if (!options_.restart) return;
  restart_ = restart_from(comm_, directory_.path(), options_.restart->step);
  state_ = restore_run(*restart_, scene_, options_.scene, model_, system_, evaluation_);
  serialize_memory(*restart_->file);
}

void Run::open_results() {
  refuse_meshes_in(scene_, directory_.path());
  // From here on the scene is one that can be run: only now is anything made, and what an earlier run left makes room.
  if (restart_)
    directory_.continue_run();
  else
    directory_.begin_run();
  log_.open(directory_.claim("log.txt"), restart_.has_value());
  report_start();
  write_file(*comm_, directory_.claim("effective.xml"), [&] { return effective_xml(scene_); });
  record_.parts.push_back(part_text(record_.steps, comm_->getSize()));
  output_.emplace(comm_, scene_, directory_, model_.mesh(), evaluation_, log_, record_, timers_, restart_ ? restart_->file.get() : nullptr);
  if (restart_) remove_checkpoints_after(*comm_, directory_.path(), restart_->step);
}

void Run::report_start() {
  if (restart_) report_restart(*restart_, log_);
  report_model(options_.scene, scene_, model_, log_);
  report_precision(model_, scene_, log_);
  if (!restart_) report_contact_at_start(model_, scene_, log_);
  report_memory(model_, log_);
}

void Run::begin_steps() {
  if (!state_) {
    for (const std::string& warning : jumps_at_start(scene_, model_)) log_.warning(warning);
    state_.emplace(initial_state(scene_, model_, system_));
  }
  const double time = state_->accepted.context.time;
  state_->accepted = preparation_.prepared(std::move(state_->accepted), time);
  requests_.emplace(options_.supervised, options_.time_limit, begin_);
  checkpoints_.emplace(comm_, scene_.output.checkpoints, directory_);
  fingerprint_ = scene_fingerprint(scene_);
}

}  // namespace mortise
