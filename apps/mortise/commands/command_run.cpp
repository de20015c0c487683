#include <CLI/CLI.hpp>
#include <cstdio>
#include <iostream>
#include <memory>
#include <optional>
#include <string>

#include "declarations.hpp"
#include "launch.hpp"
#include "mortise/simulation/run/run.hpp"
#include "mortise/simulation/scene/read_scene.hpp"
#include "mortise/simulation/scene/scene.hpp"
#include "mortise/studies/picture.hpp"
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

namespace {

/// Seconds of "90", "90 s", "15 min", "2 h", "1:30:00"; none: it is no duration.
std::optional<double> seconds_of(const std::string& text) {
  double hours = 0.0, minutes = 0.0, seconds = 0.0;
  char unit[4] = "", beyond = 0;
  if (std::sscanf(text.c_str(), "%lf:%lf:%lf%c", &hours, &minutes, &seconds, &beyond) == 3) return 3600.0 * hours + 60.0 * minutes + seconds;
  const int read = std::sscanf(text.c_str(), "%lf %3[a-z]%c", &seconds, unit, &beyond);
  const std::string name = unit;
  if (read < 1 || read > 2 || !(seconds > 0.0)) return std::nullopt;
  if (name.empty() || name == "s")
    return read == 1 && text.find_first_not_of("0123456789.") != std::string::npos ? std::nullopt : std::optional(seconds);
  if (name == "min") return 60.0 * seconds;
  return name == "h" ? std::optional(3600.0 * seconds) : std::nullopt;
}

void add_restart_arguments(CLI::App& command, RunOptions& options) {
  command
      .add_option_function<std::string>(
          "--restart",
          [&options](const std::string& step) {
            options.restart = RestartOptions();
            if (!step.empty()) options.restart->step = std::stoi(step);
          },
          "go on with the run in the directory, from its newest checkpoint or from that of STEP")
      ->expected(0, 1)
      ->default_str("")
      ->type_name("STEP")
      ->check([](const std::string& step) {
        const bool good = step.size() < 10 && step.find_first_not_of("0123456789") == std::string::npos;
        return good ? std::string() : "\"" + step + "\" is no number of a step; the scene goes before --restart";
      });
  command
      .add_option_function<std::string>(
          "--time-limit", [&options](const std::string& text) { options.time_limit = seconds_of(text); },
          "stop after the last step that ends in time, with a checkpoint: 90 s, 15 min, 2 h or 1:30:00")
      ->type_name("TIME")
      ->check([](const std::string& text) {
        return seconds_of(text) ? std::string() : "\"" + text + "\" is no time; please say 90 s, 15 min, 2 h or 1:30:00";
      });
}

/// Draws the last step beside the results. They are complete: a failure of the drawing is reported and changes nothing.
void draw_results(const Program& program, const RunOptions& options) {
  PictureOptions picture;
  picture.run = options.directory.empty() ? default_directory(options.scene) : options.directory;
  std::string hindered = "no python3 with matplotlib and h5py; please install python3-matplotlib and python3-h5py (Debian)";
  try {
    if (const auto drawn = draw_picture(program.comm, picture)) {
      if (options.verbosity != Verbosity::quiet) print(program, *drawn + "\n");
      return;
    }
  } catch (const FileError& error) {  // on every rank
    hindered = error.what();
  }
  if (program.is_first_rank()) std::cerr << "warning: no picture: " << hindered << std::endl;
}

}  // namespace

void add_run_command(CLI::App& app, Program& program) {
  auto* command = app.add_subcommand("run", "run a scene");
  const auto options = std::make_shared<RunOptions>();
  options->version = version();
  options->supervised = true;
  if (const auto together = started_together()) options->launcher = together->launcher;
  add_input_arguments(*command, "SCENE", "scene file", *options);
  add_output_arguments(*command, "SCENE", *options);
  add_restart_arguments(*command, *options);
  const auto picture = std::make_shared<bool>(false);
  command->add_flag("--picture", *picture, "draw the last step at the end: picture.png, as `mortise picture` does");
  command->footer(
      "Leaves summary.json, newton.csv, history.csv, fields.xdmf, fields/, effective.xml and log.txt.\n"
      "Example: mpirun -n 2 mortise run inputs/paper/hertz_elastic.xml --set variables/n=8 -o fine");
  command->callback([&program, options, picture] {
    const auto scene = read_before(program, options);
    program.action = [&program, options, scene, picture] {
      const ExitCode code = run_scene(program.comm, *scene, *options);
      if (*picture) draw_results(program, *options);
      return code;
    };
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
