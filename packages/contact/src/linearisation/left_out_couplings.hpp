#pragma once
// Newton's step where condensation leaves couplings of multipliers out.

#include <functional>

#include "mortise/core/types.hpp"

namespace mortise::detail {

/// The Jacobian is J = J~ + L, where J~ is what is condensed and L has rows of C only (tied_conditions.cpp). The step of J
/// follows from that of J~, J~ dx_0 = -F. With s(w) = -J~^-1 (0, w) it is
///   dx = dx_0 + s(w),   w - L s(w) = L dx_0,
/// since then J dx = -F + L dx_0 - (0, w) + L s(w) = -F. The equations in w, which has entries at few nodes, are solved by GMRES with rows that are
/// forces. Where GMRES does not converge, the step is the best that it found: a direction of descent is judged by the residual it leads to.
/// @param weights    A_j of each multiplier
/// @param tolerance  of the residual over |L dx_0|
/// @param solve      (w, dd, dz): (dd, dz) = s(w)
/// @param left_out   (dd, dz, y): y = L (dd, dz)
/// @param dd, dz     dx_0; turned into dx
void correct_step(const Vector& weights, double tolerance, const std::function<void(const Vector&, Vector&, Vector&)>& solve,
                  const std::function<void(const Vector&, const Vector&, Vector&)>& left_out, Vector& dd, Vector& dz);

}  // namespace mortise::detail
