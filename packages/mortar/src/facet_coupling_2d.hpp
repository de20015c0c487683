#pragma once
// From the segments of one slave facet to its D, M and gap, and their derivatives with respect to nodal positions (2D).

#include <vector>

#include "mortise/mortar/segment_2d.hpp"

namespace mortise {

/// A slave facet as the integration needs it.
struct SlaveFacetData {
  std::array<LocalOrdinal, 2> nodes{};
  std::array<const NodalNormal*, 2> normals{};
  std::array<bool, 2> carries{};    ///< multiplier or not; at least one does
  std::array<double, 2> weights{};  ///< int N_j over the facet in the reference configuration
};

/// A master facet and its distance from the slave facet.
struct NearFacet {
  std::array<LocalOrdinal, 2> nodes{};
  double distance = 0.0;
};

/// Integrates facet by facet; keeps its work space between facets.
class FacetIntegrator2d {
 public:
  FacetIntegrator2d(const InterfaceMeasure& measure, const MortarOptions& options);

  /// @param x        positions of the local nodes
  /// @param masters  master facets that may overlap (local nodes)
  /// @param reach    at least one that does overlap has to be this near
  /// @return false if there is none; then `coupling` has no meaning
  bool integrate(const SlaveFacetData& slave, const std::vector<NearFacet>& masters, double reach, const std::vector<Eigen::Vector2d>& x,
                 bool derivatives, FacetCoupling& coupling);

 private:
  struct Pair {
    std::array<LocalOrdinal, 2> nodes{};
    std::array<Eigen::Index, 2> place{};  ///< in FacetCoupling::master
    MasterLine<double> line;
    Overlap overlap;
  };
  void find_pairs(const std::vector<NearFacet>& masters, double reach, const std::vector<Eigen::Vector2d>& x, FacetCoupling& coupling);
  void accumulate(const Interval& covered, std::size_t masters, bool derivatives);
  void chain(const SlaveFacetData& slave, FacetCoupling& coupling);
  bool combine(const SlaveFacetData& slave, const Interval& covered, bool derivatives, FacetCoupling& coupling) const;

  InterfaceMeasure measure_;
  bool dual_multipliers_, dual_gap_;
  std::vector<LinePoint> rule_;
  SlaveLine<double> line_;
  std::vector<Pair> pairs_;
  SegmentIntegrals segment_;
  /// Rows: int L_0 L_0, L_0 L_1, L_1 L_1; int L_0 N_l (all l), int L_1 N_l; int L_0 g, int L_1 g.
  Eigen::VectorXd value_;
  Eigen::MatrixXd raw_;      ///< derivatives with respect to x_a, x_b, n_a, n_b, then the masters
  Eigen::MatrixXd chained_;  ///< derivatives with respect to the coupling's columns
};

}  // namespace mortise
