#include "loads/load_support.hpp"

#include <limits>

namespace mortise {

double evaluate(const ScalarFunction& function, double time, const std::array<double, 3>& position, std::optional<StepFailure>& failure) {
  try {
    return function(time, position[0], position[1], position[2]);
  } catch (const InputError& error) {
    if (!failure) failure.emplace(FailureKind::input, error.what());
    return std::numeric_limits<double>::quiet_NaN();
  }
}

std::vector<ScalarFunction> components(const Bodies& bodies, const ScalarFunction& x, const ScalarFunction& y,
                                       const std::optional<ScalarFunction>& z) {
  if (bodies.dimension() == 3) return {x, y, z.value_or(ScalarFunction(0.0))};
  if (z) throw InputError(z->place(), "a load in z needs kinematics \"three dimensional\"; the model is in the plane of x and y");
  return {x, y};
}

}  // namespace mortise
