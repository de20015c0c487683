#pragma once
// Options of the mortar coupling of a pair.

#include <optional>

#include "mortise/mortar/coupling.hpp"
#include "mortise/mortar/coupling/dual_mortar.hpp"

namespace mortise {

class Parameters;

/// Derivatives of the nodal normals in Newton's method.
enum class Linearisation {
  exact,
  frozen_normals  ///< none: iterates converge to the same solution, linearly
};

/// The measure on the interface in 2D: thickness t, or 2 pi r of the current slave radius. In 3D it is not used.
struct InterfaceMeasure {
  bool axisymmetric = false;  ///< a ring: 2 pi r
  double thickness = 1.0;     ///< t of a model that is not axisymmetric
};

/// Options of the coupling of one pair.
struct MortarOptions {
  SharedCoupling coupling = coupling_of<DualMortarCoupling>();  ///< set by the pair's formulation; null is refused
  double share = 1.0;                                  ///< of the surface that the slave side stands for: 1/2 where both sides are slaves in turn
  GapWeighting gap_weighting = GapWeighting::dual;     ///< functions w_j of the weighted gaps
  std::optional<double> search_reach;                  ///< distance up to which facets can touch; default: the longest facet of the pair
  int gauss_points = 5;                                ///< per overlap of two facets in 2D
  Linearisation linearisation = Linearisation::exact;  ///< of the nodal normals
  CornerRule corners = CornerRule::master_normal;      ///< asked for; corner_rule() tells which one acts
  double balance = 1.5;                                ///< largest over mean work of the ranks, in overlaps, above which slave facets change rank
  /// The parameters of a pair's list that are those of the coupling.
  void describe(Parameters& parameters);
  /// The rule that acts: Coupling::corner_rule().
  CornerRule corner_rule(int dimension) const { return coupling->corner_rule(corners, dimension); }
  /// True if gaps are weighted by the functions of the multipliers.
  bool weighs_gaps_as_multipliers() const { return coupling->has_dual_gap(gap_weighting) == coupling->has_dual_multipliers(); }
};

}  // namespace mortise
