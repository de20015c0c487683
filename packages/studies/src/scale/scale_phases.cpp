#include "scale/scale_phases.hpp"

namespace mortise {

const std::vector<ScalePhase>& scale_phases() {
  using Times = ScalePhase::Times;
  static const std::vector<ScalePhase> phases{
      {"mesh", {"mesh"}, "element"},
      {"search", {"search"}, "slave facet and Newton iteration", Times::newton_iterations},
      {"integrals", {"contact_integrals"}, "overlap of slave and master facets and Newton iteration", Times::newton_iterations},
      {"condensation", {"condensation", "contact_graph", "contact_residual"}, "slave facet and Newton iteration", Times::newton_iterations},
      {"bulk", {"bulk", "loads"}, "element and Newton iteration", Times::newton_iterations},
      {"solver set-up", {"linear_setup"}, "pair of nodes in one element and Newton iteration", Times::newton_iterations, true},
      {"solution", {"linear_solve"}, "pair of nodes in one element and iteration of the linear solver", Times::linear_iterations, true},
      {"output", {"output"}, "node"},
      {"rest", {}, "node and Newton iteration", Times::newton_iterations}};
  return phases;
}

}  // namespace mortise
