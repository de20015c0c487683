#include "facet_coupling_2d.hpp"

#include <Eigen/LU>
#include <algorithm>

namespace mortise {
namespace {

Eigen::Index place_of(std::vector<LocalOrdinal>& list, LocalOrdinal node) {
  const auto found = std::find(list.begin(), list.end(), node);
  if (found != list.end()) return found - list.begin();
  list.push_back(node);
  return static_cast<Eigen::Index>(list.size()) - 1;
}

Point2<double> point(const Eigen::Vector2d& x) { return {x.x(), x.y()}; }

/// int phi_j below this share of int N_j over the whole facet is round-off of a facet that is not covered.
constexpr double negligible_cover = 1e-12;

}  // namespace

FacetIntegrator2d::FacetIntegrator2d(const InterfaceMeasure& measure, const MortarOptions& options)
    : measure_(measure),
      dual_multipliers_(options.coupling == Coupling::dual_mortar),
      dual_gap_(dual_multipliers_ && options.gap_weighting == GapWeighting::dual),
      rule_(gauss_legendre(options.gauss_points)) {}

bool FacetIntegrator2d::integrate(const SlaveFacetData& slave, const std::vector<NearFacet>& masters, double reach,
                                  const std::vector<Eigen::Vector2d>& x, bool derivatives, FacetCoupling& coupling) {
  for (int node = 0; node < 2; ++node) {
    line_.x[node] = point(x[slave.nodes[node]]);
    line_.normal[node] = point(slave.normals[node]->normal);
  }
  coupling.slave.assign(slave.nodes.begin(), slave.nodes.end());
  coupling.master.clear();
  coupling.columns.clear();
  find_pairs(masters, reach, x, coupling);
  if (pairs_.empty()) return false;
  Interval covered = pairs_.front().overlap.interval;
  for (const Pair& pair : pairs_) {
    covered.low = std::min(covered.low, pair.overlap.interval.low);
    covered.high = std::max(covered.high, pair.overlap.interval.high);
  }
  accumulate(covered, coupling.master.size(), derivatives);
  if (derivatives) chain(slave, coupling);
  return combine(slave, covered, derivatives, coupling);
}

void FacetIntegrator2d::find_pairs(const std::vector<NearFacet>& masters, double reach, const std::vector<Eigen::Vector2d>& x,
                                   FacetCoupling& coupling) {
  pairs_.clear();
  bool touches = false;
  for (const auto& [nodes, distance] : masters) {
    Pair pair;
    pair.line = {{point(x[nodes[0]]), point(x[nodes[1]])}};
    const auto overlap = find_overlap(line_, pair.line);
    if (!overlap) continue;
    touches = touches || distance <= reach;
    pair.nodes = nodes;
    pair.overlap = *overlap;
    for (int l = 0; l < 2; ++l) pair.place[l] = place_of(coupling.master, nodes[l]);
    pairs_.push_back(pair);
  }
  if (!touches) pairs_.clear();
}

void FacetIntegrator2d::accumulate(const Interval& covered, std::size_t masters, bool derivatives) {
  const auto count = static_cast<Eigen::Index>(masters), rows = 5 + 2 * count;
  value_.setZero(rows);
  if (derivatives) raw_.setZero(rows, 8 + 2 * count);
  for (const Pair& pair : pairs_) {
    integrate_segment(line_, pair.line, pair.overlap, covered, measure_, rule_, derivatives, segment_);
    const std::array<Eigen::Index, 2> place = pair.place;
    const std::array<Eigen::Index, SegmentIntegrals::count> row = {
        0, 1, 2, 3 + place[0], 3 + place[1], 3 + count + place[0], 3 + count + place[1], 3 + 2 * count, 4 + 2 * count};
    for (int q = 0; q < SegmentIntegrals::count; ++q) {
      value_[row[q]] += segment_.value[q];
      if (!derivatives) continue;
      for (int i = 0; i < 8; ++i) raw_(row[q], i) += segment_.derivative[q][i];
      for (int l = 0; l < 2; ++l)
        for (int i = 0; i < 2; ++i) raw_(row[q], 8 + 2 * place[l] + i) += segment_.derivative[q][8 + 2 * l + i];
    }
  }
}

void FacetIntegrator2d::chain(const SlaveFacetData& slave, FacetCoupling& coupling) {
  auto& columns = coupling.columns;
  columns.assign(slave.nodes.begin(), slave.nodes.end());
  for (const NodalNormal* normal : slave.normals)
    for (const LocalOrdinal node : normal->columns) place_of(columns, node);
  const auto first_master = static_cast<Eigen::Index>(columns.size());
  columns.insert(columns.end(), coupling.master.begin(), coupling.master.end());
  const auto masters = static_cast<Eigen::Index>(coupling.master.size());

  chained_.setZero(raw_.rows(), 2 * static_cast<Eigen::Index>(columns.size()));
  chained_.leftCols<4>() = raw_.leftCols<4>();
  chained_.middleCols(2 * first_master, 2 * masters) = raw_.rightCols(2 * masters);
  for (int node = 0; node < 2; ++node) {
    const NodalNormal& normal = *slave.normals[node];
    for (std::size_t c = 0; c < normal.columns.size(); ++c)
      chained_.middleCols<2>(2 * place_of(columns, normal.columns[c])).noalias() +=
          raw_.middleCols<2>(4 + 2 * node) * normal.derivative.middleCols<2>(2 * static_cast<Eigen::Index>(c));
  }
}

// With L the linear functions that are nodal at the ends of the covered interval, N = T L and the dual basis of the restricted N is
//   phi = A L,   A = D_e T^-T M_L^-1,   M_L = int L L^T,   D_e = diag int N_j = diag (T M_L 1),
//   dA = (dD_e T^-T - A dM_L) M_L^-1.
// T is constant: which basis of the linear functions carries the integrals does not change phi. M_L is as well conditioned on a sliver as
// on the whole facet; the large entries of T^-T are the extrapolation that phi really is. Standard multipliers: phi = N = T L, constant in this
// basis,
//   D = T M_L T^T.
bool FacetIntegrator2d::combine(const SlaveFacetData& slave, const Interval& covered, bool derivatives, FacetCoupling& coupling) const {
  const auto masters = static_cast<Eigen::Index>(coupling.master.size());
  const auto columns = 2 * static_cast<Eigen::Index>(coupling.columns.size());
  coupling.D.setZero(2, 2);
  coupling.M.setZero(2, masters);
  coupling.gap.setZero(2);
  coupling.dD.resize(0, 0);
  coupling.dM.resize(0, 0);
  coupling.dgap.resize(0, 0);
  if (derivatives) {
    coupling.dD.setZero(4, columns);
    coupling.dM.setZero(2 * masters, columns);
    coupling.dgap.setZero(2, columns);
  }

  Eigen::Matrix2d T;
  T << 0.5 * (1.0 - covered.low), 0.5 * (1.0 - covered.high), 0.5 * (1.0 + covered.low), 0.5 * (1.0 + covered.high);
  const double width = covered.high - covered.low;
  Eigen::Matrix2d extrapolation;  // T^-T
  for (int j = 0; j < 2; ++j) {
    const double place = ((j == 0 ? -1.0 : 1.0) - covered.low) / width;
    extrapolation.row(j) << 1.0 - place, place;
  }
  Eigen::Matrix2d M_L;
  M_L << value_[0], value_[1], value_[1], value_[2];
  const Eigen::Matrix2d inverse = M_L.inverse();
  const Eigen::Vector2d weight = T * M_L.rowwise().sum();  // int N_j
  const auto weight_slope = [&](int j, Eigen::Index c) {
    return T(j, 0) * (chained_(0, c) + chained_(1, c)) + T(j, 1) * (chained_(1, c) + chained_(2, c));
  };
  const bool both = slave.carries[0] && slave.carries[1];

  bool any = false;
  for (int j = 0; j < 2; ++j) {
    if (!slave.carries[j]) continue;
    // phi_j = a . L; next to a node without multiplier phi_j is the sum of both, which is 1 on the covered part.
    const double own = both ? weight[j] : weight.sum();
    const double full = both ? slave.weights[j] : slave.weights[0] + slave.weights[1];
    if (!(own > negligible_cover * full)) continue;
    any = true;
    const Eigen::RowVector2d ones(1.0, 1.0), standard = both ? Eigen::RowVector2d(T.row(j)) : ones;
    const bool biorthogonal = both && dual_multipliers_;
    const Eigen::RowVector2d a = biorthogonal ? Eigen::RowVector2d(weight[j] * extrapolation.row(j) * inverse) : standard;
    const Eigen::RowVector2d w = dual_gap_ ? a : standard;

    for (int k = 0; k < 2; ++k)
      if (!both)
        coupling.D(j, k) = weight[k];
      else if (!dual_multipliers_)
        coupling.D(j, k) = T.row(j).dot(M_L * T.row(k).transpose());
      else if (k == j)
        coupling.D(j, k) = weight[k];
    for (Eigen::Index l = 0; l < masters; ++l) coupling.M(j, l) = a[0] * value_[3 + l] + a[1] * value_[3 + masters + l];
    coupling.gap[j] = w[0] * value_[3 + 2 * masters] + w[1] * value_[4 + 2 * masters];
    if (!derivatives) continue;

    for (Eigen::Index c = 0; c < columns; ++c) {
      Eigen::Matrix2d dM_L;
      dM_L << chained_(0, c), chained_(1, c), chained_(1, c), chained_(2, c);
      Eigen::RowVector2d da(0.0, 0.0);
      if (biorthogonal) da = (weight_slope(j, c) * extrapolation.row(j) - a * dM_L) * inverse;
      for (int k = 0; k < 2; ++k)
        if (both && !dual_multipliers_)
          coupling.dD(2 * j + k, c) = T.row(j).dot(dM_L * T.row(k).transpose());
        else if (k == j || !both)
          coupling.dD(2 * j + k, c) = weight_slope(k, c);
      for (Eigen::Index l = 0; l < masters; ++l)
        coupling.dM(j * masters + l, c) =
            da[0] * value_[3 + l] + da[1] * value_[3 + masters + l] + a[0] * chained_(3 + l, c) + a[1] * chained_(3 + masters + l, c);
      double dg = w[0] * chained_(3 + 2 * masters, c) + w[1] * chained_(4 + 2 * masters, c);
      if (dual_gap_) dg += da[0] * value_[3 + 2 * masters] + da[1] * value_[4 + 2 * masters];
      coupling.dgap(j, c) = dg;
    }
  }
  return any;
}

}  // namespace mortise
