// What has to have been called before contact can be linearised.

#include <fmt/format.h>

#include <Tpetra_CrsGraph.hpp>
#include <Tpetra_CrsMatrix.hpp>
#include <algorithm>
#include <stdexcept>

#include "implementation.hpp"

namespace mortise {

void ContactSystem::Implementation::require_linearisation(const char* caller) const {
  const bool rubs = std::any_of(pairs.begin(), pairs.end(), [](const auto& pair) { return pair->friction() != nullptr; });
  if (rubs && accepted_at.is_null())
    throw std::logic_error(
        fmt::format("contact: {}() before any start_step(): call it at the start of each step; slips are measured from there", caller));
  if (!has_derivatives)
    throw std::logic_error(
        fmt::format("contact: {}() needs derivatives: call evaluate(d, true, failure) before; the last evaluation had none", caller));
}

void ContactSystem::Implementation::require_system(const char* caller, const Matrix& system) const {
  require_linearisation(caller);
  if (!scatter || pattern_changed)
    throw std::logic_error(fmt::format(
        "contact: {}() {}: call system_graph() after evaluate(), and make the matrix anew on its graph where it says `changed`", caller,
        scatter ? "after the candidates of contact changed, so that the graph of the system is another one now" : "before any system_graph()"));
  if (system.getCrsGraph() != scatter->graph())  // entries are found by their positions in it
    throw std::logic_error(
        fmt::format("contact: {}() of a matrix on another graph than the one that system_graph() gave last: make it anew on that one", caller));
  if (!system.isFillActive())
    throw std::logic_error(
        fmt::format("contact: {}() of a matrix that is complete: call resumeFill() before, fillComplete() after condense() and the rows of "
                    "prescribed dofs",
                    caller));
}

}  // namespace mortise
