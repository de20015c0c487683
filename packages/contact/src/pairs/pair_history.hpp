#pragma once
// Memory of one pair.

#include <memory>
#include <optional>
#include <vector>

#include "mortise/contact/enforcement.hpp"
#include "mortise/core/types.hpp"
#include "mortise/mortar/mortar_interface.hpp"

namespace mortise {

/// References of slips, [owned slave nodes]: the couplings of an accepted state.
struct SlipReferences {
  RetainedNodes nodes;                            ///< nodes it was coupled to, itself among them; none: it was hardly covered, or not at all
  std::vector<std::vector<double>> coefficients;  ///< of these nodes: rows of D and -M
  std::vector<TangentVector> positions;           ///< tau_a . sum_m c_jm x_m; empty unless the geometry is that of the reference configuration
  std::vector<TangentVector> ties;                ///< tau_a . q, what its tie shifted the slip by; empty: open, or not tied
  std::vector<TangentVector> tractions;           ///< tau_a . z of closed nodes with prescribed components; else empty
  std::vector<double> paths;                      ///< slipped until then [length]
  std::vector<double> gaps;                       ///< that they close first; -1: a node without `nodes` that was covered, and closes none
  RCP<const MultiVector> start;                   ///< [owned nodes x dim] positions in that state
};

/// Stiffness of the bodies as updates of the multipliers have shown it.
struct Settling {
  double hardening = 1.0;       ///< factor of eps of all nodes: how much stiffer than facets the bodies are
  std::optional<double> ratio;  ///< their stiffness against the slowest of the changes, over eps; none: not known yet
  double last_change = 0.0;     ///< of the multipliers in the round before, at the present stiffness [stress]
};

/// History of a pair.
struct PairHistory {
  std::vector<int> axes;                       ///< [owned slave nodes] reference axis of the tangents
  SurfaceKinks kinks;                          ///< of the slave surface
  std::vector<SurfaceFacet> nearest_facets;    ///< [owned slave nodes] the facet nearest to the master; empty but with the rule `nearest facet`
  std::shared_ptr<const SlipReferences> slip;  ///< null without friction
  std::vector<NodeStart> starts;               ///< [owned slave nodes]; empty unless Enforcement::starts_from_multipliers()
  Settling settling;                           ///< of the updates of the multipliers
  double allowed_overlap = 0.0;                ///< overlap that the surfaces may have without pressure [length]
  std::vector<double> clearances;              ///< [owned slave nodes] added to the gap [length]; empty: none
  std::vector<double> start_gaps;    ///< [owned slave nodes] mean gaps at the start of a step, 0: not covered; empty: conditions are on gaps
  std::vector<double> temperatures;  ///< [owned slave nodes] means of both sides at the start of the step; empty: none are known
  double constant_share = 1.0;       ///< factor of complementarity constants within the step
};

}  // namespace mortise
