#pragma once
// Viscous stabilisation of static scenes.

#include <optional>

#include "mortise/core/parameters.hpp"

namespace mortise {

/// Viscous forces that hold bodies until contact does, and vanish: see Stabilisation.
struct StabilisationOptions {
  enum class Kind { none, viscous };
  Kind kind = Kind::none;
  double factor = 0.01;         ///< [-] of the viscosity
  std::optional<double> until;  ///< time from which on there are none; none: the end time
  Place place;                  ///< of the list
  void describe(Parameters& parameters);

  bool acts() const { return kind != Kind::none; }
};

}  // namespace mortise
