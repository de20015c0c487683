#pragma once
// From the overlaps of one slave facet to its D, M and gap, and their derivatives with respect to nodal positions, in 3D.

#include <vector>

#include "integrals/facing_3d.hpp"
#include "mortise/mortar/segment_3d.hpp"
#include "slave/slave_facet.hpp"

namespace mortise {

/// Integrates facet by facet; keeps its work space between facets.
class FacetIntegrator3d {
 public:
  explicit FacetIntegrator3d(const MortarOptions& options);

  /// The distance of a master facet is the least height over the slave at the points of integration.
  /// @param masters  master facets that may overlap (local nodes)
  /// @param x        positions of the local nodes
  /// @return false if none overlaps within reach; then `coupling` has no meaning
  /// @throws StepFailure for a slave facet that lost its area or is not convex any more, and as find_overlaps()
  bool integrate(const SlaveFacetData& slave, const std::vector<Facet<LocalOrdinal>>& masters, const FacetReach& reach,
                 const std::vector<Eigen::Vector3d>& x, bool derivatives, FacetCoupling& coupling);

  /// Overlaps that the last coupling is the sum of.
  std::size_t segments() const { return pairs_.size(); }

 private:
  struct Pair {                                              ///< a master facet, once for each of its parts that meets one of the slave's
    FacetVectors nodes;                                      ///< in the frame of the plane
    boost::container::static_vector<Eigen::Index, 8> place;  ///< in FacetCoupling::master
    Overlap3d overlap;
  };
  bool find_pairs(const std::vector<Facet<LocalOrdinal>>& masters, const FacetReach& reach, const std::vector<Eigen::Vector3d>& x,
                  FacetCoupling& coupling);
  bool choose_basis(Eigen::Index nodes);
  void accumulate(const std::vector<Eigen::Vector3d>& x, bool derivatives, const FacetCoupling& coupling);
  void chain(const SlaveFacetData& slave, FacetCoupling& coupling);
  void face(const std::vector<Eigen::Vector3d>& x, bool derivatives, FacetCoupling& coupling);

  FacetFunctions functions_;
  AuxiliaryPlane plane_;
  FacetVectors normals_;  ///< in the frame of the plane
  std::vector<Pair> pairs_;
  std::vector<Overlap3d> overlaps_;
  std::vector<double> distances_;  ///< of the master facets that overlap; of others infinite
  Eigen::MatrixXd basis_;          ///< L = basis N
  SegmentIntegrals3d segment_;
  FacingIntegrals3d facing_;
  Eigen::MatrixXd raw_;  ///< derivatives with respect to slave positions, slave normals, masters
  FacetMoments moments_;
};

}  // namespace mortise
