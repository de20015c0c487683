#pragma once
// The integrals over the overlap of one slave and one master facet in 2D, and their exact first derivatives.

#include <array>
#include <optional>
#include <vector>

#include "mortise/mortar/mortar_interface.hpp"
#include "mortise/mortar/projection_2d.hpp"
#include "mortise/shape/quadrature.hpp"

namespace mortise {

/// An interval of a slave facet's xi.
struct Interval {
  double low = -1.0, high = 1.0;
};

/// Part of a slave facet that one master facet covers. The two surfaces run against one another, so the master's second node bounds it
/// from below and its first node from above, unless the slave facet ends before.
struct Overlap {
  Interval interval;
  bool low_is_master = false, high_is_master = false;  ///< which ends move with the master's nodes
};

/// Whether the master facet's outward normal points against a slave normal, far enough from being perpendicular to be projected on along it.
bool faces(const MasterLine<double>& master, const Point2<double>& normal);

/// The overlap, or none. None also where the master facet does not face the nodal normals.
std::optional<Overlap> find_overlap(const SlaveLine<double>& slave, const MasterLine<double>& master);

/// int over an overlap, with L_0, L_1 the linear functions that are nodal at the ends of a fixed interval of the slave facet (a basis of the
/// facet's linear functions that stays well conditioned on however small a covered part):
struct SegmentIntegrals {
  static constexpr int count = 9;
  /// int L_0 L_0, int L_0 L_1, int L_1 L_1;  int L_0 N_0^m, int L_0 N_1^m, int L_1 N_0^m, int L_1 N_1^m;  int L_0 g, int L_1 g
  std::array<double, count> value{};
  /// With respect to x_a, x_b, n_a, n_b, y_0, y_1 (two components each).
  std::array<std::array<double, 12>, count> derivative{};
};

/// @param basis  interval at whose ends L_0 and L_1 are nodal; held constant in the derivatives
/// @param rule   quadrature on [-1, 1], mapped to the overlap
void integrate_segment(const SlaveLine<double>& slave, const MasterLine<double>& master, const Overlap& overlap, const Interval& basis,
                       const InterfaceMeasure& measure, const std::vector<LinePoint>& rule, bool derivatives, SegmentIntegrals& result);

}  // namespace mortise
