#include <Trilinos_version.h>
#include <fmt/format.h>
#include <mpi.h>

#include <CLI/CLI.hpp>
#include <Eigen/Core>
#include <cstdlib>

#include "mortise/nonlinear/linear_solver_factory.hpp"
#include "program.hpp"

namespace mortise {
namespace {

std::string mpi_version() {
  char text[MPI_MAX_LIBRARY_VERSION_STRING];
  int length = 0;
  MPI_Get_library_version(text, &length);
  const std::string whole(text, length);
  return whole.substr(0, whole.find_first_of(",\n"));
}

/// Ranks on this rank's node. Collective.
int ranks_on_node() {
  MPI_Comm node;
  MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &node);
  int size = 0;
  MPI_Comm_size(node, &size);
  MPI_Comm_free(&node);
  return size;
}

/// Says whether the solver can be made here, and why not otherwise. Collective.
std::string state_of(LinearSolverOptions::Kind kind, const RCP<const Communicator>& comm) {
  LinearSolverOptions options;
  options.kind.value = kind;
  try {
    return "present: " + make_linear_solver(options, comm, Timers())->name();
  } catch (const InputError& error) {
    return std::string("not here: ") + error.what();
  }
}

ExitCode doctor(const Program& program) {
  const int ranks = program.comm->getSize(), on_node = ranks_on_node(), available = cores();
  std::string text = fmt::format("mortise   {}\nTrilinos  {}\nMPI       {}\nEigen     {}.{}.{}\ncompiler  {}\n", version(), TRILINOS_VERSION_STRING,
                                 mpi_version(), EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION, __VERSION__);
  text += fmt::format("ranks     {}, {} on this machine, which offers {} core(s)\n", ranks, on_node, available);
  if (on_node > available) text += "          more ranks than cores: expect them to wait for each other\n";
  const char* threads = std::getenv("OMP_NUM_THREADS");
  text += fmt::format("threads   OMP_NUM_THREADS {}\n", threads ? threads : "not set: set it to 1, all parallelism is MPI's");
  using Kind = LinearSolverOptions::Kind;
  for (const auto& [name, kind] : {std::pair{"mumps", Kind::mumps}, {"klu2", Kind::klu2}, {"iterative", Kind::iterative}})
    text += fmt::format("solver    {:<10}{}\n", name, state_of(kind, program.comm));
  print(program, text);
  return ExitCode::done;
}

}  // namespace

void add_doctor_command(CLI::App& app, Program& program) {
  auto* command = app.add_subcommand("doctor", "say versions, solvers present, ranks against cores");
  command->callback([&program] { program.action = [&program] { return doctor(program); }; });
}

}  // namespace mortise
