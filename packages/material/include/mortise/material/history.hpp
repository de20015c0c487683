#pragma once
// Laws with a memory.

#include <type_traits>

namespace mortise {

/// Of laws whose stress depends on the current deformation alone.
struct NoState {};

/// Law::State, the values that a point of the law keeps from the last converged step; NoState for laws without. The members stress, energy,
/// stress_and_tangent of a law with a state take it as their last argument. The next step starts from updated(F, state). The value for output is
/// equivalent_plastic_strain(F, state).
template <class Law, class = void>
struct StateOf {
  using type = NoState;
};
template <class Law>
struct StateOf<Law, std::void_t<typename Law::State>> {
  using type = typename Law::State;
};

template <class Law>
inline constexpr bool has_history = !std::is_same_v<typename StateOf<Law>::type, NoState>;

}  // namespace mortise
