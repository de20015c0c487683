#pragma once
// An unknown that is none: it follows from others.

#include <array>

#include "mortise/core/types.hpp"

namespace mortise {

/// A displacement that follows from others, d = g(q), at one state: its value and derivatives.
struct Dependence {
  static constexpr int most = 6;                           ///< a translation and a rotation in three dimensions
  int sources = 0;                                         ///< number of q
  std::array<GlobalOrdinal, most> source{};                ///< their dof ids, the same at every state
  double value = 0.0;                                      ///< g(q) [length]
  std::array<double, most> gradient{};                     ///< dg/dq_k
  std::array<std::array<double, most>, most> curvature{};  ///< d2g/dq_k dq_l
};

}  // namespace mortise
