#include <mpi.h>

#include <Teuchos_DefaultMpiComm.hpp>
#include <chrono>
#include <iostream>
#include <thread>

#include "program.hpp"

namespace mortise {
namespace {

constexpr std::chrono::seconds patience{10};

/// Waits for `request`; false if it is not complete after the patience.
bool completes(MPI_Request& request) {
  const auto deadline = std::chrono::steady_clock::now() + patience;
  int done = 0;
  while (true) {
    MPI_Test(&request, &done, MPI_STATUS_IGNORE);
    if (done) return true;
    if (std::chrono::steady_clock::now() > deadline) return false;
    std::this_thread::sleep_for(std::chrono::microseconds(200));
  }
}

}  // namespace

int agree_on_exit(const Program& program, const Outcome& outcome) {
  const int mine = static_cast<int>(outcome.code);
  const auto* mpi = dynamic_cast<const Teuchos::MpiComm<int>*>(program.exit_comm.get());
  if (mpi == nullptr || mpi->getSize() == 1) return mine;
  const MPI_Comm raw = *mpi->getRawMpiComm();
  int worst = mine;
  // A rank that got here by itself would never return from a blocking call. A good end waits as long as it takes.
  MPI_Request request;
  MPI_Iallreduce(&mine, &worst, 1, MPI_INT, MPI_MAX, raw, &request);
  if (outcome.code == ExitCode::done) {
    MPI_Wait(&request, MPI_STATUS_IGNORE);
  } else if (!completes(request)) {
    std::cerr << "mortise: rank " << mpi->getRank() << " failed alone, all ranks are ended: " << outcome.message << std::endl;
    MPI_Abort(raw, static_cast<int>(ExitCode::internal));
  }
  return worst;
}

}  // namespace mortise
