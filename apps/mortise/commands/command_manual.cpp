#include "declarations.hpp"
#include "program.hpp"

namespace mortise {

void add_completion_command(CLI::App& app, Program& program) {
  auto* command = app.add_subcommand("completion", "print a script that completes commands, options and files in bash");
  command->footer("Example: source <(mortise completion)");
  command->callback([&app, &program] {
    program.uses_mpi = false;
    program.action = [&app, &program] { return print(program, bash_completion(app)), ExitCode::done; };
  });
}

void add_man_command(CLI::App& app, Program& program) {
  auto* command = app.add_subcommand("man", "print the manual page mortise(1)");
  command->footer("Example: mortise man | man -l -");
  command->callback([&app, &program] {
    program.uses_mpi = false;
    program.action = [&app, &program] { return print(program, manual_page(app)), ExitCode::done; };
  });
}

}  // namespace mortise
