#include "load_support.hpp"

#include <limits>

namespace mortise {

double evaluate(const Expression& expression, double time, const std::array<double, 3>& position, std::optional<StepFailure>& failure) {
  try {
    return expression(time, position[0], position[1], position[2]);
  } catch (const InputError& error) {
    if (!failure) failure.emplace(FailureKind::input, error.what());
    return std::numeric_limits<double>::quiet_NaN();
  }
}

std::vector<Expression> components(const Bodies& bodies, const Expression& x, const Expression& y, const std::optional<Expression>& z) {
  if (bodies.dimension() == 3) return {x, y, z.value_or(Expression(0.0))};
  if (z) throw InputError(z->place(), "a load in z needs kinematics \"three dimensional\"; the scene is in the plane of x and y");
  return {x, y};
}

}  // namespace mortise
