#pragma once

// Communicators of contact.

#include <mpi.h>

#include "mortise/core/types.hpp"

namespace mortise {

/// @throws PlainError if MPI is not running
void check_mpi_runs();

/// A duplicate, which is freed with the last copy of the pointer: messages of the host and of contact do not meet. Its errors are exceptions.
/// Collective.
/// @throws PlainError if MPI is not running, and for what is no communicator of one group
RCP<const Communicator> duplicate(MPI_Comm comm);

/// This process alone.
RCP<const Communicator> this_process();

}  // namespace mortise
