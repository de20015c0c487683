#pragma once
// A slave and a master facet in 2D as lines of as many nodes as they have, and their points of integration, for any scalar.

#include <cmath>

#include "mortise/mortar/segment_2d.hpp"

namespace mortise {

template <int n>
SlaveLine<double, n> line_of(const SlaveCurve& slave) {
  SlaveLine<double, n> line;
  for (int a = 0; a < n; ++a) {
    line.x[a] = slave.x[a];
    line.normal[a] = slave.normal[a];
  }
  return line;
}

template <int m>
MasterLine<double, m> line_of(const LinePoints& master) {
  MasterLine<double, m> line;
  for (int l = 0; l < m; ++l) line.y[l] = master[l];
  return line;
}

/// Calls act with the facets as lines of as many nodes as they have.
template <class Act>
auto with_lines(const SlaveCurve& slave, const LinePoints& master, const Act& act) {
  if (slave.x.size() == 2) return master.size() == 2 ? act(line_of<2>(slave), line_of<2>(master)) : act(line_of<2>(slave), line_of<3>(master));
  return master.size() == 2 ? act(line_of<3>(slave), line_of<2>(master)) : act(line_of<3>(slave), line_of<3>(master));
}

/// The same two facets and the ends of their overlap with derivatives with respect to slave positions, nodal normals and master positions, in this
/// order, two components each.
template <class Dual, int n, int m>
struct DualLines {
  SlaveLine<Dual, n> slave;
  MasterLine<Dual, m> master;
  Dual low, high;

  DualLines(const SlaveLine<double, n>& of_slave, const MasterLine<double, m>& of_master, const Overlap& overlap)
      : low(overlap.interval.low), high(overlap.interval.high) {
    constexpr int columns = 2 * (2 * n + m);
    for (int i = 0; i < 2; ++i) {
      for (int a = 0; a < n; ++a) {
        slave.x[a][i] = Dual(columns, 2 * a + i, of_slave.x[a][i]);
        slave.normal[a][i] = Dual(columns, 2 * (n + a) + i, of_slave.normal[a][i]);
      }
      for (int l = 0; l < m; ++l) master.y[l][i] = Dual(columns, 2 * (2 * n + l) + i, of_master.y[l][i]);
    }
    if (overlap.low_is_master) low = lift_root(slave, master.y[1], low);
    if (overlap.high_is_master) high = lift_root(slave, master.y[0], high);
  }
};

/// Calls act(xi, weight, eta, gap) at each point of a rule on the overlap [low, high]; the sum of the weights is its measure.
template <int n, int m, class S, class Act>
void for_each_point(const SlaveLine<S, n>& slave, const MasterLine<S, m>& master, const S& low, const S& high, const InterfaceMeasure& measure,
                    const std::vector<LinePoint>& rule, const Act& act) {
  using std::sqrt;
  constexpr double two_pi = 6.283185307179586476925286766559;
  const S middle = 0.5 * (high + low), half = 0.5 * (high - low);
  const auto jacobian = [&](const S& xi) {
    const Point2<S> along = slope(slave.x, xi);
    return S(sqrt(along[0] * along[0] + along[1] * along[1]) * half);
  };
  S length = jacobian(middle);  // the same everywhere on a linear facet
  for (const LinePoint& point : rule) {
    const S xi = middle + half * point.xi;
    const Point2<S> x = interpolate(slave.x, xi), normal = interpolate(slave.normal, xi);
    const MasterProjection<S> projection = project_onto(master, x, normal);
    // x + distance n = xhat, so g = n / |n| . (xhat - x) = distance |n|
    const S gap = projection.distance * sqrt(normal[0] * normal[0] + normal[1] * normal[1]);
    if constexpr (n > 2) length = jacobian(xi);
    S weight = point.weight * length;
    if (measure.axisymmetric)
      weight *= two_pi * x[0];
    else
      weight *= measure.thickness;
    act(xi, weight, projection.eta, gap);
  }
}

}  // namespace mortise
