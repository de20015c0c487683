// mortise: contact between bodies that deform. `mortise --help` says what it can do.

#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <Teuchos_DefaultSerialComm.hpp>
#include <Tpetra_Core.hpp>
#include <algorithm>
#include <csignal>
#include <iostream>
#include <optional>

#include "allocator.hpp"
#include "launch.hpp"
#include "mortise/core/memory.hpp"
#include "mortise/core/names.hpp"
#include "program.hpp"
#include "standard_streams.hpp"

namespace {

constexpr const char* examples = R"(Examples:
  mortise run inputs/paper/patch_test.xml                    results in results/patch_test
  mortise run inputs/paper/hertz_elastic.xml --set variables/n=8 -o fine
  mpirun -n 4 mortise run inputs/paper/hertz_elastic.xml     the same in parallel
  mortise check scene.xml                                    reads, meshes, lists the effects; solves nothing
  mortise point inputs/tutorial/point_steel.xml              stress-strain curve of one material point
  mortise study inputs/studies/hertz_elastic.xml             errors against mesh size and time, one page
  mortise scale inputs/scaling/pressed_blocks.xml            efficiency on 1, 2, 4 ... ranks of this machine, one page
  mortise paper -o page                                      every example of the paper, one page with its figures and tables
  mortise hard -o hard                                       the ledger of hard cases: which end right, which wrong
  mortise picture results/hertz_elastic                      the last step, deformed, coloured by stress
  mortise compare results/one results/other                  quantities, histories and fields of two runs
  mortise export results/hertz_elastic                       mesh and fields of all steps as an Exodus file
  mortise describe contact                                   every parameter with default, unit and meaning
  mortise list materials

Exit codes: 0 done, 1 usage, 2 invalid input, 3 not converged, 4 a check of the scene missed, 5 files, 6 memory, 70 internal)";

/// Of ranks that leave the answer to the first: an error would make mpirun end all ranks, perhaps before the first has answered.
constexpr int others_code = 0;

/// Address space that Open MPI takes until it has started in a process alone: 27 MiB, with a margin.
constexpr double mpi_start_mib = 32.0;

/// The same among other ranks, with the segments of memory that they share: runs with 160 MiB and less ended within Open MPI.
constexpr double mpi_start_among_others_mib = 256.0;

/// The error message for a first word that is no command; "" if it is one.
std::string unknown_command(const CLI::App& app, int argc, char** argv) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) names.push_back(command->get_name());
  if (argc < 2 || argv[1][0] == '-' || std::find(names.begin(), names.end(), argv[1]) != names.end()) return {};
  const std::string known = fmt::format("{}", fmt::join(names, ", "));
  return fmt::format("\"{}\" is no command{}\nThe commands are {}.", argv[1], mortise::did_you_mean(argv[1], names), known);
}

/// The error message for a first word that is an option the program does not have; "" if it is none such.
std::string unknown_option(const CLI::App& app, int argc, char** argv) {
  if (argc < 2 || argv[1][0] != '-') return {};
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options([](const CLI::Option*) { return true; })) {
    for (const std::string& name : option->get_snames()) names.push_back("-" + name);
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  const std::string word = argv[1], name = word.substr(0, word.find('='));
  if (std::find(names.begin(), names.end(), name) != names.end()) return {};
  return fmt::format("\"{}\" is no option of mortise{}\nThe options before a command are {}.", name, mortise::did_you_mean(name, names),
                     fmt::join(names, ", "));
}

/// The action of the program: the input first, then the command.
mortise::Outcome run_program(const mortise::Program& program) {
  return mortise::run_action(program, [&] {
    if (program.read) program.read();
    const mortise::ExitCode code = program.action();
    // A log on standard output does not stop a run, whose results are worth more: output that was lost is reported here.
    if (program.is_first_rank() && code == mortise::ExitCode::done && !std::cout.flush())
      throw mortise::FileError("cannot write to standard output; the results in files are complete");
    return code;
  });
}

/// Without MPI.
int run_alone(mortise::Program& program) {
  program.comm = program.exit_comm = Teuchos::rcp(new Teuchos::SerialComm<int>);
  return mortise::agree_on_exit(program, run_program(program));
}

/// Ends a process that was started with others but not joined to them by MPI: one of them answers.
int refuse_alone(const mortise::StartedTogether& together) {
  if (!mortise::is_first_process()) return others_code;
  std::cerr << mortise::not_joined(together) << std::endl;
  return static_cast<int>(mortise::ExitCode::invalid_input);
}

/// With MPI, on every rank.
int run_with_mpi(char** argv, mortise::Program& program) {
  int first_word = 1;  // Kokkos would answer to --help as well
  Tpetra::ScopeGuard scope(&first_word, &argv);
  program.comm = Tpetra::getDefaultComm();
  if (program.comm->getSize() == 1)
    if (const auto together = mortise::started_together()) {
      program.read = program.action = nullptr;
      program.comm = Teuchos::null;
      return refuse_alone(*together);
    }
  program.exit_comm = program.comm->duplicate();
  const int code = mortise::agree_on_exit(program, run_program(program));
  program.read = program.action = nullptr;  // they hold what must not outlive MPI
  program.comm = program.exit_comm = Teuchos::null;
  return code;
}

/// A process alone reads its input before it starts MPI: an error of the input is reported at once. Returns the exit code of such an error.
std::optional<int> read_alone(mortise::Program& program) {
  program.comm = Teuchos::rcp(new Teuchos::SerialComm<int>);
  const mortise::Outcome outcome = mortise::run_action(program, [&] { return program.read(), mortise::ExitCode::done; });
  program.comm = Teuchos::null;
  program.read = nullptr;
  if (outcome.code == mortise::ExitCode::done) return std::nullopt;
  return static_cast<int>(outcome.code);
}

}  // namespace

int main(int argc, char** argv) {
  mortise::set_up_blas(argv);
  mortise::is_first_process();  // before MPI writes ranks of its own
  mortise::open_closed_streams();
  // A write that a limit on file sizes or a closed pipe stops fails with an error, which is reported, and does not end the process silently.
  for (const int signal : {SIGPIPE, SIGXFSZ}) std::signal(signal, SIG_IGN);
  mortise::Program program;
  CLI::App app("Mortise: contact between bodies that deform, slide and yield", "mortise");
  app.set_version_flag("--version", "mortise " + mortise::version());
  app.footer(examples);
  app.require_subcommand(1);
  mortise::add_run_command(app, program);
  mortise::add_check_command(app, program);
  mortise::add_point_command(app, program);
  mortise::add_paper_command(app, program);
  mortise::add_study_command(app, program);
  mortise::add_hard_command(app, program);
  mortise::add_scale_command(app, program);
  mortise::add_peer_command(app, program);
  mortise::add_picture_command(app, program);
  mortise::add_compare_command(app, program);
  mortise::add_export_command(app, program);
  mortise::add_describe_command(app, program);
  mortise::add_list_command(app, program);
  mortise::add_doctor_command(app, program);
  mortise::add_completion_command(app, program);
  mortise::add_man_command(app, program);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    // All ranks read the same command line; one of them answers.
    if (!mortise::is_first_process()) return others_code;
    const bool asked_for_help = error.get_exit_code() == 0;
    if (const std::string unknown = unknown_command(app, argc, argv) + unknown_option(app, argc, argv); !asked_for_help && !unknown.empty())
      std::cerr << unknown << std::endl;
    else
      app.exit(error);
    if (!std::cout.flush()) return static_cast<int>(mortise::ExitCode::files);
    return static_cast<int>(asked_for_help ? mortise::ExitCode::done : mortise::ExitCode::usage);
  }
  if (program.launches && mortise::started_by_mpirun()) {
    if (!mortise::is_first_process()) return others_code;
    std::cerr << "this command starts runs by itself, with --launcher or mpirun where it needs more ranks: please call it without mpirun or srun"
              << std::endl;
    return static_cast<int>(mortise::ExitCode::usage);
  }
  if (program.launches) return run_alone(program);
  if (const auto together = mortise::started_together(); together && !mortise::mpi_may_join()) return refuse_alone(*together);
  const bool alone = !mortise::started_by_mpirun();
  if (alone && !program.uses_mpi) return run_alone(program);
  if (alone && program.read)
    if (const auto code = read_alone(program)) return *code;
  // Open MPI without memory ends the process, with an exit code of its own.
  if (const double left = mortise::own_memory_left_mib(), needed = alone ? mpi_start_mib : mpi_start_among_others_mib; left < needed) {
    if (mortise::is_first_process())
      std::cerr << fmt::format("mortise: a limit leaves {:.0f} MiB to this process, and MPI needs {:.0f} MiB to start; please raise it (ulimit -v)",
                               left, needed)
                << std::endl;
    return static_cast<int>(mortise::ExitCode::memory);
  }
  if (alone) mortise::start_mpi_alone();
  mortise::keep_freed_memory();
  return run_with_mpi(argv, program);
}
