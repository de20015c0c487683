#pragma once
// Meshes that no run can hold, refused before they are built.

#include <vector>

#include "mortise/mesh/build_mesh.hpp"

namespace mortise {

/// Collective. Throws InputError, on all ranks, at the largest body, for more dofs than the ranks can number. Throws it also for a model that takes
/// more memory than the machines have, whatever solver it has.
void refuse_too_large(const Communicator& comm, const std::vector<BodyDescription>& bodies);

/// Checks a plan, made on the ranks of `comm`, of a run on `ranks` others: a plan takes the mesh alone.
void refuse_too_large_to_plan(const Communicator& comm, const std::vector<BodyDescription>& bodies, int ranks);

/// Collective. Memory of all machines that the ranks run on, in MiB; 0 if one of them does not say.
double memory_of_machines(const Communicator& comm);

}  // namespace mortise
