#include "mortise/core/table.hpp"

#include "mortise/core/piecewise_linear.hpp"

namespace mortise {

double Table::operator()(double time) const { return piecewise_linear(times, values, time).value; }

}  // namespace mortise
