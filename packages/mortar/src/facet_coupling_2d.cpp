#include "facet_coupling_2d.hpp"

#include <algorithm>

#include "surface_search.hpp"

namespace mortise {
namespace {

Point2<double> point(const Eigen::Vector2d& x) { return {x.x(), x.y()}; }

}  // namespace

FacetIntegrator2d::FacetIntegrator2d(const InterfaceMeasure& measure, const MortarOptions& options)
    : measure_(measure),
      functions_{options.coupling == Coupling::dual_mortar, options.coupling == Coupling::dual_mortar && options.gap_weighting == GapWeighting::dual},
      rule_(gauss_legendre(options.gauss_points)) {}

bool FacetIntegrator2d::integrate(const SlaveFacetData& slave, const std::vector<Facet<LocalOrdinal>>& masters, const FacetReach& reach,
                                  const Positions<2>& x, bool derivatives, FacetCoupling& coupling) {
  for (int node = 0; node < 2; ++node) {
    line_.x[node] = point(x[slave.nodes[node]]);
    line_.normal[node] = point(slave.normals[node]->normal);
  }
  coupling.slave = slave.nodes;
  coupling.master.clear();
  coupling.columns.clear();
  find_pairs(masters, reach, x, coupling);
  if (pairs_.empty()) return false;
  Interval covered = pairs_.front().overlap.interval;
  for (const Pair& pair : pairs_) {
    covered.low = std::min(covered.low, pair.overlap.interval.low);
    covered.high = std::max(covered.high, pair.overlap.interval.high);
  }
  choose_basis(covered);
  accumulate(covered, coupling.master.size(), derivatives);
  if (derivatives) chain(slave, coupling);
  return combine(moments_, *slave.multipliers, functions_, derivatives, coupling);
}

void FacetIntegrator2d::find_pairs(const std::vector<Facet<LocalOrdinal>>& masters, const FacetReach& reach, const Positions<2>& x,
                                   FacetCoupling& coupling) {
  pairs_.clear();
  bool touches = false;
  for (const Facet<LocalOrdinal>& nodes : masters) {
    Pair pair;
    pair.line = {{point(x[nodes[0]]), point(x[nodes[1]])}};
    const double distance = segment_distance(line_.x, pair.line.y);
    if (distance > reach.all) continue;
    const auto overlap = find_overlap(line_, pair.line);
    if (!overlap) continue;
    touches = touches || distance <= reach.touch;
    pair.overlap = *overlap;
    for (int l = 0; l < 2; ++l) pair.place[l] = place_of(coupling.master, nodes[l]);
    pairs_.push_back(pair);
  }
  if (!touches) pairs_.clear();
}

// L_0, L_1 are nodal at the ends of the covered interval; T^-T is what the linear extrapolation from there to the nodes makes of them.
void FacetIntegrator2d::choose_basis(const Interval& covered) {
  moments_.T.resize(2, 2);
  moments_.T << 0.5 * (1.0 - covered.low), 0.5 * (1.0 - covered.high), 0.5 * (1.0 + covered.low), 0.5 * (1.0 + covered.high);
  moments_.extrapolation.resize(2, 2);
  for (int j = 0; j < 2; ++j) {
    const double place = ((j == 0 ? -1.0 : 1.0) - covered.low) / (covered.high - covered.low);
    moments_.extrapolation.row(j) << 1.0 - place, place;
  }
}

void FacetIntegrator2d::accumulate(const Interval& covered, std::size_t masters, bool derivatives) {
  const auto count = static_cast<Eigen::Index>(masters), rows = 5 + 2 * count;
  moments_.value.setZero(rows);
  if (derivatives) raw_.setZero(rows, 8 + 2 * count);
  for (const Pair& pair : pairs_) {
    integrate_segment(line_, pair.line, pair.overlap, covered, measure_, rule_, derivatives, segment_);
    const std::array<Eigen::Index, 2> place = pair.place;
    const std::array<Eigen::Index, SegmentIntegrals::count> row = {
        0, 1, 2, 3 + place[0], 3 + place[1], 3 + count + place[0], 3 + count + place[1], 3 + 2 * count, 4 + 2 * count};
    for (int q = 0; q < SegmentIntegrals::count; ++q) {
      moments_.value[row[q]] += segment_.value[q];
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

  moments_.slope.setZero(raw_.rows(), 2 * static_cast<Eigen::Index>(columns.size()));
  moments_.moving_columns = moments_.slope.cols();
  moments_.slope.leftCols<4>() = raw_.leftCols<4>();
  moments_.slope.middleCols(2 * first_master, 2 * masters) = raw_.rightCols(2 * masters);
  for (int node = 0; node < 2; ++node) {
    const NodalNormal& normal = *slave.normals[node];
    for (std::size_t c = 0; c < normal.columns.size(); ++c)
      moments_.slope.middleCols<2>(2 * place_of(columns, normal.columns[c])).noalias() +=
          raw_.middleCols<2>(4 + 2 * node) * normal.derivative.middleCols<2>(2 * static_cast<Eigen::Index>(c));
  }
}

}  // namespace mortise
