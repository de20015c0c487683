#include <algorithm>
#include <boost/container/small_vector.hpp>
#include <cmath>

#include "mortise/shape/line3.hpp"
#include "normals/nodal_normal.hpp"

namespace mortise {
namespace {

Eigen::Vector2d tangent(const NodeTangents& facet, const Positions<2>& x) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (std::size_t b = 0; b < facet.nodes.size(); ++b) sum += facet.slope(0, static_cast<Eigen::Index>(b)) * x[facet.nodes[b]];
  return sum;
}

// A facet's tangent at the node, and its unit normal: no number where it has no length.
struct Side {
  double length;
  Eigen::Vector2d normal;

  Side(const NodeTangents& facet, const Positions<2>& x) {
    const Eigen::Vector2d along = tangent(facet, x);
    length = along.norm();
    normal = Eigen::Vector2d(along.y(), -along.x()) / length;
  }
};

}  // namespace

template <>
NodeTangents tangents_at<2>(const Facet<LocalOrdinal>& facet, std::size_t a) {
  NodeTangents tangents;
  tangents.nodes = facet;
  tangents.slope.setZero(2, static_cast<Eigen::Index>(facet.size()));
  if (facet.size() == 2) {
    tangents.slope.row(0) << -1.0, 1.0;
    return tangents;
  }
  constexpr double reference[] = {-1.0, 1.0, 0.0};
  tangents.slope.row(0) = Eigen::Map<const Eigen::RowVector3d>(Line3::gradients(reference[a]).data());
  return tangents;
}

NormalStencil own_side(LocalOrdinal node, const NodeTangents& facet) {
  NormalStencil stencil;
  stencil.node = node;
  stencil.facets = {facet};
  stencil.columns.assign(facet.nodes.begin(), facet.nodes.end());
  return stencil;
}

// The body lies on the left of its facets, so the surface turns to the left where it is convex.
double turn_at(const NormalStencil& stencil, const Positions<2>& x) {
  if (stencil.facets.size() != 2 || stencil.projected[0] || stencil.projected[1]) return 0.0;
  const std::size_t ends_here = stencil.facets[0].nodes[1] == stencil.node ? 0 : 1;
  const Eigen::Vector2d before = tangent(stencil.facets[ends_here], x), behind = tangent(stencil.facets[1 - ends_here], x);
  return std::atan2(before.x() * behind.y() - before.y() * behind.x(), before.dot(behind));
}

// Half of it is the turn from the facet's normal to its free component, or the other way round where the facet starts at the node.
double mirrored_turn_at(const NormalStencil& stencil, const Positions<2>& x) {
  if (stencil.facets.size() != 1 || stencil.projected[0] == stencil.projected[1]) return 0.0;
  const Eigen::Vector2d normal = Side(stencil.facets.front(), x).normal;
  Eigen::Vector2d free = normal;
  free[stencil.projected[0] ? 0 : 1] = 0.0;
  const double turn = 2.0 * std::atan2(normal.x() * free.y() - normal.y() * free.x(), normal.dot(free));
  return stencil.facets.front().nodes[1] == stencil.node ? turn : -turn;
}

bool average_normal(const NormalStencil& stencil, const Positions<2>& x, bool derivatives, NodalNormal& result) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  boost::container::small_vector<const NodeTangents*, 2> facets;
  boost::container::small_vector<Side, 2> sides;
  for (std::size_t e = 0; e < stencil.facets.size(); ++e) {
    if (stencil.only && *stencil.only != e) continue;
    facets.push_back(&stencil.facets[e]);
    const Side& side = sides.emplace_back(stencil.facets[e], x);
    if (!(side.length > 0.0)) return false;
    sum += side.normal;
  }
  for (int i = 0; i < 2; ++i)
    if (stencil.projected[i]) sum[i] = 0.0;
  const double length = sum.norm();
  constexpr double none = 1e-6;  // facets folded onto one another
  if (!(length > none)) return false;
  result.normal = sum / length;
  for (const Side& side : sides)
    if (!(result.normal.dot(side.normal) > 0.0)) return false;
  result.columns = stencil.columns;
  if (!derivatives) return true;

  Eigen::Matrix2d project = (Eigen::Matrix2d::Identity() - result.normal * result.normal.transpose()) / length;
  for (int i = 0; i < 2; ++i)
    if (stencil.projected[i]) project.col(i).setZero();
  result.derivative.setZero(2, 2 * static_cast<Eigen::Index>(stencil.columns.size()));
  for (std::size_t e = 0; e < sides.size(); ++e) {
    const NodeTangents& facet = *facets[e];
    const Eigen::Vector2d &n = sides[e].normal, t(-n.y(), n.x());
    // R (I - t t^T) = R n n^T, and R n = -t turned back: R maps t to n and n to -t
    const Eigen::Matrix2d slope = project * (-t * n.transpose()) / sides[e].length;
    for (std::size_t b = 0; b < facet.nodes.size(); ++b) {
      const auto place = std::find(stencil.columns.begin(), stencil.columns.end(), facet.nodes[b]) - stencil.columns.begin();
      result.derivative.middleCols<2>(2 * place) += facet.slope(0, static_cast<Eigen::Index>(b)) * slope;
    }
  }
  return true;
}

void add_normal_curvature(const NormalStencil& stencil, const NodalNormal& normal, const Eigen::Vector2d& along, const Positions<2>& x,
                          const std::vector<LocalOrdinal>& columns, Eigen::MatrixXd& hessian) {
  if (stencil.projected[0] || stencil.projected[1]) return;
  const auto place = [&](LocalOrdinal node) { return 2 * (std::find(columns.begin(), columns.end(), node) - columns.begin()); };
  const Eigen::Vector2d turned(-normal.normal.y(), normal.normal.x());
  const Eigen::RowVectorXd angle = turned.transpose() * normal.derivative;
  for (std::size_t a = 0; a < normal.columns.size(); ++a)
    for (std::size_t b = 0; b < normal.columns.size(); ++b)
      hessian.block<2, 2>(place(normal.columns[a]), place(normal.columns[b])) -= along.dot(normal.normal) *
                                                                                 angle.segment<2>(2 * static_cast<Eigen::Index>(a)).transpose() *
                                                                                 angle.segment<2>(2 * static_cast<Eigen::Index>(b));
  const double share = along.dot(turned) / (stencil.only ? 1.0 : static_cast<double>(stencil.facets.size()));
  for (std::size_t e = 0; e < stencil.facets.size(); ++e) {
    if (stencil.only && *stencil.only != e) continue;
    const NodeTangents& facet = stencil.facets[e];
    const Side side(facet, x);
    const Eigen::Vector2d t(-side.normal.y(), side.normal.x()), v = -side.normal;
    const Eigen::Matrix2d curvature = -share * (t * v.transpose() + v * t.transpose()) / (side.length * side.length);
    for (std::size_t a = 0; a < facet.nodes.size(); ++a)
      for (std::size_t b = 0; b < facet.nodes.size(); ++b)
        hessian.block<2, 2>(place(facet.nodes[a]), place(facet.nodes[b])) +=
            facet.slope(0, static_cast<Eigen::Index>(a)) * facet.slope(0, static_cast<Eigen::Index>(b)) * curvature;
  }
}

}  // namespace mortise
