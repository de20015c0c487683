#pragma once
// GMRES (Saad, Schultz 1986), for the few equations that contact solves itself.

#include <functional>

#include "mortise/core/types.hpp"

namespace mortise::detail {

/// y = A x.
using LinearMap = std::function<void(const Vector& x, Vector& y)>;

/// Solves A x = b, beginning at x = 0, until |b - A x| <= tolerance |b| or after `most` steps. It is not restarted: `most` vectors are kept.
/// Collective.
Vector gmres(const LinearMap& A, const Vector& b, double tolerance, int most);

}  // namespace mortise::detail
