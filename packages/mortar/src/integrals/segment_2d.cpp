#include "mortise/mortar/segment_2d.hpp"

#include <Sacado.hpp>

#include "integrals/segment_lines.hpp"

namespace mortise {
namespace {

/// cos of the angle that a master facet's normal has to keep from the perpendicular of a slave nodal normal, for the projection along the
/// latter to be meant.
constexpr double facing_tolerance = 0.05;

template <int n, int m, class S>
void integrate(const SlaveLine<S, n>& slave, const MasterLine<S, m>& master, const S& low, const S& high, const Interval& basis,
               const InterfaceMeasure& measure, const std::vector<LinePoint>& rule, std::array<S, n*(n + 1) / 2 + n * m + n>& sum) {
  for (S& entry : sum) entry = 0.0;
  const double width = basis.high - basis.low;
  for_each_point(slave, master, low, high, measure, rule, [&](const S& xi, const S& weight, const S& eta, const S& gap) {
    const auto L = interval_functions<n>(S((xi - basis.low) / width), S((basis.high - xi) / width));
    const auto N = LineShape<m>::values(eta);
    std::array<S, n> weighted;
    for (int i = 0; i < n; ++i) weighted[i] = weight * L[i];
    int r = 0;
    for (int i = 0; i < n; ++i)
      for (int j = i; j < n; ++j) sum[r++] += weighted[i] * L[j];
    for (int i = 0; i < n; ++i)
      for (int l = 0; l < m; ++l) sum[r++] += weighted[i] * N[l];
    for (int i = 0; i < n; ++i) sum[r++] += weighted[i] * gap;
  });
}

template <int m>
bool line_faces(const MasterLine<double, m>& master, const Point2<double>& normal) {
  for (const double end : {-1.0, 1.0}) {
    const Point2<double> along = slope(master.y, end);
    if (!(cross(along, normal) > facing_tolerance * std::hypot(along[0], along[1]))) return false;
    if constexpr (m == 2) break;  // the same everywhere
  }
  return true;
}

constexpr double round_off = 1e-13;  // of xi, on a matching mesh; an overlap of that length carries nothing

// A master node that lies on the normal of a slave node bounds no overlap. The overlap of its other facet, on the far side of the node, is left
// out. The derivatives of the ends of these two overlaps cancel.
ClippedProjection settled(const ClippedProjection& end) {
  const double corner = end.xi < 0.0 ? -1.0 : 1.0;
  return std::abs(end.xi - corner) > round_off ? end : ClippedProjection{corner, false};
}

template <int n, int m>
std::optional<Overlap> overlap_of(const SlaveLine<double, n>& slave, const MasterLine<double, m>& master) {
  for (const Point2<double>& normal : slave.normal)
    if (!line_faces(master, normal)) return std::nullopt;
  const auto second = project_back(slave, master.y[1]), first = project_back(slave, master.y[0]);
  if (!second || !first) return std::nullopt;
  const ClippedProjection low = settled(*second), high = settled(*first);
  if (high.xi - low.xi <= round_off) return std::nullopt;
  return Overlap{{low.xi, high.xi}, low.inside, high.inside};
}

template <int n, int m>
void integrate_lines(const SlaveLine<double, n>& slave, const MasterLine<double, m>& master, const Overlap& overlap, const Interval& basis,
                     const InterfaceMeasure& measure, const std::vector<LinePoint>& rule, bool derivatives, SegmentIntegrals& result) {
  constexpr int rows = n * (n + 1) / 2 + n * m + n, columns = 2 * (2 * n + m);
  if (!derivatives) {
    std::array<double, rows> sum;
    integrate<n, m>(slave, master, overlap.interval.low, overlap.interval.high, basis, measure, rule, sum);
    result.value = Eigen::Map<const Eigen::Matrix<double, rows, 1>>(sum.data());
    return;
  }
  using Dual = Sacado::Fad::SFad<double, columns>;
  const DualLines<Dual, n, m> lines(slave, master, overlap);
  std::array<Dual, rows> sum;
  integrate<n, m>(lines.slave, lines.master, lines.low, lines.high, basis, measure, rule, sum);
  result.value.resize(rows);
  result.derivative.resize(rows, columns);
  for (int q = 0; q < rows; ++q) {
    result.value[q] = sum[q].val();
    for (int i = 0; i < columns; ++i) result.derivative(q, i) = sum[q].fastAccessDx(i);
  }
}

}  // namespace

bool faces(const LinePoints& master, const Point2<double>& normal) {
  return master.size() == 2 ? line_faces(line_of<2>(master), normal) : line_faces(line_of<3>(master), normal);
}

std::optional<Overlap> find_overlap(const SlaveCurve& slave, const LinePoints& master) {
  return with_lines(slave, master, [](const auto& a, const auto& b) { return overlap_of(a, b); });
}

void integrate_segment(const SlaveCurve& slave, const LinePoints& master, const Overlap& overlap, const Interval& basis,
                       const InterfaceMeasure& measure, const std::vector<LinePoint>& rule, bool derivatives, SegmentIntegrals& result) {
  with_lines(slave, master, [&](const auto& a, const auto& b) { integrate_lines(a, b, overlap, basis, measure, rule, derivatives, result); });
}

}  // namespace mortise
