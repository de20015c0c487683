#include <CLI/CLI.hpp>
#include <memory>

#include "declarations.hpp"
#include "mortise/simulation/run/run.hpp"
#include "mortise/simulation/scene/read_scene.hpp"
#include "mortise/simulation/scene/scene.hpp"
#include "program.hpp"

namespace mortise {
namespace {

/// The scene of a command, which is empty until the program has read it.
std::shared_ptr<Scene> read_before(Program& program, const std::shared_ptr<RunOptions>& options) {
  const auto scene = std::make_shared<Scene>();
  program.read = [&program, options, scene] { *scene = read_scene(*program.comm, options->scene, options->settings); };
  return scene;
}

}  // namespace

void add_input_arguments(CLI::App& command, const std::string& file, const std::string& meaning, RunOptions& options) {
  command.add_option(file, options.scene, meaning)->required()->type_name(xml_value);
  add_settings(command, options.settings);
}

void add_output_arguments(CLI::App& command, const std::string& file, RunOptions& options) {
  add_directory(command, options.directory, "directory for the results; default: results/<name of the file " + file + ">");
  command.add_flag("--keep", options.keep, "refuse a directory that holds results, instead of replacing them");
  auto* quiet = command.add_flag_callback(
      "--quiet", [&options] { options.verbosity = Verbosity::quiet; }, "say nothing but warnings and errors");
  command
      .add_flag_callback(
          "--verbose", [&options] { options.verbosity = Verbosity::verbose; }, "say more, such as where the time went")
      ->excludes(quiet);
}

void add_run_command(CLI::App& app, Program& program) {
  auto* command = app.add_subcommand("run", "run a scene");
  const auto options = std::make_shared<RunOptions>();
  options->version = version();
  add_input_arguments(*command, "SCENE", "scene file", *options);
  add_output_arguments(*command, "SCENE", *options);
  command->footer(
      "Leaves summary.json, newton.csv, history.csv, fields.xdmf, fields/, effective.xml and log.txt.\n"
      "Example: mpirun -n 2 mortise run inputs/paper/hertz_elastic.xml --set variables/n=8 -o fine");
  command->callback([&program, options] {
    const auto scene = read_before(program, options);
    program.action = [&program, options, scene] { return run_scene(program.comm, *scene, *options); };
  });
}

void add_check_command(CLI::App& app, Program& program) {
  auto* command = app.add_subcommand("check", "read a scene, build its meshes, say its effects, sizes and memory; solve nothing");
  const auto options = std::make_shared<RunOptions>();
  add_input_arguments(*command, "SCENE", "scene file", *options);
  command->callback([&program, options] {
    const auto scene = read_before(program, options);
    program.action = [&program, options, scene] { return inspect_scene(program.comm, *scene, *options), ExitCode::done; };
  });
}

}  // namespace mortise
