#include <CLI/CLI.hpp>
#include <memory>

#include "mortise/studies/point.hpp"
#include "program.hpp"

namespace mortise {

void add_point_command(CLI::App& app, Program& program) {
  auto* command = app.add_subcommand("point", "drive one material point: stress-strain curve and plot");
  const auto options = std::make_shared<RunOptions>();
  options->version = version();
  add_input_arguments(*command, "LAW", "point file: a list \"material\" and a list \"path\"", *options);
  add_output_arguments(*command, "LAW", *options);
  command->footer(
      "Leaves point.csv, point.svg, point.png, summary.json and effective.xml. `mortise describe point` says what a point file may say.\n"
      "Example: mortise point inputs/tutorial/point_steel.xml --set path/steps=20 -o coarse");
  command->callback([&program, options] {
    program.uses_mpi = false;
    program.action = [&program, options] { return run_point(program.comm, *options); };
  });
}

}  // namespace mortise
