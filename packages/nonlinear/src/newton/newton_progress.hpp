#pragma once
// Progress of a Newton solve with contact.

#include <vector>

#include "mortise/nonlinear/newton_solver.hpp"

namespace mortise::detail {

/// Iterations that led neither to states of contact that are new in this solve nor to a smaller merit than any before. A front between stick and slip
/// may run through the nodes one after the other. It takes as many iterations as it passes nodes, which is no reason to give up. As a front passes
/// each node once, at most as many iterations as there are closed nodes count as progress.
int iterations_without_progress(const std::vector<NewtonIteration>& iterates);

/// True if a solve wanders. After `patience` iterations or more, no merit is below that of the start. In the last of them states of contact
/// change at as many nodes as in those before, and at more than a few.
bool wanders(const std::vector<NewtonIteration>& iterates);

}  // namespace mortise::detail
