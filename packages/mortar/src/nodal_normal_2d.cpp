#include <algorithm>

#include "nodal_normal.hpp"

namespace mortise {

Eigen::Vector2d facet_normal(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  const Eigen::Vector2d travel = b - a;
  return Eigen::Vector2d(travel.y(), -travel.x()) / travel.norm();
}

bool average_normal(const NormalStencil& stencil, const Positions<2>& x, bool derivatives, NodalNormal& result) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (const auto& [a, b] : stencil.corners) {
    if (!((x[b] - x[a]).norm() > 0.0)) return false;
    sum += facet_normal(x[a], x[b]);
  }
  for (int i = 0; i < 2; ++i)
    if (stencil.projected[i]) sum[i] = 0.0;
  const double length = sum.norm();
  constexpr double none = 1e-6;  // facets folded onto one another
  if (!(length > none)) return false;
  result.normal = sum / length;
  for (const auto& [a, b] : stencil.corners)
    if (!(result.normal.dot(facet_normal(x[a], x[b])) > 0.0)) return false;
  result.columns = stencil.columns;
  if (!derivatives) return true;

  Eigen::Matrix2d project = (Eigen::Matrix2d::Identity() - result.normal * result.normal.transpose()) / length;
  for (int i = 0; i < 2; ++i)
    if (stencil.projected[i]) project.col(i).setZero();
  result.derivative.setZero(2, 2 * static_cast<Eigen::Index>(stencil.columns.size()));
  for (const auto& [a, b] : stencil.corners) {
    const Eigen::Vector2d n = facet_normal(x[a], x[b]), t(-n.y(), n.x());
    // R (I - t t^T) = R n n^T, and R n = -t turned back: R maps t to n and n to -t
    const Eigen::Matrix2d slope = project * (-t * n.transpose()) / (x[b] - x[a]).norm();
    const auto place = [&](LocalOrdinal node) {
      return 2 * (std::find(stencil.columns.begin(), stencil.columns.end(), node) - stencil.columns.begin());
    };
    result.derivative.middleCols<2>(place(b)) += slope;
    result.derivative.middleCols<2>(place(a)) -= slope;
  }
  return true;
}

}  // namespace mortise
