#include <Eigen/Geometry>
#include <algorithm>

#include "nodal_normal.hpp"

namespace mortise {

Eigen::Vector3d corner_normal(const Eigen::Vector3d& x, const Eigen::Vector3d& next, const Eigen::Vector3d& previous) {
  return (next - x).cross(previous - x).normalized();
}

bool average_normal(const NormalStencil& stencil, const Positions<3>& x, bool derivatives, NodalNormal& result) {
  const Eigen::Vector3d& here = x[stencil.node];
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const auto& [next, previous] : stencil.corners) {
    const Eigen::Vector3d u = x[next] - here, v = x[previous] - here;
    if (!(u.cross(v).norm() > 1e-12 * u.norm() * v.norm())) return false;
    sum += corner_normal(here, x[next], x[previous]);
  }
  for (int i = 0; i < 3; ++i)
    if (stencil.projected[i]) sum[i] = 0.0;
  const double length = sum.norm();
  constexpr double none = 1e-6;  // facets folded onto one another
  if (!(length > none)) return false;
  const Eigen::Vector3d normal = sum / length;
  result.normal = normal;
  for (const auto& [next, previous] : stencil.corners)
    if (!(normal.dot(corner_normal(here, x[next], x[previous])) > 0.0)) return false;
  result.columns = stencil.columns;
  if (!derivatives) return true;

  Eigen::Matrix3d project = (Eigen::Matrix3d::Identity() - normal * normal.transpose()) / length;
  for (int i = 0; i < 3; ++i)
    if (stencil.projected[i]) project.col(i).setZero();
  result.derivative.setZero(3, 3 * static_cast<Eigen::Index>(stencil.columns.size()));
  const auto block = [&](LocalOrdinal node) {
    const auto place = std::find(stencil.columns.begin(), stencil.columns.end(), node) - stencil.columns.begin();
    return result.derivative.middleCols(3 * place, 3);
  };
  for (const auto& [next, previous] : stencil.corners) {
    const Eigen::Vector3d u = x[next] - here, v = x[previous] - here, c = u.cross(v);
    const Eigen::Vector3d n = c.normalized();
    const Eigen::Matrix3d slope = project * (Eigen::Matrix3d::Identity() - n * n.transpose()) / c.norm();  // times dc = du x v + u x dv
    Eigen::Matrix3d of_next, of_previous;
    for (int i = 0; i < 3; ++i) {
      of_next.col(i) = slope * Eigen::Vector3d::Unit(i).cross(v);
      of_previous.col(i) = slope * u.cross(Eigen::Vector3d::Unit(i));
    }
    block(next) += of_next;
    block(previous) += of_previous;
    block(stencil.node) -= of_next + of_previous;
  }
  return true;
}

}  // namespace mortise
