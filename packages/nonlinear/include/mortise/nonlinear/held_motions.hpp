#pragma once
// Motions that cost nothing, which a Newton step leaves out.

#include <functional>
#include <vector>

#include "mortise/core/types.hpp"

namespace mortise {

/// Motions v at an iterate that nothing holds and nothing drives, J v = 0 and v . F = 0. Newton's method does not say how far they go, and a linear
/// solver would amplify round-off along them.
struct HeldMotions {
  /// Owned dofs that stay where they are in the linear solve: over all ranks as many as there are motions, and no motion but 0 leaves all of them at
  /// rest. Their equations follow from the others, as the sum over all equations times v is 0.
  std::vector<LocalOrdinal> dofs;
  /// Takes the motions out of the step that this gives. Collective.
  std::function<void(Vector& dd)> take_out;
};

}  // namespace mortise
