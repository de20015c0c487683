#pragma once
// From integrals over one slave facet to its D, M and gap, and their derivatives: the same in 2D and in 3D.

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "mortise/mortar/mortar_interface.hpp"
#include "mortise/mortar/quadratic_facet.hpp"

namespace mortise {

/// Integrals over all overlaps of a slave facet of n nodes. Its shape functions are N = T L, in a basis L of them that is well conditioned on the
/// covered part. Rows:  int L_i L_j (i <= j, i first),   int L_i N_l (row i masters + l),   int L_i g.
struct FacetMoments {
  FacetMatrix T, extrapolation;  ///< [n x n] T and T^-T, constant: which basis carries the integrals does not change phi
  Eigen::VectorXd value;
  Eigen::MatrixXd slope;                         ///< [rows x columns] derivatives with respect to the coupling's columns
  Eigen::Index moving_columns = 0;               ///< of the leading columns; the others move the gap only
  FacetVector whole;                             ///< [n] int N_j (Ñ_j) over the whole facet as it is
  std::function<Eigen::MatrixXd()> whole_slope;  ///< its derivatives, in leading columns; asked for where a part of the facet is covered

  static Eigen::Index masses(Eigen::Index nodes) { return nodes * (nodes + 1) / 2; }
  static Eigen::Index rows(Eigen::Index nodes, Eigen::Index masters) { return masses(nodes) + nodes * masters + nodes; }
};

/// Multipliers of a facet.
struct FacetMultipliers {
  FacetMatrix share;    ///< S: phi_j is the sum of S_jk times the facet's own function k; row of a node without multiplier: 0
  FacetVector weights;  ///< int N_j, or int Ñ_j, over the facet in the reference configuration
};

/// S: nodes that carry keep their own function. That of a node that does not goes in equal parts to its free edge neighbours, or where it has none to
/// all free nodes of the facet. So the sum of all phi stays 1. At least one node carries. On quadratic facets mid-side nodes inherit: those of the
/// node's own edges, or of the edges next to that of a mid-side node. Otherwise corners would be coupled both ways by int phi_j N_k, which then is
/// not 0 for the corners k of the mid-side node's edge. A corner inherits where no mid-side node carries; then it has to be the only one that does.
FacetMatrix multiplier_shares(const std::vector<char>& carries, std::size_t corners);

/// The functions of multipliers and gap weighting, in a model of `dimension` dimensions.
struct FacetFunctions {
  bool dual_multipliers, dual_gap;
  int dimension;
};

/// Fills D, M, gap and, if `derivatives`, their derivatives of a coupling whose nodes and columns are set. Returns false if no multiplier is left:
/// one whose int phi_j is below 1e-12 of the whole facet's is round-off of a facet that is not covered, and dropped.
bool combine(const FacetMoments& moments, const FacetMultipliers& multipliers, const FacetFunctions& functions, bool derivatives,
             FacetCoupling& coupling);

}  // namespace mortise
