#pragma once
// Contact pairs that are found by the program.

#include <optional>
#include <string>
#include <vector>

#include "mortise/contact/contact_pair.hpp"
#include "mortise/core/parameters.hpp"
#include "mortise/simulation/scene/contact_start.hpp"
#include "mortise/simulation/scene/heat.hpp"

namespace mortise {

enum class ContactSearch { none, automatic };

/// Surfaces that become contact pairs by themselves.
struct AutomaticContactOptions {
  ContactSearch pairs = ContactSearch::none;
  Located<std::vector<std::string>> bodies;  ///< that may touch one another; empty: all
  std::optional<double> reach;               ///< [length] of what is found; none: as far as the longest edge of the facet that looks
  double angle = 30.0;                       ///< [degrees] between facets at the edges of patches
  ContactStartOptions start;                 ///< of all pairs that are found
  ContactOptions contact;                    ///< of all pairs that are found
  ContactHeatOptions heat;                   ///< of all pairs that are found
  void describe(Parameters& parameters);
};

}  // namespace mortise
