#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <memory>

#include "declarations.hpp"
#include "mortise/studies/picture.hpp"
#include "program.hpp"

namespace mortise {
namespace {

/// Empty if a view is a name or a direction.
std::string wrong_view(const std::string& view) {
  for (const char* name : {"iso", "x", "-x", "y", "-y", "z", "-z"})
    if (view == name) return {};
  double x = 0.0, y = 0.0, z = 0.0;
  char beyond = 0;
  const bool read = std::sscanf(view.c_str(), "%lf,%lf,%lf%c", &x, &y, &z, &beyond) == 3;
  const double length = std::hypot(x, y, z);
  if (read && std::isfinite(length) && length > 0.0) return {};
  return "\"" + view + "\" is no view; please say iso, x, -x, y, -y, z, -z, or a direction toward the eye, as 1,-2,1";
}

std::string wrong_factor(const std::string& text) {
  double factor = 0.0;
  char beyond = 0;
  const bool good = std::sscanf(text.c_str(), "%lf%c", &factor, &beyond) == 1 && std::isfinite(factor) && factor >= 0.0;
  return good ? "" : "has to be a number from 0 on, not " + text;
}

std::string wrong_step(const std::string& text) {
  const bool good = !text.empty() && text.size() < 10 && text.find_first_not_of("0123456789") == std::string::npos;
  return good ? "" : "has to be the number of a step, not " + text;
}

}  // namespace

void add_picture_command(CLI::App& app, Program& program) {
  auto* command = app.add_subcommand("picture", "draw a run: a field on the deformed mesh, all steps of it, or contact along a surface");
  const auto options = std::make_shared<PictureOptions>();
  command->add_option("RUN", options->run, "directory of the run's results")->required()->type_name(directory_value);
  auto* field =
      command
          ->add_option("--field", options->field,
                       "what the colours show: a field that the run wrote, a part of it as displacement.y or cauchy_stress.xx, von_mises, or "
                       "body; default: von Mises' stress, else the displacement")
          ->type_name("FIELD");
  command->add_option("--step", options->step, "number of the step; default: the last one that has fields")
      ->type_name("STEP")
      ->check(CLI::Validator(wrong_step, ""));
  auto* warp = command->add_option("--warp", options->warp, "factor of displacements; default: 1 if they show, else what makes them show")
                   ->type_name("FACTOR")
                   ->check(CLI::Validator(wrong_factor, ""));
  auto* view =
      command
          ->add_option("--view", options->view,
                       "in 3D, from where: iso, x, -x, y, -y, z, -z, or a direction toward the eye as 1,-2,1; default: iso, of contact fields "
                       "the side that shows the slave surface")
          ->type_name("VIEW")
          ->check(CLI::Validator(wrong_view, ""));
  auto* profile =
      command->add_option("--profile", options->profile, "pressure and shear along the slave surface of this contact pair (2D)")->type_name("PAIR");
  auto* steps = command->add_flag("--steps", options->all_steps, "all steps: an animation (.gif), or a picture of each step (.png)");
  command
      ->add_option("-o,--output", options->output, "file to write; default: picture.png, with --steps picture.gif, with --profile profile.png in RUN")
      ->type_name("IMAGE")
      ->check(CLI::Validator([](const std::string& name) { return name.empty() ? "the name of the file is empty" : ""; }, ""));
  steps->excludes(command->get_option("--step"));
  for (auto* other : {field, warp, view, steps}) profile->excludes(other);
  command->footer(
      "Needs python3 with matplotlib and h5py; an animation needs Pillow too. An image that this program did not make is not replaced.\n"
      "Exit codes: 2 for a field, step or pair that the run does not have; 5 for results that are missing or damaged.\n"
      "Examples: mortise picture results/hertz_elastic --field cauchy_stress.yy -o stress.png\n"
      "          mortise picture results/conical_extrusion --steps");
  command->callback([&program, options] {
    program.uses_mpi = false;
    program.action = [&program, options] {
      const auto said = draw_picture(program.comm, *options);
      if (!said)
        throw FileError("cannot draw " + options->run +
                        ": no python3 with matplotlib and h5py; please install python3-matplotlib and python3-h5py (Debian)");
      print(program, *said + "\n");
      return ExitCode::done;
    };
  });
}

}  // namespace mortise
