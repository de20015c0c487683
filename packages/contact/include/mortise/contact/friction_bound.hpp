#pragma once
// What a law of friction gives to a node.

namespace mortise {

/// Largest shear traction of a node.
struct FrictionBound {
  double value = 0.0;  ///< rho [stress]
  double slope = 0.0;  ///< d rho / d pressure
};

}  // namespace mortise
