#include <algorithm>

#include "mortise/shape/line3.hpp"
#include "nodal_normal.hpp"

namespace mortise {
namespace {

Eigen::Vector2d tangent(const NodeTangents& facet, const Positions<2>& x) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (std::size_t b = 0; b < facet.nodes.size(); ++b) sum += facet.slope(0, static_cast<Eigen::Index>(b)) * x[facet.nodes[b]];
  return sum;
}

// No number where the facet has no length.
Eigen::Vector2d facet_normal(const NodeTangents& facet, const Positions<2>& x) {
  const Eigen::Vector2d along = tangent(facet, x);
  return Eigen::Vector2d(along.y(), -along.x()) / along.norm();
}

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

bool average_normal(const NormalStencil& stencil, const Positions<2>& x, bool derivatives, NodalNormal& result) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (const NodeTangents& facet : stencil.facets) {
    if (!(tangent(facet, x).norm() > 0.0)) return false;
    sum += facet_normal(facet, x);
  }
  for (int i = 0; i < 2; ++i)
    if (stencil.projected[i]) sum[i] = 0.0;
  const double length = sum.norm();
  constexpr double none = 1e-6;  // facets folded onto one another
  if (!(length > none)) return false;
  result.normal = sum / length;
  for (const NodeTangents& facet : stencil.facets)
    if (!(result.normal.dot(facet_normal(facet, x)) > 0.0)) return false;
  result.columns = stencil.columns;
  if (!derivatives) return true;

  Eigen::Matrix2d project = (Eigen::Matrix2d::Identity() - result.normal * result.normal.transpose()) / length;
  for (int i = 0; i < 2; ++i)
    if (stencil.projected[i]) project.col(i).setZero();
  result.derivative.setZero(2, 2 * static_cast<Eigen::Index>(stencil.columns.size()));
  for (const NodeTangents& facet : stencil.facets) {
    const Eigen::Vector2d n = facet_normal(facet, x), t(-n.y(), n.x());
    // R (I - t t^T) = R n n^T, and R n = -t turned back: R maps t to n and n to -t
    const Eigen::Matrix2d slope = project * (-t * n.transpose()) / tangent(facet, x).norm();
    for (std::size_t b = 0; b < facet.nodes.size(); ++b) {
      const auto place = std::find(stencil.columns.begin(), stencil.columns.end(), facet.nodes[b]) - stencil.columns.begin();
      result.derivative.middleCols<2>(2 * place) += facet.slope(0, static_cast<Eigen::Index>(b)) * slope;
    }
  }
  return true;
}

}  // namespace mortise
