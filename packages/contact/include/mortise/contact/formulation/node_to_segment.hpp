#pragma once

#include "mortise/contact/formulation.hpp"
#include "mortise/mortar/coupling/node_to_segment.hpp"

namespace mortise {

/// A multiplier at each slave node against the point of the master surface that it meets (Hughes et al. 1976; Wriggers 2006), in one pass or in two.
struct NodeToSegment : Formulation {
  /// Sides that are slaves: the pair's slave, or both in turn.
  enum class Passes { single, two };
  Passes passes = Passes::single;  ///< number of passes
  void describe(Parameters& parameters) override;
  SharedCoupling coupling() const override { return coupling_of<NodeToSegmentCoupling>(); }
  SharedEnforcement enforcement() const override { return kept_multipliers(); }
  bool two_pass() const override { return passes == Passes::two; }
};

}  // namespace mortise
