#pragma once
// Part of a host in tests: Newton's method by NOX, compiled once.

#include <optional>

#include "mortise/thyra/model_with_contact.hpp"

namespace NOX {
class Observer;
}  // namespace NOX

namespace mortise::test {

/// Solves f(x) = 0 from x on by Newton's method with a line search, until |f| is 1e-11.
/// @param observer  null: none
/// @return the number of iterations; none if it does not converge in 30
std::optional<int> solve_by_nox(const RCP<ModelWithContact>& model, ThyraVector& x, const RCP<NOX::Observer>& observer = Teuchos::null);

}  // namespace mortise::test
