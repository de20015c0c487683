#include "coupling/facet_coupling_3d.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>

#include "integrals/whole_facet.hpp"
#include "slave/facet_alignment.hpp"

namespace mortise {

FacetIntegrator3d::FacetIntegrator3d(const MortarOptions& options)
    : functions_{options.coupling->has_dual_multipliers(), options.coupling->has_dual_gap(options.gap_weighting), 3} {}

bool FacetIntegrator3d::integrate(const SlaveFacetData& slave, const std::vector<Facet<LocalOrdinal>>& masters, const FacetReach& reach,
                                  const std::vector<Eigen::Vector3d>& x, bool derivatives, FacetCoupling& coupling) {
  FacetVectors nodes;
  for (const LocalOrdinal node : slave.nodes) nodes.push_back(x[node]);
  const auto plane = make_auxiliary_plane(nodes);
  if (!plane) throw StepFailure(FailureKind::inverted_facet, "a slave facet lost its area, or is not convex any more");
  plane_ = *plane;
  normals_.clear();
  for (const NodalNormal* normal : slave.normals) normals_.push_back(plane_.frame * normal->normal);
  coupling.slave = slave.nodes;
  coupling.master.clear();
  coupling.columns.clear();
  if (!find_pairs(masters, reach, x, coupling)) return false;
  if (!choose_basis(static_cast<Eigen::Index>(nodes.size()))) return false;
  accumulate(x, derivatives, coupling);
  if (derivatives) chain(slave, coupling);
  coupling.facing.resize(0, 3);
  coupling.dfacing.resize(0, 0);
  if (slave.at_corner) face(x, derivatives, coupling);
  return combine_aligned(moments_, *slave.multipliers, functions_, derivatives, coupling);
}

bool FacetIntegrator3d::find_pairs(const std::vector<Facet<LocalOrdinal>>& masters, const FacetReach& reach, const std::vector<Eigen::Vector3d>& x,
                                   FacetCoupling& coupling) {
  pairs_.clear();
  bool touches = false;
  distances_.assign(masters.size(), std::numeric_limits<double>::infinity());
  for (std::size_t f = 0; f < masters.size(); ++f) {
    const Facet<LocalOrdinal>& facet = masters[f];
    FacetVectors nodes;
    for (const LocalOrdinal node : facet) nodes.push_back(plane_.to_frame(x[node]));
    overlaps_.clear();
    find_overlaps(plane_.slave, nodes, overlaps_);
    double distance = std::numeric_limits<double>::max();
    for (const Overlap3d& overlap : overlaps_) distance = std::min(distance, overlap.distance);
    if (overlaps_.empty() || distance > reach.all) continue;
    distances_[f] = distance;
    touches = touches || distance <= reach.touch;
    boost::container::static_vector<Eigen::Index, 8> place;
    for (const LocalOrdinal node : facet) place.push_back(place_of(coupling.master, node));
    for (const Overlap3d& overlap : overlaps_) pairs_.push_back({nodes, place, overlap});
  }
  if (const auto kept = without_surfaces_behind(masters, distances_, reach.touch)) {
    coupling.master.clear();
    return find_pairs(*kept, reach, x, coupling);
  }
  return touches;
}

// A basis that is orthonormal over the covered part: with the rows sqrt(w) N of all points V = Q R, and L = R^-T N. Where edges coincide, round-off
// can turn a sliver of the fan over: its weights are then of that size below zero.
bool FacetIntegrator3d::choose_basis(Eigen::Index nodes) {
  Eigen::Index points = 0;
  for (const Pair& pair : pairs_) points += static_cast<Eigen::Index>(pair.overlap.points.size());
  Eigen::MatrixXd V(points, nodes);
  Eigen::Index row = 0;
  for (const Pair& pair : pairs_)
    for (const OverlapPoint& point : pair.overlap.points)
      V.row(row++) = std::sqrt(std::max(point.weight, 0.0)) * facet_values(static_cast<std::size_t>(nodes), point.xi).transpose();
  const Eigen::HouseholderQR<Eigen::MatrixXd> factors(V);
  const FacetMatrix R = factors.matrixQR().topRows(nodes).triangularView<Eigen::Upper>();
  const FacetMatrix identity = FacetMatrix::Identity(nodes, nodes);
  moments_.T = R.transpose();
  moments_.extrapolation = R.triangularView<Eigen::Upper>().solve(identity);
  basis_ = moments_.extrapolation.transpose();
  return basis_.allFinite();  // not where the cover is a point
}

void FacetIntegrator3d::accumulate(const std::vector<Eigen::Vector3d>& x, bool derivatives, const FacetCoupling& coupling) {
  const auto n = static_cast<Eigen::Index>(plane_.slave.size()), count = static_cast<Eigen::Index>(coupling.master.size());
  const Eigen::Index masses = FacetMoments::masses(n), rows = FacetMoments::rows(n, count);
  moments_.value.setZero(rows);
  moments_.whole = whole_facet(plane_, false).weights;
  moments_.whole_slope = [this] { return whole_facet(plane_, true).slope; };
  if (derivatives) raw_.setZero(rows, 6 * n + 3 * count);
  std::vector<Eigen::Index> to(static_cast<std::size_t>(FacetMoments::rows(n, 8)));
  for (const Pair& pair : pairs_) {
    integrate_segment(plane_.slave, normals_, pair.nodes, pair.overlap, basis_, derivatives, segment_);
    std::size_t r = 0;
    for (Eigen::Index q = 0; q < masses; ++q) to[r++] = q;
    for (Eigen::Index i = 0; i < n; ++i)
      for (const Eigen::Index place : pair.place) to[r++] = masses + i * count + place;
    for (Eigen::Index i = 0; i < n; ++i) to[r++] = masses + n * count + i;
    for (std::size_t q = 0; q < r; ++q) moments_.value[to[q]] += segment_.value[static_cast<Eigen::Index>(q)];
    if (!derivatives) continue;
    const auto add = [&](Eigen::Index from_column, Eigen::Index to_column) {
      for (std::size_t q = 0; q < r; ++q) raw_(to[q], to_column) += segment_.derivative(static_cast<Eigen::Index>(q), from_column);
    };
    for (Eigen::Index c = 0; c < 6 * n; ++c) add(c, c);
    for (std::size_t l = 0; l < pair.place.size(); ++l)
      for (Eigen::Index i = 0; i < 3; ++i) add(6 * n + 3 * static_cast<Eigen::Index>(l) + i, 6 * n + 3 * pair.place[l] + i);
  }
  if (!derivatives) return;
  std::vector<Eigen::Vector3d> vectors(plane_.slave.begin(), plane_.slave.end());
  vectors.insert(vectors.end(), normals_.begin(), normals_.end());
  for (const LocalOrdinal node : coupling.master) vectors.push_back(plane_.to_frame(x[node]));
  plane_.to_global(vectors, raw_);
}

// Columns: slave, masters, then the ring, which moves the normals and so the gap only.
void FacetIntegrator3d::chain(const SlaveFacetData& slave, FacetCoupling& coupling) {
  const auto n = static_cast<Eigen::Index>(slave.nodes.size()), count = static_cast<Eigen::Index>(coupling.master.size());
  auto& columns = coupling.columns;
  columns.assign(slave.nodes.begin(), slave.nodes.end());
  columns.insert(columns.end(), coupling.master.begin(), coupling.master.end());
  for (const NodalNormal* normal : slave.normals)
    for (const LocalOrdinal node : normal->columns) place_of(columns, node);
  moments_.moving_columns = 3 * (n + count);
  Eigen::MatrixXd& slope = moments_.slope;
  slope.setZero(raw_.rows(), 3 * static_cast<Eigen::Index>(columns.size()));
  slope.leftCols(3 * n) = raw_.leftCols(3 * n);
  slope.middleCols(3 * n, 3 * count) = raw_.rightCols(3 * count);
  for (Eigen::Index a = 0; a < n; ++a) {
    const NodalNormal& normal = *slave.normals[a];
    for (std::size_t c = 0; c < normal.columns.size(); ++c)
      slope.block(raw_.rows() - n, 3 * place_of(columns, normal.columns[c]), n, 3) +=
          raw_.block(raw_.rows() - n, 3 * (n + a), n, 3).lazyProduct(normal.derivative.middleCols(3 * static_cast<Eigen::Index>(c), 3));
  }
}

// FacetCoupling::facing. With m in the frame E of the plane, E^T m has the global components. The frame tilts with the plane and does not spin:
//   d(E^T m) = E^T dm + sum_i m_i de_i,   de_1 = -(dp . e_1) p,   de_2 = -(dp . e_2) p,   de_3 = dp.
void FacetIntegrator3d::face(const std::vector<Eigen::Vector3d>& x, bool derivatives, FacetCoupling& coupling) {
  const auto n = static_cast<Eigen::Index>(plane_.slave.size()), count = static_cast<Eigen::Index>(coupling.master.size());
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(3 * n);
  if (derivatives) raw_.setZero(3 * n, 3 * (n + count));
  for (const Pair& pair : pairs_) {
    integrate_facing(plane_.slave, pair.nodes, pair.overlap, derivatives, facing_);
    sum += facing_.value;
    if (!derivatives) continue;
    raw_.leftCols(3 * n) += facing_.derivative.leftCols(3 * n);
    for (std::size_t l = 0; l < pair.place.size(); ++l)
      raw_.middleCols<3>(3 * (n + pair.place[l])) += facing_.derivative.middleCols<3>(3 * (n + static_cast<Eigen::Index>(l)));
  }
  coupling.facing = sum.reshaped<Eigen::RowMajor>(n, 3) * plane_.frame;
  if (!derivatives) return;
  std::vector<Eigen::Vector3d> vectors(plane_.slave.begin(), plane_.slave.end());
  for (const LocalOrdinal node : coupling.master) vectors.push_back(plane_.to_frame(x[node]));
  plane_.to_global(vectors, raw_);
  coupling.dfacing.setZero(3 * n, 3 * static_cast<Eigen::Index>(coupling.columns.size()));
  const auto axes = plane_.frame.topRows<2>();
  const Eigen::Vector3d p = plane_.frame.row(2).transpose();
  for (Eigen::Index j = 0; j < n; ++j) {
    const Eigen::Vector3d m = sum.segment<3>(3 * j);
    auto slope = coupling.dfacing.middleRows<3>(3 * j);
    slope.leftCols(3 * (n + count)) = plane_.frame.transpose() * raw_.middleRows<3>(3 * j);
    const Eigen::Matrix<double, 3, 2> tilted = m.z() * axes.transpose() - p * m.head<2>().transpose();
    for (std::size_t a = 0; a < facet_corners(3, plane_.slave.size()); ++a)
      slope.middleCols<3>(3 * static_cast<Eigen::Index>(a)) += tilted * plane_.tilt[a] * plane_.frame;
  }
}

}  // namespace mortise
