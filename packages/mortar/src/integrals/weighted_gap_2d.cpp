#include <Sacado.hpp>

#include "integrals/segment_lines.hpp"

namespace mortise {
namespace {

template <int n, int m>
WeightedGap curve(const SlaveLine<double, n>& slave, const MasterLine<double, m>& master, const Overlap& overlap, const FacetVector& weights,
                  const InterfaceMeasure& measure, const std::vector<LinePoint>& rule) {
  constexpr int columns = 2 * (2 * n + m);
  using Slope = Sacado::Fad::SFad<double, columns>;
  using Curve = Sacado::Fad::SFad<Slope, columns>;
  const auto independent = [](int column, double value) { return Curve(columns, column, Slope(columns, column, value)); };
  SlaveLine<Curve, n> of_slave;
  MasterLine<Curve, m> of_master;
  for (int i = 0; i < 2; ++i) {
    for (int a = 0; a < n; ++a) {
      of_slave.x[a][i] = independent(2 * a + i, slave.x[a][i]);
      of_slave.normal[a][i] = independent(2 * (n + a) + i, slave.normal[a][i]);
    }
    for (int l = 0; l < m; ++l) of_master.y[l][i] = independent(2 * (2 * n + l) + i, master.y[l][i]);
  }
  // One step from the root makes first derivatives exact, the next one second derivatives.
  const auto root = [&](const Point2<Curve>& y, double xi) { return lift_root(of_slave, y, lift_root(of_slave, y, Curve(xi))); };
  const Curve low = overlap.low_is_master ? root(of_master.y[1], overlap.interval.low) : Curve(overlap.interval.low);
  const Curve high = overlap.high_is_master ? root(of_master.y[0], overlap.interval.high) : Curve(overlap.interval.high);
  Curve sum = 0.0;
  for_each_point(of_slave, of_master, low, high, measure, rule, [&](const Curve& xi, const Curve& weight, const Curve&, const Curve& gap) {
    const auto N = LineShape<n>::values(xi);
    Curve function = weights[0] * N[0];
    for (int a = 1; a < n; ++a) function += weights[a] * N[a];
    sum += weight * function * gap;
  });
  WeightedGap result;
  result.value = sum.val().val();
  result.gradient.resize(columns);
  result.hessian.resize(columns, columns);
  for (int i = 0; i < columns; ++i) {
    result.gradient[i] = sum.val().fastAccessDx(i);
    for (int k = 0; k < columns; ++k) result.hessian(i, k) = sum.fastAccessDx(i).fastAccessDx(k);
  }
  return result;
}

}  // namespace

WeightedGap weighted_gap(const SlaveCurve& slave, const LinePoints& master, const Overlap& overlap, const FacetVector& weights,
                         const InterfaceMeasure& measure, const std::vector<LinePoint>& rule) {
  return with_lines(slave, master, [&](const auto& a, const auto& b) { return curve(a, b, overlap, weights, measure, rule); });
}

}  // namespace mortise
