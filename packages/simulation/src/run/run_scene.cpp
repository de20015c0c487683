#include <filesystem>

#include "run/scene_run.hpp"

namespace mortise {

std::string default_directory(const std::string& file) { return "results/" + std::filesystem::path(file).stem().string(); }

ExitCode run_scene(const RCP<const Communicator>& comm, const Scene& scene, const RunOptions& options) { return Run(comm, scene, options).execute(); }

}  // namespace mortise
