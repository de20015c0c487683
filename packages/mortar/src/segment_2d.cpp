#include "mortise/mortar/segment_2d.hpp"

#include <Sacado.hpp>

namespace mortise {
namespace {

constexpr double two_pi = 6.283185307179586476925286766559;

/// cos of the angle that a master facet's normal has to keep from the perpendicular of a slave nodal normal, for the projection along the
/// latter to be meant.
constexpr double facing_tolerance = 0.05;

using Dual = Sacado::Fad::SFad<double, 12>;

template <class S>
void integrate(const SlaveLine<S>& slave, const MasterLine<S>& master, const S& low, const S& high, const Interval& basis,
               const InterfaceMeasure& measure, const std::vector<LinePoint>& rule, std::array<S, SegmentIntegrals::count>& sum) {
  using std::sqrt;
  for (S& entry : sum) entry = 0.0;
  const Point2<S> travel = difference(slave.x[1], slave.x[0]);
  const S middle = 0.5 * (high + low), half = 0.5 * (high - low);
  const S jacobian = 0.5 * sqrt(travel[0] * travel[0] + travel[1] * travel[1]) * half;
  const double width = basis.high - basis.low;
  for (const LinePoint& point : rule) {
    const S xi = middle + half * point.xi;
    const Point2<S> x = interpolate(slave.x[0], slave.x[1], xi);
    const Point2<S> normal = interpolate(slave.normal[0], slave.normal[1], xi);
    const MasterProjection<S> projection = project_onto(master, x, normal);
    // x + distance n = xhat, so g = n / |n| . (xhat - x) = distance |n|
    const S gap = projection.distance * sqrt(normal[0] * normal[0] + normal[1] * normal[1]);
    S weight = point.weight * jacobian;
    if (measure.axisymmetric)
      weight *= two_pi * x[0];
    else
      weight *= measure.thickness;
    const S L_0 = (basis.high - xi) / width, L_1 = (xi - basis.low) / width;
    const S first = weight * L_0, second = weight * L_1;
    const S N_0 = 0.5 * (1.0 - projection.eta), N_1 = 0.5 * (1.0 + projection.eta);
    sum[0] += first * L_0;
    sum[1] += first * L_1;
    sum[2] += second * L_1;
    sum[3] += first * N_0;
    sum[4] += first * N_1;
    sum[5] += second * N_0;
    sum[6] += second * N_1;
    sum[7] += first * gap;
    sum[8] += second * gap;
  }
}

}  // namespace

bool faces(const MasterLine<double>& master, const Point2<double>& normal) {
  const Point2<double> travel = difference(master.y[1], master.y[0]);
  return cross(travel, normal) > facing_tolerance * std::hypot(travel[0], travel[1]);
}

std::optional<Overlap> find_overlap(const SlaveLine<double>& slave, const MasterLine<double>& master) {
  if (!faces(master, slave.normal[0]) || !faces(master, slave.normal[1])) return std::nullopt;
  const auto low = project_back(slave, master.y[1]), high = project_back(slave, master.y[0]);
  if (!low || !high) return std::nullopt;
  constexpr double round_off = 1e-13;  // of a matching mesh; such an overlap carries nothing
  if (high->xi - low->xi <= round_off) return std::nullopt;
  return Overlap{{low->xi, high->xi}, low->inside, high->inside};
}

void integrate_segment(const SlaveLine<double>& slave, const MasterLine<double>& master, const Overlap& overlap, const Interval& basis,
                       const InterfaceMeasure& measure, const std::vector<LinePoint>& rule, bool derivatives, SegmentIntegrals& result) {
  if (!derivatives) {
    integrate(slave, master, overlap.interval.low, overlap.interval.high, basis, measure, rule, result.value);
    return;
  }
  SlaveLine<Dual> dual_slave;
  MasterLine<Dual> dual_master;
  for (int node = 0; node < 2; ++node)
    for (int i = 0; i < 2; ++i) {
      dual_slave.x[node][i] = Dual(12, 2 * node + i, slave.x[node][i]);
      dual_slave.normal[node][i] = Dual(12, 4 + 2 * node + i, slave.normal[node][i]);
      dual_master.y[node][i] = Dual(12, 8 + 2 * node + i, master.y[node][i]);
    }
  const Dual low = overlap.low_is_master ? lift_root(dual_slave, dual_master.y[1], overlap.interval.low) : Dual(overlap.interval.low);
  const Dual high = overlap.high_is_master ? lift_root(dual_slave, dual_master.y[0], overlap.interval.high) : Dual(overlap.interval.high);
  std::array<Dual, SegmentIntegrals::count> sum;
  integrate(dual_slave, dual_master, low, high, basis, measure, rule, sum);
  for (int q = 0; q < SegmentIntegrals::count; ++q) {
    result.value[q] = sum[q].val();
    for (int i = 0; i < 12; ++i) result.derivative[q][i] = sum[q].fastAccessDx(i);
  }
}

}  // namespace mortise
