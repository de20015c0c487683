#pragma once
// From the segments of one slave facet to its D, M and gap, and their derivatives with respect to nodal positions (2D).

#include <vector>

#include "geometry/facet_geometry.hpp"
#include "integrals/facing_2d.hpp"
#include "mortise/mortar/segment_2d.hpp"
#include "slave/slave_facet.hpp"

namespace mortise {

/// Integrates facet by facet; keeps its work space between facets.
class FacetIntegrator2d {
 public:
  FacetIntegrator2d(const InterfaceMeasure& measure, const MortarOptions& options);

  /// @param masters  master facets that may overlap (local nodes)
  /// @param x        positions of the local nodes
  /// @return false if none overlaps within reach; then `coupling` has no meaning
  bool integrate(const SlaveFacetData& slave, const std::vector<Facet<LocalOrdinal>>& masters, const FacetReach& reach, const Positions<2>& x,
                 bool derivatives, FacetCoupling& coupling);

  /// The second derivatives of sum_j pressures_j g_j, standard weighting, whose first ones integrate() gives. Let H and G be the Hessian and the
  /// gradient in slave positions, nodal normals and master positions, and J the derivative of these. Then they are J^T H J + sum_a G_a . d2n_a.
  /// @param pressures  [nodes of the facet]
  bool curve(const SlaveFacetData& slave, const std::vector<Facet<LocalOrdinal>>& masters, const FacetReach& reach, const Positions<2>& x,
             const FacetVector& pressures, GapCurvature& result);

  /// Overlaps that the last coupling is the sum of.
  std::size_t segments() const { return pairs_.size(); }

 private:
  struct Pair {
    boost::container::static_vector<Eigen::Index, 3> place;  ///< in FacetCoupling::master
    LinePoints line;
    Overlap overlap;
  };
  /// Finds the overlaps, with the master nodes that take part. False: there are none.
  bool find_pairs(const SlaveFacetData& slave, const std::vector<Facet<LocalOrdinal>>& masters, const FacetReach& reach, const Positions<2>& x,
                  std::vector<LocalOrdinal>& master_nodes);
  void choose_basis(const Interval& covered);
  void accumulate(const Interval& covered, std::size_t masters, bool derivatives);
  void chain(const SlaveFacetData& slave, FacetCoupling& coupling);
  void chain_columns(const SlaveFacetData& slave, FacetCoupling& coupling, const Eigen::MatrixXd& raw, Eigen::MatrixXd& slope) const;
  void face(const SlaveFacetData& slave, bool derivatives, FacetCoupling& coupling);
  const std::vector<LinePoint>& rule() const { return line_.x.size() == 2 ? rule_ : rule_of_quadratic_; }

  InterfaceMeasure measure_;
  FacetFunctions functions_;
  std::vector<LinePoint> rule_, rule_of_quadratic_;  ///< fewer than 3 points would not tell three functions apart
  SlaveCurve line_;
  std::vector<Pair> pairs_;
  SegmentIntegrals segment_;
  FacingIntegrals facing_;
  Eigen::MatrixXd raw_;               ///< derivatives with respect to slave positions, slave normals, masters
  Eigen::Index first_master_ = 0;     ///< of the coupling's columns
  std::vector<LocalOrdinal> master_;  ///< nodes, for second derivatives
  FacetMoments moments_;
};

}  // namespace mortise
