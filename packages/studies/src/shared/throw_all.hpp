#pragma once
// All that is wrong with several files.

#include <vector>

#include "mortise/core/error.hpp"

namespace mortise {

/// Throws InputError with the diagnostics in the order of their lines, each once; returns if there are none.
void throw_all(std::vector<Diagnostic> diagnostics);

}  // namespace mortise
