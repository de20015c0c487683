#pragma once
// Nodes that follow a reference point: rigid bodies and tied sets.

#include <vector>

#include "mortise/core/dependence.hpp"
#include "mortise/solid/bodies.hpp"

namespace mortise {

/// Displacements that follow those of reference points: d_i = u + (R(theta) - I)(X_i - X), theta an angle in 2D and the rotation vector in 3D. The
/// dofs of a point are those of its node, u, and of its rotation node, arm * theta (in 2D its first one). A component that a rigid body in an
/// axisymmetric model cannot have follows from nothing: it is 0.
class Followers {
 public:
  explicit Followers(const Bodies& bodies);

  /// Owned dofs (local indices in Bodies::dofs()) that follow, ascending.
  const std::vector<LocalOrdinal>& dofs() const { return dofs_; }

  /// Owned dofs of reference points: what is followed, and what is idle.
  const std::vector<LocalOrdinal>& followed() const { return followed_; }

  /// Dependences at a displacement (on Bodies::local_dofs()), in the same order.
  std::vector<Dependence> evaluate(const Vector& local_displacement) const;

  /// Dofs of reference points (owned by this rank) that nothing follows: they have to be prescribed as 0.
  static std::vector<LocalOrdinal> idle_dofs(const Bodies& bodies);

 private:
  struct Follower {
    LocalOrdinal node;
    int component;
    std::size_t point;
  };
  const Bodies& bodies_;
  std::vector<LocalOrdinal> dofs_, followed_;
  std::vector<Follower> followers_;  ///< one for each dof
};

}  // namespace mortise
