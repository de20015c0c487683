#pragma once
// Allowed changes of a scene when a run is restarted.

#include <string>
#include <vector>

#include "mortise/simulation/scene/scene.hpp"

namespace mortise {

/// A scene as lines "path = value", which tells whether another one is the same: every parameter, as it was given or by default. Expressions are
/// followed by the variables and tables that they name.
std::string scene_fingerprint(const Scene& scene);

/// Allowed differences between the scene of a checkpoint and the one that goes on, in words.
std::string what_may_change();

/// The parameters that differ and may not, one sentence each. These may differ:
/// * "stepping", "newton", "linear solver", "output", "checks";
/// * "balance" of contact pairs, which changes no solution;
/// * "loads", and the values of "boundary conditions". Only the model can tell whether these are the same up to the checkpoint.
std::vector<std::string> refused_changes(const std::string& fingerprint_before, const std::string& fingerprint_now);

}  // namespace mortise
