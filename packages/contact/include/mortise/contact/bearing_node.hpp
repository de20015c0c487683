#pragma once
// What a slave node can bear where it stands, closed or about to close.

#include <vector>

#include "mortise/contact/contact_system.hpp"

namespace mortise {

/// A covered slave node whose gap is within reach of closing.
struct BearingNode {
  std::size_t pair = 0;         ///< its contact pair
  LocalOrdinal owned_node = 0;  ///< local index in the map of owned nodes
  bool closed = false;          ///< its state; open: it is about to close
  double friction = 0.0;        ///< |z_tau| <= friction z_n whatever z_n; infinite: the law says no more
  /// What a unit pressure does to each body, as f_c: forces on bodies are its negative.
  std::vector<HoldingRow::Wrench> normal;
  /// [tangents that may bear shear] What a unit traction along tau_a does to each body; empty without friction.
  std::vector<std::vector<HoldingRow::Wrench>> along;
};

}  // namespace mortise
