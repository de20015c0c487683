// The last rank throws while the others wait for it in a collective call: the program has to end with code 70.

#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_Core.hpp>
#include <stdexcept>

#include "program.hpp"

int main(int argc, char** argv) {
  Tpetra::ScopeGuard scope(&argc, &argv);
  mortise::Program program;
  program.comm = Tpetra::getDefaultComm();
  program.exit_comm = program.comm->duplicate();
  program.action = [&] {
    if (program.comm->getRank() + 1 == program.comm->getSize()) throw std::runtime_error("this rank alone");
    program.comm->barrier();
    return mortise::ExitCode::done;
  };
  return mortise::agree_on_exit(program, mortise::run_action(program, program.action));
}
