#pragma once
// Common functions of loads and boundary conditions.

#include <array>
#include <optional>
#include <vector>

#include "mortise/mesh/sets.hpp"
#include "mortise/solid/loads.hpp"

namespace mortise {

/// The value, or NaN with `failure` set if there is none.
double evaluate(const ScalarFunction& function, double time, const std::array<double, 3>& position, std::optional<StepFailure>& failure);

/// The components x, y and z of a load. Throws InputError if z is given with 2D bodies.
std::vector<ScalarFunction> components(const Bodies& bodies, const ScalarFunction& x, const ScalarFunction& y,
                                       const std::optional<ScalarFunction>& z);

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
