#pragma once

#include "mortise/contact/formulation.hpp"

namespace mortise {

/// A multiplier at each slave node against the point of the master surface that it meets (Hughes et al. 1976; Wriggers 2006), in one pass or in two.
struct NodeToSegment : Formulation {
  /// Which sides are slaves: the pair's slave, or both in turn.
  enum class Passes { single, two };
  Passes passes = Passes::single;  ///< how many
  void describe(Parameters& parameters) override;
  Coupling coupling() const override { return Coupling::node_to_segment; }
  Elimination elimination() const override { return Elimination::none; }
  bool two_pass() const override { return passes == Passes::two; }
};

}  // namespace mortise
