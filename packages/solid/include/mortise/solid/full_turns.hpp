#pragma once
// Rotation vectors in 3D that come to a full turn.

#include <array>
#include <optional>
#include <vector>

#include "mortise/solid/bodies.hpp"

namespace mortise {

/// At a full turn, |theta| = 2 pi, 4 pi, ..., components across the axis turn nothing. Moments about them, T(theta)^T m, vanish from the equations,
/// whether they are in balance or not, and Newton finds false solutions. Reference points whose free components would be such are watched.
class FullTurns {
 public:
  /// `prescribed`: owned dofs, ascending.
  FullTurns(const Bodies& bodies, const std::vector<LocalOrdinal>& prescribed);

  /// A rotation of this rank that is at a full turn is put into `failure` if that is empty (kind linear_solver: the system is singular there).
  void check(const Vector& local_displacement, std::optional<StepFailure>& failure) const;

 private:
  struct FreeRotation {
    const ReferencePoint* point;
    LocalOrdinal first_row;  ///< of the rotation vector
    std::array<bool, 3> free;
  };
  std::vector<FreeRotation> rotations_;  ///< owned
};

}  // namespace mortise
