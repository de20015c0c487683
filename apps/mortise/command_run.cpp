#include <memory>

#include "mortise/simulation/run.hpp"
#include "program.hpp"

namespace mortise {
namespace {

void add_scene_arguments(CLI::App& command, RunOptions& options) {
  command.add_option("SCENE", options.scene, "scene file")->required();
  command.add_option("--set", options.settings, "replace a value of the scene: path=value, e.g. variables/n=16; may be repeated")
      ->type_name("PATH=VALUE")
      ->allow_extra_args(false);
}

}  // namespace

void add_run_command(CLI::App& app, Program& program) {
  auto* command = app.add_subcommand("run", "run a scene");
  const auto options = std::make_shared<RunOptions>();
  options->version = MORTISE_VERSION;
  add_scene_arguments(*command, *options);
  command->add_option("-o,--output", options->directory, "directory for the results; default: results/<name of the scene file>")->type_name("DIR");
  command->add_flag("--keep", options->keep, "refuse a directory that holds results, instead of replacing them");
  auto* quiet = command->add_flag_callback(
      "--quiet", [options] { options->verbosity = Verbosity::quiet; }, "say nothing but warnings and errors");
  command
      ->add_flag_callback(
          "--verbose", [options] { options->verbosity = Verbosity::verbose; }, "say where the time went")
      ->excludes(quiet);
  command->footer(
      "Leaves summary.json, newton.csv, history.csv, fields.xdmf, fields.h5, effective.xml and log.txt.\n"
      "Example: mpirun -n 2 mortise run inputs/paper/hertz_elastic.xml --set variables/n=8 -o fine");
  command->callback([&program, options] { program.action = [&program, options] { return run_scene(program.comm, *options); }; });
}

void add_check_command(CLI::App& app, Program& program) {
  auto* command = app.add_subcommand("check", "read a scene, build its meshes, say its effects, sizes and memory; solve nothing");
  const auto options = std::make_shared<RunOptions>();
  add_scene_arguments(*command, *options);
  command->callback([&program, options] { program.action = [&program, options] { return inspect_scene(program.comm, *options), ExitCode::done; }; });
}

}  // namespace mortise
