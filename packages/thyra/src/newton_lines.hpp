#pragma once
// Multipliers as functions of the displacement while Newton's method is under way.

#include <vector>

#include "mortise/contact/contact_history.hpp"
#include "mortise/core/types.hpp"

namespace mortise::detail {

/// A step of Newton's method: (d + a dd, z + a dz).
struct NewtonLine {
  RCP<const Vector> d, z;    ///< where it starts
  RCP<const Vector> dd, dz;  ///< its direction
  ContactStates states;      ///< of nodes where it starts
};

/// Multipliers at a displacement.
struct PlaceOnLines {
  RCP<const Vector> z;
  std::size_t lines = 0;     ///< number of lines that lead there
  bool starts_line = false;  ///< it is the start of a line, or of the step
};

/// The lines of a step, each of which starts on the one before. Collective.
class NewtonLines {
 public:
  /// Forgets all lines. `z` and `states` are those of the start.
  void start(RCP<const Vector> z, ContactStates states);
  /// Adds a line after the first ones, and forgets those that there were beyond.
  void add(std::size_t after, NewtonLine line);
  /// At `d`, or at the nearest point of a line.
  PlaceOnLines place(const Vector& d) const;
  /// States of nodes where the last of the first lines starts; those at the start of the step for 0.
  const ContactStates& states_before(std::size_t lines) const { return lines == 0 ? states_ : lines_[lines - 1].states; }

 private:
  RCP<const Vector> z_;
  ContactStates states_;
  std::vector<NewtonLine> lines_;
};

}  // namespace mortise::detail
