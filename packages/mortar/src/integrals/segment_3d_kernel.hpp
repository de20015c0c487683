#pragma once
// The kernel of the integrals over an overlap in 3D, for any two shapes of facets.

#include <Eigen/LU>
#include <array>
#include <cmath>
#include <vector>

#include "integrals/segment_3d_slaves.hpp"
#include "integrals/triangle_points.hpp"
#include "mortise/shape/quadrature.hpp"
#include "mortise/shape/quadrilateral4.hpp"
#include "mortise/shape/quadrilateral8.hpp"
#include "mortise/shape/triangle3.hpp"
#include "mortise/shape/triangle6.hpp"

namespace mortise {

/// A facet at a point of integration: its functions and their slopes on the plane.
template <class Shape>
struct AtPoint {
  static constexpr int nodes = Shape::nodes;
  Eigen::Matrix<double, nodes, 1> N;
  Eigen::Matrix<double, 2, nodes> slope;  // dN_a / ds

  AtPoint(const Eigen::Matrix<double, 2, nodes>& x, const Eigen::Vector2d& xi) {
    const std::array<double, 2> at = {xi[0], xi[1]};
    const auto values = Shape::values(at);
    const auto gradients = Shape::gradients(at);
    Eigen::Matrix<double, 2, nodes> reference;
    for (int a = 0; a < nodes; ++a) {
      N[a] = values[a];
      reference.col(a) << gradients[a][0], gradients[a][1];
    }
    const Eigen::Matrix2d jacobian = x * reference.transpose();  // ds / dxi
    slope.noalias() = jacobian.inverse().transpose() * reference;
  }
};

template <int nodes>
Eigen::Matrix<double, 3, nodes> columns_of(const FacetVectors& vectors) {
  Eigen::Matrix<double, 3, nodes> result;
  for (int a = 0; a < nodes; ++a) result.col(a) = vectors[a];
  return result;
}

/// All integrals f at a point are functions of xi(s, X) and eta(s, Y), which obey sum N_a(xi) X_a = s and sum N_l(eta) Y_l = s. Let f_S =
/// df/dxi dxi/ds and f_M = df/deta deta/ds be the slopes on the plane. Then
///   df = (f_S + f_M) . ds - f_S . sum N_a dX_a - f_M . sum N_l dY_l  (+ what g depends on directly: normals and heights).
/// In this ds is the sum of the shares times dv of the triangle's vertices, which move as vertex_parts() says. The gradients (two components per
/// integral) are kept one after the other, so that each of these terms is one long vector times a number.
template <class Slave, class Master>
class Integrator {
  static constexpr int n = Slave::nodes, m = Master::nodes;
  static constexpr int masses = n * (n + 1) / 2, couplings = n * m, rows = masses + couplings + n, first_gap = masses + couplings;
  using Gradients = Eigen::Matrix<double, 2 * rows, 1>;  // 2 r, 2 r + 1: of integral r

 public:
  Integrator(const FacetVectors& slave, const FacetVectors& normals, const FacetVectors& master, const Eigen::MatrixXd& basis)
      : x_(columns_of<n>(slave)), normal_(columns_of<n>(normals)), y_(columns_of<m>(master)), basis_(basis) {}

  void values(const Overlap3d& overlap, SegmentIntegrals3d& result) const {
    Eigen::Matrix<double, rows, 1> sum = Eigen::Matrix<double, rows, 1>::Zero();
    const Eigen::Matrix<double, 2, n> X = x_.template topRows<2>();
    const Eigen::Matrix<double, 2, m> Y = y_.template topRows<2>();
    for (const OverlapPoint& point : overlap.points) {
      const AtPoint<Slave> slave(X, point.xi);
      const AtPoint<Master> master(Y, point.eta);
      const Eigen::Vector3d normal = normal_ * slave.N;
      add_values(basis_ * slave.N, master.N, normal.z() / normal.norm() * point.height, point.weight, sum);
    }
    result.value = sum;
  }

  void derivatives(const FacetVectors& slave_nodes, const FacetVectors& master_nodes, const Overlap3d& overlap, SegmentIntegrals3d& result) {
    overlap_ = &overlap;
    const Eigen::Matrix<double, 2, n> X = x_.template topRows<2>();
    const Eigen::Matrix<double, 2, m> Y = y_.template topRows<2>();
    const auto vertices = static_cast<int>(overlap.polygon.size());
    std::array<Eigen::Vector2d, 17> position;
    std::array<Gradients, 17> of_vertex;
    position[vertices].setZero();
    for (int v = 0; v < vertices; ++v) {
      position[v] = overlap.polygon[v].position;
      position[vertices] += position[v] / vertices;
    }
    for (int v = 0; v <= vertices; ++v) of_vertex[v].setZero();
    for (Gradients& one : of_node_) one.setZero();
    of_normal_.setZero();
    of_height_.setZero();
    Eigen::Matrix<double, rows, 1> sum = Eigen::Matrix<double, rows, 1>::Zero();

    const auto& rule = triangle_points(n);
    for (std::size_t t = 0; t < overlap.triangles.size(); ++t) {
      const auto& corner = overlap.triangles[t];
      Eigen::Matrix<double, rows, 1> of_unit_area = Eigen::Matrix<double, rows, 1>::Zero();  // it may have none, and grow
      for (std::size_t q = 0; q < rule.size(); ++q) {
        const OverlapPoint& point = overlap.points[t * rule.size() + q];
        add_point(AtPoint<Slave>(X, point.xi), AtPoint<Master>(Y, point.eta), point, rule[q].weight, of_unit_area);
        for (int k = 0; k < 3; ++k) of_vertex[corner[k]] += rule[q].share[k] * (from_slave_ + from_master_);
      }
      sum += doubled_area(position[corner[0]], position[corner[1]], position[corner[2]]) * of_unit_area;
      // d(2A) = dv_k . (v_j - v_i turned by +90 degrees), k, i, j in turn
      for (int k = 0; k < 3; ++k) {
        const Eigen::Vector2d edge = position[corner[(k + 2) % 3]] - position[corner[(k + 1) % 3]];
        for (int r = 0; r < rows; ++r) of_vertex[corner[k]].template segment<2>(2 * r) += of_unit_area[r] * Eigen::Vector2d(-edge.y(), edge.x());
      }
    }
    result.value = sum;

    PlanePolygon first, second;
    for (const int a : overlap.slave_part) first.push_back(slave_nodes[a].template head<2>());
    for (const int l : overlap.master_part) second.push_back(master_nodes[l].template head<2>());
    for (int v = 0; v < vertices; ++v) {
      of_vertex[v] += of_vertex[vertices] / vertices;  // the centre is their mean; without use in a single triangle, then 0
      const ClipVertex& vertex = overlap.polygon[v];
      if (const auto node = vertex_node(vertex, first, second)) {
        of_polygon_node(*node) += of_vertex[v];
        continue;
      }
      const EdgeCrossing crossing = edge_crossing(vertex, first, second);
      if (crossing.nearly_parallel()) {
        const int end = vertex.second_leaves ? (v + 1) % vertices : (v + vertices - 1) % vertices;
        add_nearly_parallel(crossing, of_vertex[v], position[v], position[end], vertex.second_leaves, slave_nodes, master_nodes);
        continue;
      }
      for (const VertexPart& part : vertex_parts(crossing))
        for (int r = 0; r < rows; ++r)
          of_polygon_node(part.node).template segment<2>(2 * r) += part.slope.transpose() * of_vertex[v].template segment<2>(2 * r);
    }
    hand_out(result);
  }

 private:
  using ValuesOfSlave = Eigen::Matrix<double, n, 1>;
  using ValuesOfMaster = Eigen::Matrix<double, m, 1>;

  // Nodes of the clipped polygons: those of the slave's part, then those of the master's.
  Gradients& of_polygon_node(int node) {
    const auto slaves = static_cast<int>(overlap_->slave_part.size());
    return of_node_[node < slaves ? overlap_->slave_part[node] : n + overlap_->master_part[node - slaves]];
  }

  static void add_values(const ValuesOfSlave& L, const ValuesOfMaster& N, double gap, double weight, Eigen::Matrix<double, rows, 1>& sum) {
    int r = 0;
    for (int i = 0; i < n; ++i)
      for (int j = i; j < n; ++j) sum[r++] += weight * L[i] * L[j];
    for (int i = 0; i < n; ++i)
      for (int l = 0; l < m; ++l) sum[r++] += weight * L[i] * N[l];
    for (int i = 0; i < n; ++i) sum[r++] += weight * L[i] * gap;
  }

  // Adds the contribution of the point to a triangle whose doubled area is 1, and its motion in this one.
  void add_point(const AtPoint<Slave>& slave, const AtPoint<Master>& master, const OverlapPoint& point, double weight_of_unit_area,
                 Eigen::Matrix<double, rows, 1>& of_unit_area) {
    const double weight = point.weight;
    const Eigen::Vector3d normal = normal_ * slave.N;
    const double length = normal.norm(), cosine = normal.z() / length, gap = cosine * point.height;
    const ValuesOfSlave L = basis_ * slave.N;
    const Eigen::Matrix<double, 2, n> G = slave.slope * basis_.transpose();
    const Eigen::Vector3d gap_of_normal = point.height / length * (Eigen::Vector3d::UnitZ() - cosine / length * normal);  // dg / dn
    const Eigen::Vector2d gap_slave = slave.slope * (normal_.transpose() * gap_of_normal - cosine * x_.row(2).transpose());
    const Eigen::Vector2d gap_master = cosine * (master.slope * y_.row(2).transpose());
    add_values(L, master.N, gap, weight_of_unit_area, of_unit_area);

    int r = 0;
    for (int i = 0; i < n; ++i)
      for (int j = i; j < n; ++j) from_slave_.template segment<2>(2 * r++) = weight * (L[j] * G.col(i) + L[i] * G.col(j));
    for (int i = 0; i < n; ++i)
      for (int l = 0; l < m; ++l) {
        from_slave_.template segment<2>(2 * r) = weight * master.N[l] * G.col(i);
        from_master_.template segment<2>(2 * r++) = weight * L[i] * master.slope.col(l);
      }
    for (int i = 0; i < n; ++i) {
      from_slave_.template segment<2>(2 * r) = weight * (gap * G.col(i) + L[i] * gap_slave);
      from_master_.template segment<2>(2 * r++) = weight * L[i] * gap_master;
    }
    for (int a = 0; a < n; ++a) of_node_[a] -= slave.N[a] * from_slave_;
    constexpr int with_master = 2 * (rows - masses);
    for (int l = 0; l < m; ++l) of_node_[n + l].template tail<with_master>() -= master.N[l] * from_master_.template tail<with_master>();
    for (int a = 0; a < n; ++a) {
      of_normal_.template middleCols<3>(3 * a) += (weight * slave.N[a]) * L * gap_of_normal.transpose();
      of_height_.col(a) -= (weight * cosine * slave.N[a]) * L;
    }
    for (int l = 0; l < m; ++l) of_height_.col(n + l) += (weight * cosine * master.N[l]) * L;
  }

  // A crossing v of edges at a small angle moves far when they move little. While it slides along the first edge by ds (b - a) it only
  // changes the area beside the second one. That edge ends at the polygon's vertex e = v + k (m - l); the sign is + if the polygon leaves v along it,
  // else -. The change of an integral is
  //   dI = ds (b - a) x (+-(e - v)) int_0^1 f(v + s (e - v)) (1 - s) ds,
  //   ds = -w . (dx_first - dx_second) / (w . (b - a)),   w . (b - a) = (m - l) x (b - a),
  // in which the angle cancels. The derivative of the sum over the points of integration has the error of the rule divided by the angle instead.
  void add_nearly_parallel(const EdgeCrossing& crossing, const Gradients& of_vertex, const Eigen::Vector2d& v, const Eigen::Vector2d& end,
                           bool leaves, const FacetVectors& slave_nodes, const FacetVectors& master_nodes) {
    Eigen::Matrix<double, rows, 1> beside = Eigen::Matrix<double, rows, 1>::Zero();
    static const std::vector<LinePoint> rule = gauss_legendre(3);
    const Eigen::Matrix<double, 2, n> X = x_.template topRows<2>();
    const Eigen::Matrix<double, 2, m> Y = y_.template topRows<2>();
    for (const LinePoint& point : rule) {
      const double share = 0.5 * (1.0 + point.xi);
      const Eigen::Vector2d s = v + share * (end - v), xi = facet_coordinates(slave_nodes, overlap_->slave_part, s),
                            eta = facet_coordinates(master_nodes, overlap_->master_part, s);
      const AtPoint<Slave> slave(X, xi);
      const AtPoint<Master> master(Y, eta);
      const Eigen::Vector3d normal = normal_ * slave.N;
      const double gap = normal.z() / normal.norm() * (height_at(master_nodes, eta) - height_at(slave_nodes, xi));
      add_values(basis_ * slave.N, master.N, gap, 0.5 * point.weight * (1.0 - share), beside);
    }
    const double length = (end - v).dot(crossing.other) / crossing.other.squaredNorm();
    beside *= leaves ? -length : length;
    const Eigen::Vector2d across = crossing.across();
    for (int r = 0; r < rows; ++r) {
      const Eigen::Vector2d sliding = beside[r] * across, staying = of_vertex.template segment<2>(2 * r) - sliding;
      of_polygon_node(crossing.first_nodes[0]).template segment<2>(2 * r) += (1.0 - crossing.t) * staying;
      of_polygon_node(crossing.first_nodes[1]).template segment<2>(2 * r) += crossing.t * staying;
      of_polygon_node(crossing.second_nodes[0]).template segment<2>(2 * r) += (1.0 - crossing.u) * sliding;
      of_polygon_node(crossing.second_nodes[1]).template segment<2>(2 * r) += crossing.u * sliding;
    }
  }

  void hand_out(SegmentIntegrals3d& result) const {
    result.derivative.setZero(rows, 6 * n + 3 * m);
    for (int node = 0; node < n + m; ++node) {
      const int column = 3 * (node < n ? node : node + n);
      for (int r = 0; r < rows; ++r)
        for (int i = 0; i < 2; ++i) result.derivative(r, column + i) = of_node_[node][2 * r + i];
      result.derivative.col(column + 2).template tail<n>() = of_height_.col(node);
    }
    result.derivative.template block<n, 3 * n>(first_gap, 3 * n) = of_normal_;
  }

  const Overlap3d* overlap_ = nullptr;  // of the call
  Eigen::Matrix<double, 3, n> x_, normal_;
  Eigen::Matrix<double, 3, m> y_;
  Eigen::Matrix<double, n, n> basis_;
  Gradients from_slave_ = Gradients::Zero(), from_master_ = Gradients::Zero();  // of a point; masses do not depend on eta
  std::array<Gradients, n + m> of_node_;
  Eigen::Matrix<double, n, 3 * n> of_normal_;  // of the gaps
  Eigen::Matrix<double, n, n + m> of_height_;
};

template <class Slave, class Master>
void integrate_pair(const FacetVectors& slave, const FacetVectors& normals, const FacetVectors& master, const Overlap3d& overlap,
                    const Eigen::MatrixXd& basis, bool derivatives, SegmentIntegrals3d& result) {
  Integrator<Slave, Master> integrator(slave, normals, master, basis);
  if (derivatives)
    integrator.derivatives(slave, master, overlap, result);
  else
    integrator.values(overlap, result);
}

template <class Slave>
void integrate_slave(const FacetVectors& slave, const FacetVectors& normals, const FacetVectors& master, const Overlap3d& overlap,
                     const Eigen::MatrixXd& basis, bool derivatives, SegmentIntegrals3d& result) {
  const auto kernel = master.size() == 3   ? integrate_pair<Slave, Triangle3>
                      : master.size() == 4 ? integrate_pair<Slave, Quadrilateral4>
                      : master.size() == 6 ? integrate_pair<Slave, Triangle6>
                                           : integrate_pair<Slave, Quadrilateral8>;
  kernel(slave, normals, master, overlap, basis, derivatives, result);
}

}  // namespace mortise
