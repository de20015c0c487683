#include "integrals/facing_2d.hpp"

#include <Sacado.hpp>

#include "integrals/segment_lines.hpp"
#include "mortise/mortar/quadratic_facet.hpp"

namespace mortise {
namespace {

template <class S>
Point2<S> unit(const Point2<S>& v) {
  using std::sqrt;
  const S length = sqrt(v[0] * v[0] + v[1] * v[1]);
  return {S(v[0] / length), S(v[1] / length)};
}

template <int n, int m, class S>
void integrate(const SlaveLine<S, n>& slave, const MasterLine<S, m>& master, const S& low, const S& high, const InterfaceMeasure& measure,
               const std::vector<LinePoint>& rule, std::array<S, 2 * n>& sum) {
  for (S& entry : sum) entry = 0.0;
  const NonNegativeBasis* basis = non_negative_basis(2, n);
  for_each_point(slave, master, low, high, measure, rule, [&](const S& xi, const S& weight, const S& eta, const S&) {
    const Point2<S> along = unit(slope(master.y, eta)), normal = unit(interpolate(slave.normal, xi));
    const S faces = cross(along, normal);  // = -n.n_m, n_m = (along_y, -along_x)
    if (!(faces > 0.0)) return;
    const auto N = LineShape<n>::values(xi);
    for (int j = 0; j < n; ++j) {
      S function = basis == nullptr ? S(N[j]) : S(basis->of_shape(j, 0) * N[0]);
      for (int k = 1; basis != nullptr && k < n; ++k) function += basis->of_shape(j, k) * N[k];
      const S share = weight * function * faces;
      sum[2 * j] -= share * along[1];
      sum[2 * j + 1] += share * along[0];
    }
  });
}

template <int n, int m>
void integrate_lines(const SlaveLine<double, n>& slave, const MasterLine<double, m>& master, const Overlap& overlap, const InterfaceMeasure& measure,
                     const std::vector<LinePoint>& rule, bool derivatives, FacingIntegrals& result) {
  constexpr int rows = 2 * n, columns = 2 * (2 * n + m);
  if (!derivatives) {
    std::array<double, rows> sum;
    integrate<n, m>(slave, master, overlap.interval.low, overlap.interval.high, measure, rule, sum);
    result.value = Eigen::Map<const Eigen::Matrix<double, rows, 1>>(sum.data());
    return;
  }
  using Dual = Sacado::Fad::SFad<double, columns>;
  const DualLines<Dual, n, m> lines(slave, master, overlap);
  std::array<Dual, rows> sum;
  integrate<n, m>(lines.slave, lines.master, lines.low, lines.high, measure, rule, sum);
  result.value.resize(rows);
  result.derivative.resize(rows, columns);
  for (int q = 0; q < rows; ++q) {
    result.value[q] = sum[q].val();
    for (int i = 0; i < columns; ++i) result.derivative(q, i) = sum[q].fastAccessDx(i);
  }
}

}  // namespace

void integrate_facing(const SlaveCurve& slave, const LinePoints& master, const Overlap& overlap, const InterfaceMeasure& measure,
                      const std::vector<LinePoint>& rule, bool derivatives, FacingIntegrals& result) {
  with_lines(slave, master, [&](const auto& a, const auto& b) { integrate_lines(a, b, overlap, measure, rule, derivatives, result); });
}

}  // namespace mortise
