#include "coupling/facet_coupling_2d.hpp"

#include <algorithm>
#include <limits>

#include "integrals/whole_facet.hpp"
#include "search/surface_search.hpp"
#include "search/yielding_sides.hpp"
#include "slave/facet_alignment.hpp"

namespace mortise {
namespace {

Point2<double> point(const Eigen::Vector2d& x) { return {x.x(), x.y()}; }

LinePoints line_on(const Facet<LocalOrdinal>& nodes, const Positions<2>& x) {
  LinePoints line;
  for (const LocalOrdinal node : nodes) line.push_back(point(x[node]));
  return line;
}

// xi of the nodes of a line.
constexpr double reference[] = {-1.0, 1.0, 0.0};

template <int n>
void set_basis(const Interval& covered, FacetMoments& moments) {
  moments.T.resize(n, n);
  moments.extrapolation.resize(n, n);
  const double width = covered.high - covered.low, place[] = {covered.low, covered.high, 0.5 * (covered.low + covered.high)};
  for (int j = 0; j < n; ++j) {
    const auto N = LineShape<n>::values(place[j]);
    const double from_low = (reference[j] - covered.low) / width;
    const auto L = interval_functions<n>(from_low, 1.0 - from_low);
    for (int a = 0; a < n; ++a) {
      moments.T(a, j) = N[a];
      moments.extrapolation(j, a) = L[a];
    }
  }
}

// Slave nodes, ring, master nodes; the place of the first master node.
Eigen::Index place_columns(const SlaveFacetData& slave, const std::vector<LocalOrdinal>& master, std::vector<LocalOrdinal>& columns) {
  columns.assign(slave.nodes.begin(), slave.nodes.end());
  for (const NodalNormal* normal : slave.normals)
    for (const LocalOrdinal node : normal->columns) place_of(columns, node);
  const auto first_master = static_cast<Eigen::Index>(columns.size());
  columns.insert(columns.end(), master.begin(), master.end());
  return first_master;
}

}  // namespace

FacetIntegrator2d::FacetIntegrator2d(const InterfaceMeasure& measure, const MortarOptions& options)
    : measure_(measure),
      functions_{options.coupling->has_dual_multipliers(), options.coupling->has_dual_gap(options.gap_weighting), 2},
      rule_(gauss_legendre(options.gauss_points)),
      rule_of_quadratic_(gauss_legendre(std::max(options.gauss_points, 3))) {}

bool FacetIntegrator2d::integrate(const SlaveFacetData& slave, const std::vector<Facet<LocalOrdinal>>& masters, const FacetReach& reach,
                                  const Positions<2>& x, bool derivatives, FacetCoupling& coupling) {
  coupling.slave = slave.nodes;
  coupling.columns.clear();
  if (!find_pairs(slave, masters, reach, x, coupling.master)) return false;
  Interval covered = pairs_.front().overlap.interval;
  for (const Pair& pair : pairs_) {
    covered.low = std::min(covered.low, pair.overlap.interval.low);
    covered.high = std::max(covered.high, pair.overlap.interval.high);
  }
  choose_basis(covered);
  accumulate(covered, coupling.master.size(), derivatives);
  if (derivatives) chain(slave, coupling);
  coupling.facing.resize(0, 2);
  coupling.dfacing.resize(0, 0);
  if (slave.at_corner) face(slave, derivatives, coupling);
  return combine_aligned(moments_, *slave.multipliers, functions_, derivatives, coupling);
}

bool FacetIntegrator2d::curve(const SlaveFacetData& slave, const std::vector<Facet<LocalOrdinal>>& masters, const FacetReach& reach,
                              const Positions<2>& x, const FacetVector& pressures, GapCurvature& result) {
  if (!find_pairs(slave, masters, reach, x, master_)) return false;
  FacetVector of_shape = slave.multipliers->share.transpose() * pressures;
  if (const NonNegativeBasis* basis = non_negative_basis(2, slave.nodes.size())) of_shape = basis->of_shape.transpose() * of_shape;
  const auto n = static_cast<Eigen::Index>(slave.nodes.size()), size = 4 * n + 2 * static_cast<Eigen::Index>(master_.size());
  Eigen::VectorXd gradient = Eigen::VectorXd::Zero(size);
  Eigen::MatrixXd hessian = Eigen::MatrixXd::Zero(size, size);
  boost::container::static_vector<Eigen::Index, 18> to;
  for (const Pair& pair : pairs_) {
    const WeightedGap gap = weighted_gap(line_, pair.line, pair.overlap, of_shape, measure_, rule());
    to.clear();
    for (Eigen::Index column = 0; column < 4 * n; ++column) to.push_back(column);
    for (const Eigen::Index place : pair.place)
      for (int i = 0; i < 2; ++i) to.push_back(4 * n + 2 * place + i);
    for (Eigen::Index r = 0; r < gap.gradient.size(); ++r) {
      gradient[to[static_cast<std::size_t>(r)]] += gap.gradient[r];
      for (Eigen::Index c = 0; c < gap.gradient.size(); ++c)
        hessian(to[static_cast<std::size_t>(r)], to[static_cast<std::size_t>(c)]) += gap.hessian(r, c);
    }
  }
  const Eigen::Index first_master = place_columns(slave, master_, result.columns);
  const auto columns = 2 * static_cast<Eigen::Index>(result.columns.size());
  Eigen::MatrixXd slope = Eigen::MatrixXd::Zero(size, columns);
  slope.topLeftCorner(2 * n, 2 * n).setIdentity();
  slope.bottomRightCorner(size - 4 * n, columns - 2 * first_master).setIdentity();
  for (Eigen::Index node = 0; node < n; ++node) {
    const NodalNormal& normal = *slave.normals[static_cast<std::size_t>(node)];
    for (std::size_t c = 0; c < normal.columns.size(); ++c)
      slope.block<2, 2>(2 * (n + node), 2 * place_of(result.columns, normal.columns[c])) =
          normal.derivative.middleCols<2>(2 * static_cast<Eigen::Index>(c));
  }
  result.hessian = slope.transpose() * hessian * slope;
  for (Eigen::Index node = 0; node < n; ++node)
    add_normal_curvature(*slave.stencils[static_cast<std::size_t>(node)], *slave.normals[static_cast<std::size_t>(node)],
                         gradient.segment<2>(2 * (n + node)), x, result.columns, result.hessian);
  return true;
}

bool FacetIntegrator2d::find_pairs(const SlaveFacetData& slave, const std::vector<Facet<LocalOrdinal>>& masters, const FacetReach& reach,
                                   const Positions<2>& x, std::vector<LocalOrdinal>& master_nodes) {
  line_.x = line_on(slave.nodes, x);
  line_.normal.clear();
  for (const NodalNormal* normal : slave.normals) line_.normal.push_back(point(normal->normal));
  master_nodes.clear();
  pairs_.clear();
  bool touches = false;
  std::vector<Facet<LocalOrdinal>> near;
  std::vector<double> distances;
  for (const Facet<LocalOrdinal>& nodes : masters)
    if (const double distance = facet_distance(line_.x, line_on(nodes, x)); distance <= reach.all) {
      near.push_back(nodes);
      distances.push_back(distance);
    }
  const std::vector<char> yields = slave.goes_on ? yielding_facets(slave.nodes, near, x) : std::vector<char>(near.size(), 0);
  std::vector<double> overlapping(near.size(), std::numeric_limits<double>::infinity());
  for (std::size_t f = 0; f < near.size(); ++f) {
    if (yields[f] != 0) continue;
    const Facet<LocalOrdinal>& nodes = near[f];
    const double distance = distances[f];
    Pair pair;
    pair.line = line_on(nodes, x);
    const auto overlap = find_overlap(line_, pair.line);
    if (!overlap) continue;
    overlapping[f] = distance;
    touches = touches || distance <= reach.touch;
    pair.overlap = *overlap;
    for (const LocalOrdinal node : nodes) pair.place.push_back(place_of(master_nodes, node));
    pairs_.push_back(pair);
  }
  if (const auto kept = without_surfaces_behind(near, overlapping, reach.touch)) return find_pairs(slave, *kept, reach, x, master_nodes);
  if (!touches) pairs_.clear();
  return touches;
}

// The functions L belong to the covered interval; T^-T is what their extrapolation from there to the nodes makes of them.
void FacetIntegrator2d::choose_basis(const Interval& covered) {
  if (line_.x.size() == 2)
    set_basis<2>(covered, moments_);
  else
    set_basis<3>(covered, moments_);
}

void FacetIntegrator2d::accumulate(const Interval& covered, std::size_t masters, bool derivatives) {
  const auto n = static_cast<Eigen::Index>(line_.x.size()), count = static_cast<Eigen::Index>(masters);
  const Eigen::Index masses = FacetMoments::masses(n), rows = FacetMoments::rows(n, count);
  moments_.value.setZero(rows);
  moments_.whole = whole_facet(line_.x, measure_, false).weights;
  moments_.whole_slope = [this] { return whole_facet(line_.x, measure_, true).slope; };
  if (derivatives) raw_.setZero(rows, 4 * n + 2 * count);
  boost::container::static_vector<Eigen::Index, 18> to;
  for (const Pair& pair : pairs_) {
    integrate_segment(line_, pair.line, pair.overlap, covered, measure_, rule(), derivatives, segment_);
    to.clear();
    for (Eigen::Index q = 0; q < masses; ++q) to.push_back(q);
    for (Eigen::Index i = 0; i < n; ++i)
      for (const Eigen::Index place : pair.place) to.push_back(masses + i * count + place);
    for (Eigen::Index i = 0; i < n; ++i) to.push_back(masses + n * count + i);
    for (std::size_t q = 0; q < to.size(); ++q) {
      const auto from = static_cast<Eigen::Index>(q);
      moments_.value[to[q]] += segment_.value[from];
      if (!derivatives) continue;
      raw_.row(to[q]).head(4 * n) += segment_.derivative.row(from).head(4 * n);
      for (std::size_t l = 0; l < pair.place.size(); ++l)
        raw_.block<1, 2>(to[q], 4 * n + 2 * pair.place[l]) += segment_.derivative.block<1, 2>(from, 4 * n + 2 * static_cast<Eigen::Index>(l));
    }
  }
}

void FacetIntegrator2d::chain(const SlaveFacetData& slave, FacetCoupling& coupling) {
  first_master_ = place_columns(slave, coupling.master, coupling.columns);
  chain_columns(slave, coupling, raw_, moments_.slope);
  moments_.moving_columns = moments_.slope.cols();
}

// From derivatives with respect to slave positions, slave normals, masters to those with respect to the coupling's columns.
void FacetIntegrator2d::chain_columns(const SlaveFacetData& slave, FacetCoupling& coupling, const Eigen::MatrixXd& raw,
                                      Eigen::MatrixXd& slope) const {
  auto& columns = coupling.columns;
  const auto n = static_cast<Eigen::Index>(slave.nodes.size()), masters = static_cast<Eigen::Index>(coupling.master.size());
  slope.setZero(raw.rows(), 2 * static_cast<Eigen::Index>(columns.size()));
  slope.leftCols(2 * n) = raw.leftCols(2 * n);
  slope.middleCols(2 * first_master_, 2 * masters) = raw.rightCols(2 * masters);
  for (Eigen::Index node = 0; node < n; ++node) {
    const NodalNormal& normal = *slave.normals[static_cast<std::size_t>(node)];
    for (std::size_t c = 0; c < normal.columns.size(); ++c)
      slope.middleCols<2>(2 * place_of(columns, normal.columns[c])).noalias() +=
          raw.middleCols<2>(2 * (n + node)) * normal.derivative.middleCols<2>(2 * static_cast<Eigen::Index>(c));
  }
}

// FacetCoupling::facing.
void FacetIntegrator2d::face(const SlaveFacetData& slave, bool derivatives, FacetCoupling& coupling) {
  const auto n = static_cast<Eigen::Index>(slave.nodes.size()), masters = static_cast<Eigen::Index>(coupling.master.size());
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(2 * n);
  if (derivatives) raw_.setZero(2 * n, 4 * n + 2 * masters);
  for (const Pair& pair : pairs_) {
    integrate_facing(line_, pair.line, pair.overlap, measure_, rule(), derivatives, facing_);
    sum += facing_.value;
    if (!derivatives) continue;
    raw_.leftCols(4 * n) += facing_.derivative.leftCols(4 * n);
    for (std::size_t l = 0; l < pair.place.size(); ++l)
      raw_.middleCols<2>(4 * n + 2 * pair.place[l]) += facing_.derivative.middleCols<2>(4 * n + 2 * static_cast<Eigen::Index>(l));
  }
  coupling.facing = sum.reshaped<Eigen::RowMajor>(n, 2);
  if (derivatives) chain_columns(slave, coupling, raw_, coupling.dfacing);
}

}  // namespace mortise
