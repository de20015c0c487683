#pragma once
// The integrals over the overlap of one slave and one master facet in 2D, and their exact derivatives.

#include <Eigen/Core>
#include <array>
#include <boost/container/static_vector.hpp>
#include <optional>
#include <vector>

#include "mortise/mortar/mortar_interface.hpp"
#include "mortise/mortar/projection_2d.hpp"
#include "mortise/shape/quadrature.hpp"

namespace mortise {

/// An interval of a slave facet's xi.
struct Interval {
  double low = -1.0;  ///< where it begins
  double high = 1.0;  ///< where it ends, above `low`
};

/// Part of a slave facet that one master facet covers. The two surfaces run against one another, so the master's second node bounds it
/// from below and its first node from above, unless the slave facet ends before.
struct Overlap {
  Interval interval;            ///< on the slave facet
  bool low_is_master = false;   ///< true if the lower end moves with the master's second node
  bool high_is_master = false;  ///< true if the upper end moves with the master's first node
};

/// Nodes of a line, linear (2) or quadratic (3).
using LinePoints = boost::container::static_vector<Point2<double>, 3>;

/// A slave facet and the unit normals at its nodes.
struct SlaveCurve {
  LinePoints x;       ///< nodes
  LinePoints normal;  ///< unit normals at them
};

/// True if the master facet's outward normal points, at both ends, against a slave normal, far enough from being perpendicular to be projected on
/// along it.
bool faces(const LinePoints& master, const Point2<double>& normal);

/// The overlap, or none. None also where the master facet does not face the nodal normals.
std::optional<Overlap> find_overlap(const SlaveCurve& slave, const LinePoints& master);

/// Functions L of a slave facet that are nodal at the ends of an interval of it; quadratic ones are nodal at its middle too. They are a basis of the
/// facet's functions that stays well conditioned on however small a covered part.
/// @param from_low, from_high  distances from the interval's ends over its length
template <int nodes, class S>
std::array<S, nodes> interval_functions(const S& from_low, const S& from_high) {
  if constexpr (nodes == 2)
    return {from_high, from_low};
  else
    return {S(from_high * (from_high - from_low)), S(from_low * (from_low - from_high)), S(4.0 * from_low * from_high)};
}

/// int over an overlap, with n slave and m master nodes. Rows:  int L_i L_j (i <= j, i first),   int L_i N_l^m (row i m + l),   int L_i g.
struct SegmentIntegrals {
  Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, 18, 1> value;  ///< rows as above
  /// With respect to slave positions, nodal normals, master positions (two components each).
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, 18, 18> derivative;
};

/// The integrals over an overlap and, if `derivatives`, their derivatives, into `result`.
/// @param basis  interval of the functions L; held constant in the derivatives
/// @param rule   quadrature on [-1, 1], mapped to the overlap
/// @throws StepFailure as project_onto()
void integrate_segment(const SlaveCurve& slave, const LinePoints& master, const Overlap& overlap, const Interval& basis,
                       const InterfaceMeasure& measure, const std::vector<LinePoint>& rule, bool derivatives, SegmentIntegrals& result);

/// int (sum_a weights_a N_a) g over an overlap, with its gradient and Hessian with respect to slave positions, nodal normals, master positions (two
/// components each).
struct WeightedGap {
  double value = 0.0;                                                                      ///< the integral
  Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, 18, 1> gradient;               ///< [components]
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, 18, 18> hessian;  ///< [components x components]
};

/// The integral over an overlap, with gradient and Hessian.
/// @param weights  [slave nodes]
/// @throws StepFailure as project_onto()
WeightedGap weighted_gap(const SlaveCurve& slave, const LinePoints& master, const Overlap& overlap, const FacetVector& weights,
                         const InterfaceMeasure& measure, const std::vector<LinePoint>& rule);

}  // namespace mortise
