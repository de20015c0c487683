#include "mortise/contact/enforcement.hpp"

#include <stdexcept>

#include "mortise/contact/friction.hpp"

namespace mortise {

FrictionBound NodeFriction::operator()(double pressure) const {
  if (missing_bound != nullptr) *missing_bound = law->missing_bound(pressure, slip_path);
  return law->bound(pressure, slip_path);
}

SpatialVector Enforcement::return_map(const ContactNode&) const {
  throw std::logic_error("contact: an enforcement with updates() has to define return_map()");
}
double Enforcement::stiffness(const ContactNode&) const {
  throw std::logic_error("contact: an enforcement with updates() has to define stiffness()");
}

}  // namespace mortise
