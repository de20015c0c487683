#include "mortise/contact/enforcement.hpp"

#include <stdexcept>

#include "mortise/contact/friction.hpp"

namespace mortise {

FrictionBound NodeFriction::operator()(double pressure) const {
  FrictionPoint point = at_start;
  point.pressure = pressure;
  if (missing_bound != nullptr) *missing_bound = law->missing_bound(point);
  return law->bound(point);
}

SpatialVector Enforcement::return_map(const ContactNode&) const {
  throw std::logic_error("contact: an enforcement with updates() has to define return_map()");
}
double Enforcement::stiffness(const ContactNode&) const {
  throw std::logic_error("contact: an enforcement with updates() has to define stiffness()");
}

}  // namespace mortise
