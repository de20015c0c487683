#pragma once

namespace mortise {

/// Exit codes of `mortise` (documented in the README and in docs/program.md).
enum class ExitCode { done = 0, usage = 1, invalid_input = 2, not_converged = 3, check_missed = 4, files = 5, memory = 6, internal = 70 };

}  // namespace mortise
