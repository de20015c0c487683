#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <vector>

#include "mortise/shape/quadrilateral8.hpp"
#include "mortise/shape/triangle6.hpp"
#include "normals/nodal_normal.hpp"

namespace mortise {
namespace {

// t_1, t_2
std::array<Eigen::Vector3d, 2> tangents(const NodeTangents& facet, const Positions<3>& x) {
  std::array<Eigen::Vector3d, 2> sum = {Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
  for (std::size_t b = 0; b < facet.nodes.size(); ++b)
    for (int i = 0; i < 2; ++i) sum[i] += facet.slope(i, static_cast<Eigen::Index>(b)) * x[facet.nodes[b]];
  return sum;
}

template <class Shape>
NodeTangents slopes_at(const Facet<LocalOrdinal>& facet, std::size_t a) {
  NodeTangents result;
  const auto gradients = Shape::gradients(Shape::node_positions[a]);
  for (std::size_t b = 0; b < facet.size(); ++b) {
    const Eigen::Vector2d slope(gradients[b][0], gradients[b][1]);
    if (slope.isZero(0.0)) continue;
    result.nodes.push_back(facet[b]);
    result.slope.conservativeResize(2, static_cast<Eigen::Index>(result.nodes.size()));
    result.slope.rightCols<1>() = slope;
  }
  return result;
}

}  // namespace

template <>
NodeTangents tangents_at<3>(const Facet<LocalOrdinal>& facet, std::size_t a) {
  const std::size_t count = facet.size();
  if (count == 6) return slopes_at<Triangle6>(facet, a);
  if (count == 8) return slopes_at<Quadrilateral8>(facet, a);
  NodeTangents result;
  result.nodes = {facet[a], facet[(a + 1) % count], facet[(a + count - 1) % count]};
  result.slope.resize(2, 3);
  result.slope << -1.0, 1.0, 0.0, -1.0, 0.0, 1.0;
  return result;
}

// Two facets meet at an edge where they have another node in common. They turn away from one another by the angle of their normals; each then lies
// behind the other's plane, from the node towards the mean of its nodes.
double turn_at(const NormalStencil& stencil, const Positions<3>& x) {
  const auto inwards = [&](const NodeTangents& facet) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const LocalOrdinal node : facet.nodes) sum += x[node] - x[stencil.node];
    return Eigen::Vector3d(sum.normalized());
  };
  double outwards = 0.0, back = 0.0;
  const auto meet = [&](const Eigen::Vector3d& n_a, const Eigen::Vector3d& t_a, const Eigen::Vector3d& n_b, const Eigen::Vector3d& t_b) {
    const double angle = std::atan2(n_a.cross(n_b).norm(), n_a.dot(n_b));
    double& most = n_a.dot(t_b) + n_b.dot(t_a) < 0.0 ? outwards : back;
    most = std::max(most, angle);
  };
  std::vector<Eigen::Vector3d> n, t;
  for (const NodeTangents& facet : stencil.facets) {
    const auto [u, v] = tangents(facet, x);
    n.push_back(u.cross(v).normalized());
    t.push_back(inwards(facet));
  }
  for (std::size_t a = 0; a < n.size(); ++a) {
    const auto& nodes = stencil.facets[a].nodes;
    for (std::size_t b = 0; b < a; ++b)
      if (std::any_of(stencil.facets[b].nodes.begin(), stencil.facets[b].nodes.end(),
                      [&](LocalOrdinal node) { return node != stencil.node && std::find(nodes.begin(), nodes.end(), node) != nodes.end(); }))
        meet(n[a], t[a], n[b], t[b]);
    for (int i = 0; i < 3; ++i) {
      if (!stencil.projected[i]) continue;
      Eigen::Vector3d image = n[a], inwards_image = t[a];
      image[i] = -image[i];
      inwards_image[i] = -inwards_image[i];
      meet(n[a], t[a], image, inwards_image);
    }
  }
  return outwards - back;
}

bool average_normal(const NormalStencil& stencil, const Positions<3>& x, bool derivatives, NodalNormal& result) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const NodeTangents& facet : stencil.facets) {
    const auto [u, v] = tangents(facet, x);
    if (!(u.cross(v).norm() > 1e-12 * u.norm() * v.norm())) return false;
    sum += u.cross(v).normalized();
  }
  for (int i = 0; i < 3; ++i)
    if (stencil.projected[i]) sum[i] = 0.0;
  const double length = sum.norm();
  constexpr double none = 1e-6;  // facets folded onto one another
  if (!(length > none)) return false;
  const Eigen::Vector3d normal = sum / length;
  result.normal = normal;
  for (const NodeTangents& facet : stencil.facets) {
    const auto [u, v] = tangents(facet, x);
    if (!(normal.dot(u.cross(v).normalized()) > 0.0)) return false;
  }
  result.columns = stencil.columns;
  if (!derivatives) return true;

  Eigen::Matrix3d project = (Eigen::Matrix3d::Identity() - normal * normal.transpose()) / length;
  for (int i = 0; i < 3; ++i)
    if (stencil.projected[i]) project.col(i).setZero();
  result.derivative.setZero(3, 3 * static_cast<Eigen::Index>(stencil.columns.size()));
  for (const NodeTangents& facet : stencil.facets) {
    const auto [u, v] = tangents(facet, x);
    const Eigen::Vector3d c = u.cross(v), n = c.normalized();
    const Eigen::Matrix3d slope = project * (Eigen::Matrix3d::Identity() - n * n.transpose()) / c.norm();  // times dc = du x v + u x dv
    Eigen::Matrix3d of_u, of_v;
    for (int i = 0; i < 3; ++i) {
      of_u.col(i) = slope * Eigen::Vector3d::Unit(i).cross(v);
      of_v.col(i) = slope * u.cross(Eigen::Vector3d::Unit(i));
    }
    for (std::size_t b = 0; b < facet.nodes.size(); ++b) {
      const auto place = std::find(stencil.columns.begin(), stencil.columns.end(), facet.nodes[b]) - stencil.columns.begin();
      const auto column = static_cast<Eigen::Index>(b);
      result.derivative.middleCols(3 * place, 3) += facet.slope(0, column) * of_u + facet.slope(1, column) * of_v;
    }
  }
  return true;
}

}  // namespace mortise
