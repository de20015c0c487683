#include "mortise/contact/formulation/pressure_overclosure.hpp"

#include <stdexcept>

#include "mortise/contact/enforcement/pressure_overclosure.hpp"
#include "mortise/contact/regularised.hpp"

namespace mortise {

namespace {
/// The list "law" of the formulation.
struct PressureLawList {
  Choice<PressureLaw>& law;
  void describe(Parameters& parameters) { parameters.choose(law, pressure_law_registry(), "kind of the curve of pressure over overclosure"); }
};
}  // namespace

// Where forces are the gaps' derivatives, a law in the place of the multipliers would need these at all nodes that gaps depend on.
void PressureOverclosure::describe(Parameters& parameters) {
  std::vector<std::pair<std::string, SharedCoupling>> choices;
  for (const SharedCoupling& one : coupling_registry())
    if (!one->has_forces_of_gaps()) choices.emplace_back(one->name(), one);
  parameters.add("discretisation", discretisation, choices, "functions through which tractions act");
  parameters.add("tangential stiffness", tangential,
                 Says("shear traction per slip before sliding; default: the stiffness of a linear law, the slope of an exponential one where the "
                      "surfaces just touch, the steepest slope of a table")
                     .unit("stress / length")
                     .above(0.0));
  PressureLawList list{law};
  parameters.list("law", list, "pressure as a function of the overclosure, the mean gap with the opposite sign");
}

SharedEnforcement PressureOverclosure::enforcement() const {
  if (!law.options) throw std::logic_error("contact: a pressure overclosure without a law; give a PressureLaw, as LinearPressure");
  if (const auto fault = law.options->fault()) throw std::logic_error("contact: " + *fault);
  return std::make_shared<const PressureOverclosureEnforcement>(law.options, tangential.value_or(law.options->typical_slope()));
}

// The condition is z_n = p(h) at h = -g / w, where p never falls. For any c > 0 a point (h, z_n) is on the curve if and only if it is where the line
// through it of the slope -c meets the curve (Minty 1962):
//   C_n = z_n - P(s),   s = z_n + c h,   P = p(h*),   p(h*) + c h* = s.
// So the solution is that of the law whatever c is. But P grows no faster than s, dP/ds = p' / (p' + c) < 1 with p' = p'(h*), however steep the law
// is. And z_n tells a node's place on the curve as well as its gap does: no trial gap makes an exponential overflow. For a linear law this is
// regularised(). A node that is covered in part has the c that it has there. Derivatives:
//   dP = p' / (p' + c) (dz_n + c dh + (h - h*) dc),   dh = -dg / w - h dw / w,   dc = c dw / w   =>   c dh + (h - h*) dc = -c / w (dg + h* dw)
Complementarity PressureOverclosureEnforcement::law(const ContactNode& node) const {
  const Frame frame = node.frame();
  const double c = node.constant * node.weight, h = -node.gap / node.weight, z_n = node.z.dot(node.normal);
  const PressurePoint point = law_->on_line(z_n + c * h, c);
  if (!(point.pressure > 0.0)) return open_node(node.z);
  const double share = c / (point.slope + c), of_gap = share * point.slope / node.weight;
  Complementarity result = closed_node(of_gap, node.gap, frame, node.z);
  result.C[0] = z_n - point.pressure;
  result.C_z.row(0) = share * node.normal.transpose();
  result.normal_factor.row(0) = share * node.z.transpose();
  result.weight_factor[0] = of_gap * point.overclosure;
  if (!node.friction) return result;
  RegularisedNode sticking;
  sticking.tangential_stiffness = tangential_;
  sticking.body_stiffness = node.constant * node.full_weight;
  sticking.full_weight = node.full_weight;
  sticking.multiplier = node.start->multiplier;
  sticking.start = node.start_gap;
  // Its depth is that beyond the onset:  dh* = (dz_n + z . dn - c / w (dg + h* dw)) / (p' + c).
  const double of_sum = share / c;
  const NodeDepth depth{point.overclosure - law_->onset(),       1.0, of_sum * node.normal, of_sum * node.z, -share / node.weight,
                        -share / node.weight * point.overclosure};
  add_regularised_friction(result, point.pressure, depth, sticking, node.slip, node.weight, frame, node.z, *node.friction);
  return result;
}

SpatialVector PressureOverclosureEnforcement::start_from(const SpatialVector& traction) const {
  SpatialVector shear = traction;
  shear[0] = 0.0;
  return shear;
}

double PressureOverclosureEnforcement::onset() const { return law_->onset(); }

}  // namespace mortise
