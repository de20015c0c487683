#include "load_support.hpp"

#include <limits>

namespace mortise {

double evaluate(const Expression& expression, double time, const std::array<double, 2>& position, std::optional<StepFailure>& failure) {
  try {
    return expression(time, position[0], position[1]);
  } catch (const InputError& error) {
    if (!failure) failure.emplace(FailureKind::not_finite, error.what());
    return std::numeric_limits<double>::quiet_NaN();
  }
}

std::vector<LineNodes> sides_at_owned_nodes(const Mesh& mesh, const Located<std::string>& set) {
  std::vector<LineNodes> lines;
  look_up(mesh, [&] {
    for (const Side& side : require_side_set(mesh, set).sides) {
      const auto nodes = mesh.side_nodes(side);
      if (nodes[0] < mesh.owned_count() || nodes[1] < mesh.owned_count()) lines.push_back({nodes[0], nodes[1]});
    }
  });
  return lines;
}

const std::array<LineRulePoint, 3>& line_rule() {
  static const std::array<LineRulePoint, 3> rule = [] {
    std::array<LineRulePoint, 3> points;
    const auto gauss = gauss_legendre(3);
    for (int q = 0; q < 3; ++q) points[q] = {Line2::values(gauss[q].xi), 0.5 * gauss[q].weight};
    return points;
  }();
  return rule;
}

}  // namespace mortise
