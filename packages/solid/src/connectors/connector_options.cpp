// Parameters of springs and dashpots.

#include <fmt/format.h>

#include <algorithm>

#include "mortise/solid/connectors.hpp"

namespace mortise {

void ConnectorOptions::describe(Parameters& parameters, const std::string& word, const std::string& unit, const std::string& rotational_unit) {
  parameters.add("set", set, Says("node or side set, or reference point (\"body/reference\" of a rigid body), on which it acts").required());
  parameters.add("to", to, "set or reference point at the other end; left out: the ground. Ends are the mean places of their sets");
  parameters.add("anchor", anchor, Says("\"x, y\" or \"x, y, z\": fixed point at the other end of a line").unit("length"));
  parameters.add("per", per, {{"set", Per::set}, {"node", Per::node}},
                 "of components against the ground: set, the values are those of the whole set, spread evenly over the area of sides or over nodes; "
                 "node: each node has them");
  constexpr std::array<const char*, 3> names{"x", "y", "z"};
  for (std::size_t i = 0; i < 3; ++i)
    parameters.add(
        fmt::format("{} {}", word, names[i]), components[i],
        Says(fmt::format("in {}, against the ground or \"to\"; axisymmetric: of the whole ring; left out: none", names[i])).unit(unit).at_least(0.0));
  parameters.add(word, axial,
                 Says("along the line from \"set\" to \"to\" or \"anchor\", which turns with them; left out: none").unit(unit).at_least(0.0));
  parameters.add(
      "rotational " + word, rotational,
      Says("of reference points that rotate, in 3D for the rotation vector against the ground; left out: none").unit(rotational_unit).at_least(0.0));
  const bool has_components = std::any_of(components.begin(), components.end(), [](const auto& one) { return one.has_value(); });
  if (!axial && !rotational && !has_components)
    parameters.error("set",
                     fmt::format("has nothing that acts on it; please give \"{0} x\", \"{0} y\", \"{0} z\", \"{0}\" or \"rotational {0}\"", word));
  if (axial && (has_components || rotational))
    parameters.error(word, fmt::format("acts along a line, and the others do not; please make two lists of \"{0}\" and \"{0} x\"", word));
  if (axial && to.value.empty() == anchor.empty()) parameters.error(word, "acts along a line to \"to\" or to \"anchor\"; please give one of the two");
  if (!axial && !anchor.empty()) parameters.error("anchor", fmt::format("is the end of a line; please give \"{}\", or remove it", word));
  if (per == Per::node && (axial || rotational || !to.value.empty()))
    parameters.error("per", "\"node\" goes with components against the ground alone");
  if (!to.value.empty() && to.value == set.value) parameters.error("to", fmt::format("is \"{}\" at both ends", to.value));
}

void SpringOptions::describe(Parameters& parameters) {
  ConnectorOptions::describe(parameters, "stiffness", "force / length", "force length / radians");
  parameters.add("rest length", rest_length,
                 Says("length without force along the line; left out: the one at the start").unit("length").at_least(0.0));
  if (rest_length && !axial) parameters.error("rest length", "is that of a line; please give \"stiffness\", or remove it");
}

void DashpotOptions::describe(Parameters& parameters) {
  ConnectorOptions::describe(parameters, "coefficient", "force time / length", "force length time / radians");
}

}  // namespace mortise
