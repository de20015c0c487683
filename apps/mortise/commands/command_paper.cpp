#include <CLI/CLI.hpp>
#include <memory>

#include "declarations.hpp"
#include "mortise/studies/paper.hpp"
#include "program.hpp"

namespace mortise {

void add_paper_command(CLI::App& app, Program& program) {
  auto* command = app.add_subcommand("paper", "run every example of the paper and draw one page of figures and tables beside the paper's numbers");
  const auto options = std::make_shared<PaperOptions>();
  options->version = version();
  add_directory(*command, options->directory, "directory for the page and for the results of each run; default: results/paper");
  command->add_option("--only", options->only, "run only these, separated by commas; the page shows no others")
      ->delimiter(',')
      ->check(one_of("example", paper_run_names()))
      ->type_name("NAME,...")
      ->allow_extra_args(false);
  command->add_option("-n,--ranks", options->ranks, "MPI ranks of each run; default: 1")->check(above_zero())->type_name("N");
  add_launcher(*command, options->launcher);
  command->add_flag("--reuse", options->reuse, "take results that an earlier call left in DIR for the same scene, settings, ranks and version");
  command->add_flag_callback(
      "--quiet", [options] { options->verbosity = Verbosity::quiet; }, "say nothing but warnings and errors");
  command->footer(
      "Leaves DIR/paper.html, which needs no other file, and DIR/NAME with the results of each run. A run that fails does not stop the others.\n"
      "Exit codes: 3 if a run failed, 4 if all came to their end and one missed a check of its scene.\n"
      "Example: mortise paper --only patch_test,block_pile -o page");
  command->callback([&program, options] {
    program.launches = true;
    program.action = [&program, options] { return run_paper(program.comm, *options); };
  });
}

}  // namespace mortise
