#include "mortise/core/guarded_value.hpp"

#include <exception>
#include <limits>

namespace mortise {

double value_or_nan(const ScalarFunction& function, const std::vector<double>& arguments, std::string* reason) {
  try {
    return function.at(arguments);
  } catch (const std::exception& error) {
    if (reason != nullptr) *reason = error.what();
    return std::numeric_limits<double>::quiet_NaN();
  }
}

}  // namespace mortise
