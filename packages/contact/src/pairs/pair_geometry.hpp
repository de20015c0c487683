#pragma once
// The facets' couplings of one pair at one configuration, summed to one row per owned slave node.

#include <Eigen/Core>
#include <array>
#include <memory>
#include <vector>

#include "mortise/contact/frame.hpp"
#include "mortise/mortar/mortar_interface.hpp"
#include "pairs/multiplier_ties.hpp"

namespace mortise::detail {

/// Of a node in a host view [nodes x dim].
template <class View>
SpatialVector position_of(const View& x, LocalOrdinal node, int dimension) {
  SpatialVector position(dimension);
  for (int i = 0; i < dimension; ++i) position[i] = x(node, i);
  return position;
}

/// Derivatives of one scalar of a slave node with respect to the positions of its coupled nodes; entry dim c + i is component i of node c.
using PositionGradient = std::vector<double>;

/// A slave node's share of the contact residual. Row j of D and M is kept as coefficients c_jm of "f_c += c_jm z_j at node m":
/// c_jj = D_jj, c_jk = D_jk, c_jl = -M_jl.
struct NodeRow {
  double D = 0.0;        ///< D_jj
  double covered = 0.0;  ///< sum_k D_jk = sum_l M_jl
  SpatialVector normal;
  std::vector<double> coefficients;                                                   ///< [coupled nodes] c_jm, 0 at j itself
  PositionGradient dgap;                                                              ///< empty without derivatives
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, 3> dnormal;  ///< [dim x dim coupled nodes]; empty without derivatives
  PositionGradient dcovered;                                                          ///< where the law depends on it
  SpatialVector opening;  ///< derivative of the gap by a translation of the master; where forces are the gaps' derivatives
};

/// Weighted slip u_j since the accepted state.
struct NodeSlip {
  TangentVector slip;
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, 2> dslip;  ///< [tangents x dim coupled nodes]; empty without derivatives
  double start_gap = 0.0;       ///< weighted gap to what it faces now, at the start of the step; only of a node that was not covered then
  PositionGradient dstart_gap;  ///< empty without derivatives, and where the node was covered
  std::array<bool, 2> rests{};  ///< [held tangents] whether nothing moves along it in this step, neither the node nor what holds the master there
};

/// A pair at one configuration. Immutable once it is made.
struct PairGeometry {
  std::shared_ptr<const InterfacePattern> pattern;
  std::shared_ptr<const std::vector<NodeRow>> rows;  ///< [slave nodes]
  std::vector<double> gaps;                          ///< [slave nodes] g_j
  std::vector<NodeSlip> slips;                       ///< [slave nodes]; empty without friction
  std::vector<FacetCoupling> couplings;              ///< of facets; empty when the geometry is frozen
  std::shared_ptr<const MultiplierTies> ties;        ///< of hardly covered nodes; none of penalty
  RCP<const MultiVector> positions;                  ///< [local nodes x dim]
};

}  // namespace mortise::detail
