#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <regex>

#include "declarations.hpp"
#include "mortise/studies/hard.hpp"
#include "program.hpp"

namespace mortise {
namespace {

std::string is_pattern(const std::string& text) {
  try {
    const std::regex pattern(text);
  } catch (const std::regex_error& error) {
    return std::string("no regular expression: ") + error.what();
  }
  return {};
}

/// The ledger that is meant if none is named: that of the current directory, else the one installed with the program.
/// @throws FileError  if there is neither
std::string usual_ledger(const std::string& here) {
  namespace fs = std::filesystem;
  std::error_code none;
  if (fs::exists(here, none)) return here;
  const fs::path program = fs::read_symlink("/proc/self/exe", none);
  const fs::path installed = program.parent_path().parent_path() / "share/mortise" / here;
  if (fs::exists(installed, none)) return installed.string();
  throw FileError(fmt::format("there is no ledger, neither {} nor {}; please name one", here, installed.string()));
}

}  // namespace

void add_hard_command(CLI::App& app, Program& program) {
  auto* command = app.add_subcommand("hard", "run the ledger of hard cases: which end right, stop with a true reason, or end wrong");
  const auto options = std::make_shared<HardOptions>();
  const auto list = std::make_shared<bool>(false);
  options->version = version();
  const auto* ledger =
      command->add_option("LEDGER", options->ledger, "ledger file; default: inputs/hard/ledger.xml, or the one installed with the program")
          ->type_name(xml_value);
  add_directory(*command, options->directory, "directory for the pages and the results of all runs; default: results/hard");
  command->add_flag("--list", *list, "say the cases, how many runs each has and what makes it hard; run nothing");
  command->add_option("--only", options->only, "run only the cases whose names match this regular expression somewhere, sweeps included")
      ->check(CLI::Validator(is_pattern, ""))
      ->type_name("PATTERN");
  command
      ->add_option("--ranks", options->ranks,
                   "MPI ranks; cases are run on each of these numbers, separated by commas, sweeps on the first; default: 1")
      ->delimiter(',')
      ->check(above_zero())
      ->type_name("N,...")
      ->allow_extra_args(false);
  add_launcher(*command, options->launcher);
  command->add_flag("--sweeps", options->sweeps, "run sweeps as well, cases with axes");
  command->add_flag("--fresh", options->fresh,
                    "forget what DIR holds; otherwise runs that this program finished in an earlier call are not repeated");
  command->add_flag_callback(
      "--quiet", [options] { options->verbosity = Verbosity::quiet; }, "say nothing but warnings and errors");
  command->footer(
      "Leaves ledger.csv, hard-cases.md and hard-cases.html, which needs no other file, and a directory for each run. May be killed at any time: "
      "called\n"
      "again, it runs what is missing. `mortise describe hard` says what a ledger may say.\n"
      "Exit codes: 0 if no line is wrong, 2 if the ledger is invalid, 4 if a line is wrong.\n"
      "Example: mortise hard --only corner --ranks 1,3 -o corners");
  command->callback([&program, options, list, ledger] {
    program.launches = true;
    program.action = [&program, options, list, named = ledger->count() > 0] {
      if (!named) options->ledger = usual_ledger(options->ledger);
      if (!*list) return run_hard(program.comm, *options);
      return print(program, list_hard(program.comm, *options)), ExitCode::done;
    };
  });
}

}  // namespace mortise
