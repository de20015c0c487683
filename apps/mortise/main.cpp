// mortise: contact between bodies that deform. `mortise --help` says what it can do.

#include <Teuchos_DefaultSerialComm.hpp>
#include <Tpetra_Core.hpp>
#include <cstdlib>
#include <iostream>

#include "program.hpp"

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
  mortise describe contact                                   every parameter with default, unit and meaning
  mortise list materials

Exit codes: 0 done, 1 usage, 2 invalid input, 3 not converged, 4 a check of the scene missed, 5 files, 70 internal)";

/// Whether mpirun, or what a cluster has in its place, started this process.
bool started_by_mpirun() {
  for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMIX_RANK", "PMI_RANK"})
    if (std::getenv(name) != nullptr) return true;
  return false;
}

int run_alone(mortise::Program& program) {
  if (started_by_mpirun()) {
    std::cerr << "this command starts runs by itself, with mpirun if more ranks are asked for (-n): please call it without mpirun" << std::endl;
    return static_cast<int>(mortise::ExitCode::usage);
  }
  program.comm = program.exit_comm = Teuchos::rcp(new Teuchos::SerialComm<int>);
  return mortise::agree_on_exit(program, mortise::run_action(program));
}

/// With MPI, on every rank: `answer` is the exit code.
int run_with_mpi(char** argv, mortise::Program& program, const std::function<int()>& answer) {
  int first_word = 1;  // Kokkos would answer to --help as well
  Tpetra::ScopeGuard scope(&first_word, &argv);
  program.comm = Tpetra::getDefaultComm();
  program.exit_comm = program.comm->duplicate();
  const int code = answer();
  program.comm = program.exit_comm = Teuchos::null;
  return code;
}

}  // namespace

int main(int argc, char** argv) {
  mortise::Program program;
  CLI::App app("Mortise: contact between bodies that deform, slide and yield", "mortise");
  app.set_version_flag("--version", "mortise " MORTISE_VERSION);
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
  mortise::add_describe_command(app, program);
  mortise::add_list_command(app, program);
  mortise::add_doctor_command(app, program);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    // All ranks read the same command line; one of them answers.
    return run_with_mpi(argv, program, [&] {
      const bool asked_for_help = error.get_exit_code() == 0;
      if (program.is_first_rank()) app.exit(error);
      return static_cast<int>(asked_for_help ? mortise::ExitCode::done : mortise::ExitCode::usage);
    });
  }
  if (program.launches) return run_alone(program);
  return run_with_mpi(argv, program, [&] { return mortise::agree_on_exit(program, mortise::run_action(program)); });
}
