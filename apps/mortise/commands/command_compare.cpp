#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "declarations.hpp"
#include "mortise/studies/compare.hpp"
#include "program.hpp"

namespace mortise {

void add_compare_command(CLI::App& app, Program& program) {
  struct Options {
    std::string a, b;
    double tolerance = -1.0;
  };
  auto* command = app.add_subcommand("compare", "compare two runs: quantities, their histories, and fields on a common mesh");
  const auto options = std::make_shared<Options>();
  command->add_option("A", options->a, "directory of a run's results")->required()->type_name(directory_value);
  command->add_option("B", options->b, "directory of another run's results")->required()->type_name(directory_value);
  command->add_option("--tolerance", options->tolerance, "largest difference allowed, over the largest value of the quantity or field; left out: any")
      ->type_name("SHARE")
      ->check(CLI::NonNegativeNumber);
  command->footer(
      "Histories are compared at the times of the shorter one, on straight lines of the other. Fields are compared at times that both runs have.\n"
      "Exit code: 4 if something differs by more than the tolerance, or is in one run alone.\n"
      "Example: mortise compare results/coarse results/fine --tolerance 1e-6");
  command->callback([&program, options] {
    program.uses_mpi = false;
    program.action = [&program, options] {
      const RunComparison comparison = compare_runs(*program.comm, options->a, options->b);
      const double largest = largest_relative_difference(comparison);
      std::string text = to_text(comparison) + fmt::format("largest difference over its scale: {:.3g}\n", largest);
      bool is_missed = false;
      if (options->tolerance >= 0.0) {
        const bool is_whole = comparison.in_one_alone.empty() &&
                              (!comparison.fields || (comparison.fields->in_one_alone.empty() && comparison.fields->not_compared.empty()));
        is_missed = !is_whole || !(largest <= options->tolerance);
        text += fmt::format("{} the tolerance {:.3g}{}\n", is_missed ? "MISSED:" : "within", options->tolerance,
                            is_whole ? "" : ": not everything can be compared");
      }
      print(program, text);
      return is_missed ? ExitCode::check_missed : ExitCode::done;
    };
  });
}

}  // namespace mortise
