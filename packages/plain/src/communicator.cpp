#include "communicator.hpp"

#include <Teuchos_DefaultMpiComm.hpp>
#include <Teuchos_DefaultSerialComm.hpp>

#include "mortise/plain/plain_contact.hpp"

namespace mortise {

void check_mpi_runs() {
  int started = 0, ended = 0;
  MPI_Initialized(&started);
  MPI_Finalized(&ended);
  if (started == 0 || ended != 0)
    throw PlainError(MORTISE_WRONG_ORDER, "MPI is not running: call MPI_Init() before, or give MORTISE_THIS_PROCESS for the communicator");
}

RCP<const Communicator> duplicate(MPI_Comm comm) {
  check_mpi_runs();
  int two_groups = 0;
  if (comm == MPI_COMM_NULL || comm == MPI_Comm{}) throw PlainError(MORTISE_REFUSED, "the communicator is null, or is no handle of a communicator");
  MPI_Comm_test_inter(comm, &two_groups);
  if (two_groups != 0) throw PlainError(MORTISE_REFUSED, "the communicator is one between two groups of ranks");
  MPI_Comm own = MPI_COMM_NULL;
  if (MPI_Comm_dup(comm, &own) != MPI_SUCCESS) throw PlainError(MORTISE_REFUSED, "the communicator cannot be duplicated");
  MPI_Comm_set_errhandler(own, MPI_ERRORS_RETURN);
  const auto free = [](MPI_Comm* one) {
    int too_late = 0;
    MPI_Finalized(&too_late);
    return too_late != 0 ? MPI_SUCCESS : MPI_Comm_free(one);
  };
  return rcp(new Teuchos::MpiComm<int>(Teuchos::opaqueWrapper<MPI_Comm>(own, +free)));
}

RCP<const Communicator> this_process() { return rcp(new Teuchos::SerialComm<int>); }

}  // namespace mortise
