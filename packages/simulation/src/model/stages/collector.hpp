#pragma once
// Everything that is wrong with an input, found by several parts of a construction.

#include <vector>

#include "mortise/core/error.hpp"

namespace mortise {

/// Runs the parts of the construction one after the other and keeps what each of them finds wrong.
class Collector {
 public:
  template <class Function>
  void operator()(const Function& function) {
    try {
      function();
    } catch (const InputError& error) {
      diagnostics_.insert(diagnostics_.end(), error.diagnostics().begin(), error.diagnostics().end());
    }
  }
  /// Collective.
  void throw_found(const Communicator& comm) const { throw_if_any(comm, diagnostics_); }

 private:
  std::vector<Diagnostic> diagnostics_;
};

}  // namespace mortise
