#pragma once
// Rates of the first state.

#include "mortise/nonlinear/system_evaluation.hpp"

namespace mortise::detail {

class SystemModel;

/// Gives a state its rates and internal forces. Velocities of followers are T v_q, see FollowedUnknowns. Accelerations are 0 at rest, else
///
///     T^T M (T a_q + c) = -T^T (f_int - f_ext + C v),   a = T a_q + c,   c = d2g/dq2 : v_q x v_q
///
/// and 0 where prescribed; dofs without mass take those of their neighbours. Forces of contact are left out: they are those of the first step.
/// @throws StepFailure on every rank
void begin_motion(const SystemModel& model, const Vector& velocity, bool at_rest, AcceptedState& state);

}  // namespace mortise::detail
