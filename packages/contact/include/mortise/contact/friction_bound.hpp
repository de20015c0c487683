#pragma once
// A slave node as a law of friction sees it, and what the law gives to it.

#include <limits>

namespace mortise {

/// A closed node. But for the pressure, the values are those at the start of the step.
struct FrictionPoint {
  double pressure = 0.0;                                          ///< p >= 0 [stress]
  double slip_path = 0.0;                                         ///< accumulated [length]
  double temperature = std::numeric_limits<double>::quiet_NaN();  ///< mean of both sides; NaN: none is known
};

/// Largest shear traction of a node.
struct FrictionBound {
  double value = 0.0;  ///< rho [stress]
  double slope = 0.0;  ///< d rho / d pressure
};

}  // namespace mortise
