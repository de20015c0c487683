#pragma once
// What the kinds of loads share.

#include <array>
#include <optional>
#include <vector>

#include "mortise/mesh/sets.hpp"
#include "mortise/shape/line2.hpp"
#include "mortise/shape/quadrature.hpp"
#include "mortise/solid/loads.hpp"

namespace mortise {

/// The value, or NaN with `failure` set if there is none.
double evaluate(const Expression& expression, double time, const std::array<double, 2>& position, std::optional<StepFailure>& failure);

/// A straight side of an element: local nodes, outward normal on the right of the way from the first to the second.
using LineNodes = std::array<LocalOrdinal, 2>;

/// The sides of the set that touch a node of this rank. Collective; throws InputError on all ranks if there is no such set.
std::vector<LineNodes> sides_at_owned_nodes(const Mesh& mesh, const Located<std::string>& set);

/// A point of the 3-point rule on a side: exact to degree 5, for N_a x radius x expressions up to cubic.
struct LineRulePoint {
  std::array<double, 2> N;
  double weight;  ///< of the side's parameter in [0, 1]
};
const std::array<LineRulePoint, 3>& line_rule();

/// Collective: runs a look-up in the mesh and makes its InputError, if any, one of all ranks.
template <class Function>
void look_up(const Mesh& mesh, const Function& function) {
  std::vector<Diagnostic> diagnostics;
  try {
    function();
  } catch (const InputError& error) {
    diagnostics = error.diagnostics();
  }
  throw_if_any(*mesh.comm, diagnostics);
}

}  // namespace mortise
